// An independent reading of what `rastertlm vectors` writes: the C++ standard library and nothing of the model. It
// follows the README.md that stands beside the vectors: from the words of the loading RAMs it recomputes every pixel of
// decision.csv, and from decision.csv and the tables every pixel of rgb.csv.
//   reread_vectors DIRECTORY
// Exit code 0: all are the same; 1: something differs, and is named; 2: something cannot be read.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Word = std::uint64_t;

struct Difference : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string directory;

std::ifstream opened(const std::string& name) {
  std::ifstream file(directory + '/' + name, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + name);
  return file;
}

// The manifest, in which no key stands twice.
class Manifest {
 public:
  Manifest() {
    std::ifstream file = opened("manifest.json");
    text_.assign(std::istreambuf_iterator<char>(file), {});
  }
  Word number(const std::string& key) const { return std::stoull(text_.substr(after(key))); }
  std::string text(const std::string& key) const {
    const std::size_t begin = after(key) + 1;
    return text_.substr(begin, text_.find('"', begin) - begin);
  }

 private:
  std::size_t after(const std::string& key) const {
    const std::string quoted = '"' + key + "\": ";
    const std::size_t at = text_.find(quoted);
    if (at == std::string::npos) throw std::runtime_error("manifest.json has no " + key);
    return at + quoted.size();
  }
  std::string text_;
};

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += part;
  return text;
}

// `count` words of `bits`, one a line, with leading zeros.
std::vector<Word> hex_words(const std::string& name, std::size_t count, unsigned bits) {
  std::ifstream file = opened(name);
  std::vector<Word> words;
  for (std::string line; std::getline(file, line);) {
    const bool hexadecimal = line.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (line.size() != (bits + 3) / 4 || !hexadecimal || std::stoull(line, nullptr, 16) >> bits != 0)
      throw Difference(joined({name, ": '", line, "' is no word of ", std::to_string(bits), " bits"}));
    words.push_back(std::stoull(line, nullptr, 16));
  }
  if (words.size() != count)
    throw Difference(name + " has " + std::to_string(words.size()) + " words, not " + std::to_string(count));
  return words;
}

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> result;
  std::istringstream stream(row);
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

// A file of decimal numbers, `columns` a row below a header, read row by row.
class Rows {
 public:
  Rows(const std::string& name, const std::string& header) : name_(name), file_(opened(name)) {
    std::string line;
    std::getline(file_, line);
    if (line != header) throw Difference(name + " begins with '" + line + "', not with '" + header + "'");
    numbers_.resize(cells(header).size());
  }
  const std::vector<Word>& next() {
    if (!std::getline(file_, line_)) throw Difference(name_ + " ends early");
    const char* at = line_.c_str();
    for (Word& number : numbers_) {
      char* end = nullptr;
      number = std::strtoull(at, &end, 10);
      if (end == at) throw Difference(name_ + ": '" + line_ + "' has too few numbers");
      at = *end == ',' ? end + 1 : end;
    }
    if (*at != 0) throw Difference(name_ + ": '" + line_ + "' has too many numbers");
    return numbers_;
  }
  void expect(const std::vector<Word>& expected) {
    if (next() == expected) return;
    std::string text;
    for (const Word number : expected) text += (text.empty() ? "" : ",") + std::to_string(number);
    throw Difference(name_ + " has '" + line_ + "', recomputed '" + text + "'");
  }
  void expect_end() {
    if (std::getline(file_, line_)) throw Difference(name_ + " has more rows than the picture pixels");
  }

 private:
  std::string name_;
  std::ifstream file_;
  std::string line_;
  std::vector<Word> numbers_;
};

struct Processor {
  Word number = 0;
  Word object = 0;
  std::array<std::array<Word, 3>, 7> words{};  // by elementary processor: A, B, C'
  Word material = 0;
};

class Machine {
 public:
  explicit Machine(const Manifest& manifest)
      : columns(manifest.number("columns")),
        lines(manifest.number("lines")),
        field(manifest.number("field")),
        fields(manifest.number("fields")),
        word_bits(static_cast<unsigned>(manifest.number("word_bits"))),
        normal_bits(static_cast<unsigned>(manifest.number("normal_bits"))),
        mask((Word{1} << word_bits) - 1) {}
  Word at(const std::array<Word, 3>& w, Word x, Word y) const { return (w[0] * x + w[1] * (y + 1) + w[2]) & mask; }
  bool negative(Word word) const { return (word >> (word_bits - 1) & 1) != 0; }

  Word columns;
  Word lines;
  Word field;  // lines field, field + fields, ... are listed
  Word fields;
  unsigned word_bits;
  unsigned normal_bits;
  Word mask;
};

