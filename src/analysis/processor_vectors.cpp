#include "src/analysis/processor_vectors.h"

#include <fmt/format.h>

#include <span>
#include <string>

#include "modules/object_processor/triangle_processor.h"
#include "src/base/errors.h"

namespace rastertlm::analysis {
namespace {

using namespace object_processor;

constexpr unsigned kMaterialBits = 8;  // of a material word

// Writes a processor's files; gives the index's rows.
class ProcessorWriter {
 public:
  ProcessorWriter(unsigned word_bits, const BinaryPoints& points, VectorFiles& files)
      : word_bits_(word_bits), points_(points), files_(files) {}

  // `name`: what its files begin with; `owner`: the first columns of its rows.
  std::string write(const std::string& name, const std::string& owner, const ProcessorWords& words) const {
    std::string rows;
    for (std::size_t ep = 0; ep < kElementaryProcessors; ++ep) {
      const std::string file = fmt::format("{}_ep{}.hex", name, ep);
      files_.write(file, hex_text(std::span(words).subspan(word_index(ep, 0), 3), word_bits_));
      for (std::size_t address = 0; address < 3; ++address)
        rows += row(owner, ep, address, words[word_index(ep, address)], word_bits_, file);
    }
    const std::string file = name + "_material.hex";
    files_.write(file, hex_text(std::span(words).subspan(kMaterialIndex, 1), kMaterialBits));
    return rows + row(owner, kElementaryProcessors, 0, words[kMaterialIndex], kMaterialBits, file);
  }

 private:
  std::string row(const std::string& owner, std::size_t ep, std::size_t address, std::uint32_t word, unsigned bits,
                  const std::string& file) const {
    const std::size_t index = 3 * ep + address;
    const WordWorth worth = word_worth(points_, word_bits_, index, word);
    return fmt::format("{},{},{},{},{},{},{},{},{}\n", owner, ep, address, index, worth.meaning, hex_word(word, bits),
                       worth.value, worth.unit, file);
  }

  unsigned word_bits_;
  const BinaryPoints& points_;
  VectorFiles& files_;
};

// Calls visit(board, slot, words) for every processor that holds an object, in the order of their numbers.
template <class Visit>
void for_each_object(const std::vector<ObjectBoard>& boards, unsigned word_bits, const Visit& visit) {
  for (std::size_t b = 0; b < boards.size(); ++b)
    for (std::uint32_t slot = 0; slot < boards[b].processors(); ++slot)
      if (const TriangleWords words = boards[b].backup(slot); !is_parked(words, word_bits)) visit(b, slot, words);
}

bool holds(const ProcessorRange& range, std::uint64_t processor) {
  return range.first <= processor && processor <= range.last;
}

}  // namespace

ProcessorCounts write_processors(const std::vector<ObjectBoard>& boards, unsigned word_bits, const BinaryPoints& points,
                                 const ProcessorRange& range, VectorFiles& files) {
  ProcessorCounts counts;
  for_each_object(boards, word_bits, [&](std::size_t board, std::uint32_t slot, const TriangleWords&) {
    ++counts.with_object;
    if (holds(range, boards[board].first_processor() + std::uint64_t{slot})) ++counts.listed;
  });
  if (counts.listed > kMostListed)
    throw InputError(Diagnostic{"--processors", 0, "",
                                fmt::format("processors {} to {} hold {} objects, of eight files each; at most {} are "
                                            "written at once: give a smaller range, FROM-TO",
                                            range.first, range.last, counts.listed, kMostListed)});
  const ProcessorWriter writer(word_bits, points, files);
  files.stream("index.csv", [&](report::TextFileWriter& index) {
    index.append("board,processor,slot,object,ep,address,index,meaning,hex,value,unit,file\n");
    for_each_object(boards, word_bits, [&](std::size_t board, std::uint32_t slot, const TriangleWords& words) {
      const std::uint64_t processor = boards[board].first_processor() + std::uint64_t{slot};
      if (!holds(range, processor)) return;
      const std::string owner =
          fmt::format("{},{},{},{}", board, processor, slot, boards[board].object_of_processor(slot));
      index.append(writer.write(fmt::format("board{}_processor{}", board, processor), owner, to_words(words)));
    });
  });
  static_cast<void>(writer.write("parked", "", to_words(parked_triangle(word_bits))));
  return counts;
}

}  // namespace rastertlm::analysis
