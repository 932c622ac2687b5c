#include "src/analysis/table_vectors.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rastertlm::analysis {
namespace {

using shading::TableBank;
using shading::TableId;
using shading::TableKind;

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
constexpr std::array<const char*, 3> kColours{"red", "green", "blue"};
constexpr unsigned kSignBits = 6;
constexpr unsigned kDisplayBits = 8;

class TableWriter {
 public:
  TableWriter(const shading::DeferredShader& shader, VectorFiles& files)
      : parameters_(shader.parameters()), bank_(shader.front()), files_(files) {}

  // A table that a loader writes.
  void table(const TableId& id, const std::string& name, unsigned bits, const std::string& worth) {
    std::vector<std::uint32_t> words(bank_.table_words(id.kind));
    for (std::uint32_t entry = 0; entry < words.size(); ++entry) words[entry] = bank_.read(id, entry);
    write(name, words, bits, std::to_string(bank_.address(id, 0)), worth);
  }

  // `address`: of the first word on the loader's bus; empty for a ROM.
  template <class Words>
  void write(const std::string& name, const Words& words, unsigned bits, const std::string& address,
             const std::string& worth) {
    const std::string file = name + ".hex";
    files_.write(file, hex_text(words, bits));
    index_ += fmt::format("{},{},{},{},{},{}\n", name, words.size(), bits, address, worth, file);
  }

  void light(std::size_t light) {
    const auto dot_bits = static_cast<unsigned>(parameters_.dot_table_output_bits);
    const auto level_bits = static_cast<unsigned>(parameters_.level_bits);
    const std::string name = fmt::format("light{}", light);
    for (std::size_t i = 0; i < 3; ++i)
      table({TableKind::diffuse_dot, light, i}, fmt::format("{}_diffuse_dot_{}", name, kAxes[i]), dot_bits,
            fmt::format("|n L| in units of 2^-{}; address: magnitude of n", dot_bits));
    for (std::size_t i = 0; i < 3; ++i)
      table({TableKind::specular_dot, light, i}, fmt::format("{}_specular_dot_{}", name, kAxes[i]), dot_bits,
            fmt::format("|n H| in units of 2^-{}; address: magnitude of n", dot_bits));
    const std::string address = fmt::format("address: material * {} + index", 1 << parameters_.index_bits);
    for (std::size_t i = 0; i < 3; ++i)
      table({TableKind::diffuse, light, i}, fmt::format("{}_diffuse_{}", name, kColours[i]), level_bits,
            "levels; " + address);
    const std::size_t specular = bank_.material_tables[light].specular.size();
    for (std::size_t i = 0; i < specular; ++i)
      table({TableKind::specular, light, i}, fmt::format("{}_specular_{}", name, specular == 1 ? "all" : kColours[i]),
            level_bits, "levels; " + address);
    table({TableKind::signs, light, 0}, name + "_signs", kSignBits,
          "bits 0 to 2: L x y z negative; bits 3 to 5: H x y z negative");
  }

  const std::string& index() const { return index_; }

 private:
  const shading::ShadingParameters& parameters_;
  const TableBank& bank_;
  VectorFiles& files_;
  std::string index_ = "table,words,bits,bus_address,worth,file\n";
};

}  // namespace

void write_tables(const shading::DeferredShader& shader, unsigned normal_bits, VectorFiles& files) {
  const shading::ShadingParameters& p = shader.parameters();
  TableWriter writer(shader, files);
  for (std::size_t light = 0; light < static_cast<std::size_t>(p.lights); ++light) writer.light(light);
  writer.table({TableKind::ambient, 0, 0}, "ambient", static_cast<unsigned>(p.level_bits),
               "levels; address: 3 * material + colour");
  writer.table({TableKind::background, 0, 0}, "background", kDisplayBits, "levels as displayed: red green blue");
  const std::int64_t root_scale = p.normaliser_output_bits + static_cast<std::int64_t>(normal_bits) - 2;
  writer.write("inverse_root_rom", shader.normaliser().rom(), static_cast<unsigned>(p.normaliser_output_bits), "",
               fmt::format("2^{} / sqrt(S); address: S >> {}", root_scale,
                           2 * static_cast<std::int64_t>(normal_bits) - p.normaliser_address_bits));
  for (const std::int64_t exponent : p.exponents)
    writer.write(fmt::format("path_rom_exponent{}", exponent), shader.path_rom().path(exponent), 1, "",
                 "moves of a specular loader: 0 stores and goes to the next address; 1 adds Ks to the error register");
  files.write("tables.csv", writer.index());
}

}  // namespace rastertlm::analysis
