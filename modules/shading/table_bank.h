// The memories of the shading processor that a loader writes, and their addresses on the loader's bus. Plain memory: a
// table that is half written shades as it stands.
//
// One bus word holds one entry. The words of a bank follow each other from address 0:
//   for each light:  N.L tables x, y, z   (2^dot_table_address_bits words each; an entry has dot_table_output_bits)
//                    N.H tables x, y, z   (likewise)
//                    diffuse tables red, green, blue  (materials x 2^index_bits words each; an entry has level_bits)
//                    specular tables, 1 or 3          (likewise)
//                    signs: one word; bits 0..2 the signs of L's components, bits 3..5 of H's, set where negative
//   then             ambient registers: materials x 3 words (red, green, blue)
//                    background register: 3 words, levels 0..255 as displayed
// Within a diffuse or specular table, entry = material * 2^index_bits + index.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/shading/parameters.h"

namespace rastertlm::shading {

enum class TableKind : std::uint8_t { diffuse_dot, specular_dot, diffuse, specular, signs, ambient, background };

// Which memory: `light` means nothing for ambient and background; `component` is x, y, z or red, green, blue, 0 for a
// lone table.
struct TableId {
  TableKind kind = TableKind::diffuse_dot;
  std::size_t light = 0;
  std::size_t component = 0;
  friend bool operator==(const TableId&, const TableId&) = default;
};

// Partial products with one constant unit vector: entries [n] = n * |component|, and the signs of the components.
struct DotTables {
  std::array<std::vector<std::uint16_t>, 3> products;
  std::array<bool, 3> negative{};
};

struct LightTables {
  DotTables diffuse;   // N.L
  DotTables specular;  // N.H
};

// Levels of one light by material and index.
struct MaterialTables {
  std::array<std::vector<std::uint8_t>, 3> diffuse;
  std::vector<std::vector<std::uint8_t>> specular;  // 1 or 3
};

struct EntryAddress {
  TableId table;
  std::uint32_t entry = 0;
};

class TableBank {
 public:
  // All words zero.
  explicit TableBank(const ShadingParameters& parameters);

  std::vector<LightTables> lights;
  std::vector<MaterialTables> material_tables;  // one a light
  std::vector<std::uint8_t> ambient;            // 3 a material
  std::array<std::uint8_t, 3> background{};

  // Words of the bank: addresses are 0 .. words() - 1.
  std::uint32_t words() const { return words_; }
  std::uint32_t table_words(TableKind kind) const;
  // Throws std::out_of_range where there is no such table, entry or address.
  std::uint32_t address(const TableId& table, std::uint32_t entry) const;
  EntryAddress decode(std::uint32_t address) const;

  // Bits that the memory does not have are dropped.
  void write(std::uint32_t address, std::uint32_t value);
  // Consecutive addresses; all must exist.
  void write(std::uint32_t address, std::span<const std::uint32_t> values);
  void write(const TableId& table, std::uint32_t entry, std::uint32_t value);
  std::uint32_t read(const TableId& table, std::uint32_t entry) const;
  std::uint32_t read(std::uint32_t address) const {
    const EntryAddress place = decode(address);
    return read(place.table, place.entry);
  }

 private:
  struct Region {
    TableId table;
    std::uint32_t base = 0;
    std::uint32_t words = 0;
  };
  const Region& region(const TableId& table) const;
  void add_region(TableId table, std::uint32_t words);

  std::uint32_t dot_words_;
  std::uint32_t level_words_;
  std::uint32_t dot_mask_;
  std::uint32_t level_mask_;
  std::uint32_t words_ = 0;
  std::size_t regions_a_light_;
  std::size_t light_count_;
  std::vector<Region> regions_;  // by address
};

}  // namespace rastertlm::shading
