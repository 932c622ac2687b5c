#include "modules/shading/table_bank.h"

#include <algorithm>
#include <stdexcept>

#include "src/base/fixed_point.h"

namespace rastertlm::shading {

TableBank::TableBank(const ShadingParameters& parameters)
    : lights(static_cast<std::size_t>(parameters.lights)),
      material_tables(static_cast<std::size_t>(parameters.lights)),
      ambient(3 * static_cast<std::size_t>(parameters.materials)),
      dot_words_(std::uint32_t{1} << parameters.dot_table_address_bits),
      level_words_(static_cast<std::uint32_t>(parameters.materials) << parameters.index_bits),
      dot_mask_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.dot_table_output_bits)))),
      level_mask_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.level_bits)))),
      regions_a_light_(10 + static_cast<std::size_t>(parameters.specular_tables)),
      light_count_(lights.size()) {
  for (LightTables& light : lights)
    for (std::size_t i = 0; i < 3; ++i) {
      light.diffuse.products[i].resize(dot_words_);
      light.specular.products[i].resize(dot_words_);
    }
  for (MaterialTables& tables : material_tables) {
    for (auto& table : tables.diffuse) table.resize(level_words_);
    tables.specular.assign(static_cast<std::size_t>(parameters.specular_tables),
                           std::vector<std::uint8_t>(level_words_));
  }
  for (std::size_t light = 0; light < light_count_; ++light) {
    for (std::size_t i = 0; i < 3; ++i) add_region({TableKind::diffuse_dot, light, i}, dot_words_);
    for (std::size_t i = 0; i < 3; ++i) add_region({TableKind::specular_dot, light, i}, dot_words_);
    for (std::size_t i = 0; i < 3; ++i) add_region({TableKind::diffuse, light, i}, level_words_);
    for (std::size_t i = 0; i < material_tables[light].specular.size(); ++i)
      add_region({TableKind::specular, light, i}, level_words_);
    add_region({TableKind::signs, light, 0}, 1);
  }
  add_region({TableKind::ambient, 0, 0}, static_cast<std::uint32_t>(ambient.size()));
  add_region({TableKind::background, 0, 0}, 3);
}

void TableBank::add_region(TableId table, std::uint32_t words) {
  regions_.push_back({table, words_, words});
  words_ += words;
}

std::uint32_t TableBank::table_words(TableKind kind) const { return region({kind, 0, 0}).words; }

const TableBank::Region& TableBank::region(const TableId& table) const {
  std::size_t offset = light_count_ * regions_a_light_;
  if (table.kind == TableKind::ambient || table.kind == TableKind::background) {
    offset += table.kind == TableKind::background ? 1 : 0;
  } else {
    if (table.light >= light_count_) throw std::out_of_range("no such light in the shading tables");
    const std::size_t first =
        table.kind == TableKind::signs ? regions_a_light_ - 1 : 3 * static_cast<std::size_t>(table.kind);
    offset = table.light * regions_a_light_ + first + table.component;
  }
  const bool lone = table.kind >= TableKind::signs;
  if ((lone && table.component != 0) || offset >= regions_.size() || regions_[offset].table.kind != table.kind)
    throw std::out_of_range("no such shading table");
  return regions_[offset];
}

std::uint32_t TableBank::address(const TableId& table, std::uint32_t entry) const {
  const Region& place = region(table);
  if (entry >= place.words) throw std::out_of_range("no such entry of a shading table");
  return place.base + entry;
}

EntryAddress TableBank::decode(std::uint32_t address) const {
  if (address >= words_) throw std::out_of_range("an address behind the shading tables");
  const auto after = std::upper_bound(regions_.begin(), regions_.end(), address,
                                      [](std::uint32_t value, const Region& place) { return value < place.base; });
  const Region& place = *(after - 1);
  return {place.table, address - place.base};
}

void TableBank::write(std::uint32_t address, std::uint32_t value) {
  const EntryAddress place = decode(address);
  write(place.table, place.entry, value);
}

void TableBank::write(std::uint32_t address, std::span<const std::uint32_t> values) {
  const auto copy = [&values](auto& memory, std::uint32_t entry, std::uint32_t mask) {
    using Word = typename std::remove_reference_t<decltype(memory)>::value_type;
    const std::size_t count = std::min<std::size_t>(memory.size() - entry, values.size());
    for (std::size_t i = 0; i < count; ++i) memory[entry + i] = static_cast<Word>(values[i] & mask);
    return count;
  };
  while (!values.empty()) {
    const EntryAddress place = decode(address);
    std::size_t written = 1;
    switch (place.table.kind) {
      case TableKind::diffuse_dot:
        written = copy(lights[place.table.light].diffuse.products[place.table.component], place.entry, dot_mask_);
        break;
      case TableKind::specular_dot:
        written = copy(lights[place.table.light].specular.products[place.table.component], place.entry, dot_mask_);
        break;
      case TableKind::diffuse:
        written = copy(material_tables[place.table.light].diffuse[place.table.component], place.entry, level_mask_);
        break;
      case TableKind::specular:
        written = copy(material_tables[place.table.light].specular[place.table.component], place.entry, level_mask_);
        break;
      default:
        write(place.table, place.entry, values.front());
    }
    values = values.subspan(written);
    address += static_cast<std::uint32_t>(written);
  }
}

void TableBank::write(const TableId& table, std::uint32_t entry, std::uint32_t value) {
  const auto level = static_cast<std::uint8_t>(value & level_mask_);
  switch (table.kind) {
    case TableKind::diffuse_dot:
      lights.at(table.light).diffuse.products.at(table.component).at(entry) =
          static_cast<std::uint16_t>(value & dot_mask_);
      break;
    case TableKind::specular_dot:
      lights.at(table.light).specular.products.at(table.component).at(entry) =
          static_cast<std::uint16_t>(value & dot_mask_);
      break;
    case TableKind::diffuse:
      material_tables.at(table.light).diffuse.at(table.component).at(entry) = level;
      break;
    case TableKind::specular:
      material_tables.at(table.light).specular.at(table.component).at(entry) = level;
      break;
    case TableKind::signs:
      for (std::size_t i = 0; i < 3; ++i) {
        lights.at(table.light).diffuse.negative[i] = ((value >> i) & 1U) != 0;
        lights.at(table.light).specular.negative[i] = ((value >> (i + 3)) & 1U) != 0;
      }
      break;
    case TableKind::ambient:
      ambient.at(entry) = level;
      break;
    case TableKind::background:
      background.at(entry) = static_cast<std::uint8_t>(value);
      break;
  }
}

std::uint32_t TableBank::read(const TableId& table, std::uint32_t entry) const {
  switch (table.kind) {
    case TableKind::diffuse_dot:
      return lights.at(table.light).diffuse.products.at(table.component).at(entry);
    case TableKind::specular_dot:
      return lights.at(table.light).specular.products.at(table.component).at(entry);
    case TableKind::diffuse:
      return material_tables.at(table.light).diffuse.at(table.component).at(entry);
    case TableKind::specular:
      return material_tables.at(table.light).specular.at(table.component).at(entry);
    case TableKind::signs: {
      std::uint32_t word = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        word |= static_cast<std::uint32_t>(lights.at(table.light).diffuse.negative[i]) << i;
        word |= static_cast<std::uint32_t>(lights.at(table.light).specular.negative[i]) << (i + 3);
      }
      return word;
    }
    case TableKind::ambient:
      return ambient.at(entry);
    case TableKind::background:
      return background.at(entry);
  }
  return 0;
}

}  // namespace rastertlm::shading