Processor read_processor(const std::string& name, const Machine& machine) {
  Processor processor;
  for (std::size_t ep = 0; ep < 7; ++ep) {
    const auto words = hex_words(name + "_ep" + std::to_string(ep) + ".hex", 3, machine.word_bits);
    std::copy(words.begin(), words.end(), processor.words[ep].begin());
  }
  processor.material = hex_words(name + "_material.hex", 1, 8)[0];
  return processor;
}

// What index.csv says of a word must be what its file holds, and its value the word's.
void check_row(const std::vector<std::string>& row, const Processor& processor, const std::string& name,
               const Manifest& manifest, const Machine& machine) {
  const std::size_t ep = std::stoul(row[4]);
  const std::size_t address = std::stoul(row[5]);
  const Word word = ep < 7 ? processor.words[ep][address] : processor.material;
  const std::string file = name + (ep < 7 ? "_ep" + row[4] : "_material") + ".hex";
  const bool is_signed = ep < 7 && !(ep == 3 && address == 2) && machine.negative(word);
  const double value =
      static_cast<double>(word) - (is_signed ? std::ldexp(1.0, static_cast<int>(machine.word_bits)) : 0);
  const char* point = ep < 3 ? "edge_fraction_bits" : ep == 3 ? "depth_fraction_bits" : "normal_fraction_bits";
  const bool scaled = manifest.text("edges") == "scaled" && ep < 3;
  const int bits = ep == 7 || scaled ? 0 : static_cast<int>(manifest.number(point));
  if (std::stoull(row[8], nullptr, 16) != word || row[11] != file || std::stoul(row[6]) != 3 * ep + address)
    throw Difference("index.csv: " + row[8] + " in " + row[11] + " is not what " + file + " holds");
  if (std::stod(row[9]) != std::ldexp(value, -bits))
    throw Difference("index.csv: " + row[8] + " is not worth " + row[9]);
}

// The rows of index.csv.
template <class Visit>
std::size_t for_each_row(const Visit& visit) {
  std::ifstream index = opened("index.csv");
  std::string line;
  std::getline(index, line);
  if (line != "board,processor,slot,object,ep,address,index,meaning,hex,value,unit,file")
    throw Difference("index.csv begins with '" + line + "'");
  std::size_t rows = 0;
  for (; std::getline(index, line); ++rows) {
    const auto row = cells(line);
    if (row.size() != 12) throw Difference("index.csv: '" + line + "'");
    visit(row);
  }
  return rows;
}

std::string name_of(const std::vector<std::string>& row) { return "board" + row[0] + "_processor" + row[1]; }

// In the order of their numbers.
std::vector<Processor> read_processors(const Manifest& manifest, const Machine& machine) {
  std::vector<Processor> processors;
  const std::size_t rows = for_each_row([&](const std::vector<std::string>& row) {
    const Word number = std::stoull(row[1]);
    if (!processors.empty() && processors.back().number == number) return;
    if (!processors.empty() && processors.back().number > number) throw Difference("index.csv is not in order");
    if (number != std::stoull(row[0]) * manifest.number("processors_per_board") + std::stoull(row[2]))
      throw Difference("index.csv: processor " + row[1] + " is not slot " + row[2] + " of board " + row[0]);
    processors.push_back(read_processor(name_of(row), machine));
    processors.back().number = number;
    processors.back().object = std::stoull(row[3]);
  });
  if (processors.size() != manifest.number("processors_with_object") || rows != 22 * processors.size())
    throw Difference("index.csv has " + std::to_string(rows) + " rows, of " + std::to_string(processors.size()) +
                     " processors");
  return processors;
}

void check_index(const std::vector<Processor>& processors, const Manifest& manifest, const Machine& machine) {
  std::size_t rows = 0;
  for_each_row([&](const std::vector<std::string>& row) {
    check_row(row, processors[rows++ / 22], name_of(row), manifest, machine);
  });
}

// The nearest processor of every pixel, and its depth.
struct Nearest {
  std::vector<const Processor*> processor;
  std::vector<Word> depth;
};

void draw(const Processor& processor, const Machine& machine, Nearest& nearest) {
  for (Word y = machine.field; y < machine.lines; y += machine.fields)
    for (Word x = 0; x < machine.columns; ++x) {
      const auto& w = processor.words;
      if (machine.negative(machine.at(w[0], x, y) | machine.at(w[1], x, y) | machine.at(w[2], x, y))) continue;
      const Word depth = machine.at(w[3], x, y);
      const std::size_t pixel = y * machine.columns + x;
      if (depth >= nearest.depth[pixel]) continue;  // equal depth keeps the lower number, which came first
      nearest.depth[pixel] = depth;
      nearest.processor[pixel] = &processor;
    }
}

Nearest nearest_of(const std::vector<Processor>& processors, const Machine& machine) {
  const std::size_t pixels = machine.columns * machine.lines;
  Nearest nearest{std::vector<const Processor*>(pixels), std::vector<Word>(pixels, machine.mask)};
  const Processor parked = read_processor("parked", machine);
  draw(parked, machine, nearest);
  if (std::any_of(nearest.processor.begin(), nearest.processor.end(), [](const Processor* p) { return p != nullptr; }))
    throw Difference("a parked processor covers a pixel");
  for (const Processor& processor : processors) draw(processor, machine, nearest);
  return nearest;
}

unsigned bit_length(Word word) {
  unsigned bits = 0;
  for (; word != 0; word >>= 1) ++bits;
  return bits;
}

// Three words to three shorter ones that share a shift.
std::array<Word, 3> prenormalised(const std::array<Word, 3>& normal, const Machine& machine) {
  std::array<Word, 3> magnitude{};
  Word largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    magnitude[i] = machine.negative(normal[i]) ? ~normal[i] & machine.mask : normal[i];
    largest = std::max(largest, magnitude[i]);
  }
  const unsigned magnitude_bits = machine.normal_bits - 1;
  const unsigned shift = std::max(bit_length(largest), magnitude_bits) - magnitude_bits;
  std::array<Word, 3> link{};
  for (std::size_t i = 0; i < 3; ++i)
    link[i] = Word{machine.negative(normal[i])} << magnitude_bits | magnitude[i] >> shift;
  return link;
}

std::size_t check_decision(const std::vector<Processor>& processors, const Machine& machine) {
  const Nearest nearest = nearest_of(processors, machine);
  Rows rows("decision.csv", "line,column,object,depth,normal_x,normal_y,normal_z,material");
  std::size_t covered = 0;
  for (Word y = machine.field; y < machine.lines; y += machine.fields)
    for (Word x = 0; x < machine.columns; ++x) {
      const std::size_t pixel = y * machine.columns + x;
      const Processor* p = nearest.processor[pixel];
      if (p == nullptr) {
        rows.expect({y, x, 0, machine.mask, 0, 0, 0, 0});
        continue;
      }
      ++covered;
      const auto normal = prenormalised(
          {machine.at(p->words[4], x, y), machine.at(p->words[5], x, y), machine.at(p->words[6], x, y)}, machine);
      rows.expect({y, x, p->object, nearest.depth[pixel], normal[0], normal[1], normal[2], p->material});
    }
  rows.expect_end();
  return covered;
}

class Shading {
 public:
  explicit Shading(const Manifest& manifest)
      : centred_(manifest.text("arithmetic") == "centred"),
        normal_bits_(bits(manifest, "normal_bits")),
        root_address_bits_(bits(manifest, "normaliser_address_bits")),
        root_bits_(bits(manifest, "normaliser_output_bits")),
        dot_address_bits_(bits(manifest, "dot_table_address_bits")),
        dot_bits_(bits(manifest, "dot_table_output_bits")),
        index_bits_(bits(manifest, "index_bits")),
        level_bits_(bits(manifest, "level_bits")) {
    const Word materials = manifest.number("materials");
    const std::size_t level_words = materials << index_bits_;
    root_ = hex_words("inverse_root_rom.hex", std::size_t{1} << root_address_bits_, root_bits_);
    ambient_ = hex_words("ambient.hex", 3 * materials, level_bits_);
    background_ = hex_words("background.hex", 3, 8);
    for (Word l = 0; l < manifest.number("lights"); ++l) {
      const std::string name = "light" + std::to_string(l);
      Light& light = lights_.emplace_back();
      light.signs = hex_words(name + "_signs.hex", 1, 6)[0];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string axis(1, "xyz"[i]);
        const std::string colour = std::array<const char*, 3>{"red", "green", "blue"}[i];
        light.dot[0][i] =
            hex_words(joined({name, "_diffuse_dot_", axis, ".hex"}), Word{1} << dot_address_bits_, dot_bits_);
        light.dot[1][i] =
            hex_words(joined({name, "_specular_dot_", axis, ".hex"}), Word{1} << dot_address_bits_, dot_bits_);
        light.diffuse[i] = hex_words(joined({name, "_diffuse_", colour, ".hex"}), level_words, level_bits_);
        const bool one = manifest.number("specular_tables") == 1;
        light.specular[i] = hex_words(name + "_specular_" + (one ? "all" : colour) + ".hex", level_words, level_bits_);
      }
    }
  }

  std::array<Word, 3> levels(Word object, const std::array<Word, 3>& normal, Word material) const {
    if (object == 0) return {background_[0], background_[1], background_[2]};
    std::array<Word, 3> magnitude{};
    std::array<bool, 3> negative{};
    for (std::size_t i = 0; i < 3; ++i) {
      magnitude[i] = normal[i] & ((Word{1} << (normal_bits_ - 1)) - 1);
      negative[i] = normal[i] >> (normal_bits_ - 1) != 0;
    }
    std::array<Word, 3> sum{ambient_.at(3 * material), ambient_.at(3 * material + 1), ambient_.at(3 * material + 2)};
    const bool has_direction = (magnitude[0] | magnitude[1] | magnitude[2]) != 0;
    const auto n = normalised(magnitude, negative);
    for (const Light& light : lights_) {
      if (!has_direction) continue;
      const Word diffuse = (material << index_bits_) + index(light, 0, n, negative);
      const Word specular = (material << index_bits_) + index(light, 1, n, negative);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += light.diffuse[c].at(diffuse) + light.specular[c].at(specular);
    }
    const Word full = (Word{1} << level_bits_) - 1;
    for (Word& level : sum) level = (2 * std::min(level, full) * 255 + full) / (2 * full);
    return sum;
  }

 private:
  struct Light {
    std::array<std::array<std::vector<Word>, 3>, 2> dot;  // L and H
    std::array<std::vector<Word>, 3> diffuse;
    std::array<std::vector<Word>, 3> specular;
    Word signs = 0;
  };

  static unsigned bits(const Manifest& manifest, const char* key) {
    return static_cast<unsigned>(manifest.number(key));
  }

  std::array<Word, 3> normalised(const std::array<Word, 3>& magnitude, const std::array<bool, 3>& negative) const {
    Word squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Word m = magnitude[i];
      const Word two = m + (negative[i] ? 1 : 0);
      squares += centred_ ? m * (m + 1) : two * two;
    }
    const Word root = root_.at(squares >> (2 * normal_bits_ - root_address_bits_));
    const unsigned shift = root_bits_ + normal_bits_ - 2 - dot_address_bits_;
    std::array<Word, 3> n{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Word product = centred_ ? (2 * magnitude[i] + 1) * root >> (shift + 1) : magnitude[i] * root >> shift;
      n[i] = std::min(product, (Word{1} << dot_address_bits_) - 1);
    }
    return n;
  }

  Word index(const Light& light, std::size_t direction, const std::array<Word, 3>& n,
             const std::array<bool, 3>& negative) const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto entry = static_cast<std::int64_t>(light.dot[direction][i].at(n[i]));
      const bool turned = (light.signs >> (3 * direction + i) & 1) != 0;
      sum += negative[i] != turned ? -entry - 1 : entry;  // ~entry
    }
    if (centred_) sum = 2 * sum + 3;
    const unsigned more = centred_ ? 1 : 0;
    sum = std::clamp<std::int64_t>(sum, 0, (std::int64_t{1} << (dot_bits_ + more)) - 1);
    return static_cast<Word>(sum) >> (dot_bits_ + more - index_bits_);
  }

  bool centred_;
  unsigned normal_bits_, root_address_bits_, root_bits_, dot_address_bits_, dot_bits_, index_bits_, level_bits_;
  std::vector<Word> root_;
  std::vector<Word> ambient_;
  std::vector<Word> background_;
  std::vector<Light> lights_;
};

void check_rgb(const Manifest& manifest, const Machine& machine) {
  const Shading shading(manifest);
  Rows decision("decision.csv", "line,column,object,depth,normal_x,normal_y,normal_z,material");
  Rows rgb("rgb.csv", "line,column,r,g,b");
  for (Word y = machine.field; y < machine.lines; y += machine.fields)
    for (Word x = 0; x < machine.columns; ++x) {
      const std::vector<Word>& pixel = decision.next();
      const auto levels = shading.levels(pixel[2], {pixel[4], pixel[5], pixel[6]}, pixel[7]);
      rgb.expect({y, x, levels[0], levels[1], levels[2]});
    }
  rgb.expect_end();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: reread_vectors DIRECTORY\n";
    return 2;
  }
  directory = argv[1];
  try {
    const Manifest manifest;
    const Machine machine(manifest);
    const std::vector<Processor> processors = read_processors(manifest, machine);
    const std::size_t covered = check_decision(processors, machine);
    check_index(processors, manifest, machine);
    check_rgb(manifest, machine);
    std::cout << processors.size() << " processors, " << machine.columns * (machine.lines / machine.fields)
              << " pixels, " << covered
              << " of them covered: decision.csv and rgb.csv are what the words and tables give\n";
    return 0;
  } catch (const Difference& difference) {
    std::cerr << difference.what() << '\n';
    return 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
