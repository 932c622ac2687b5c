#include "modules/shading/parameters.h"

#include <fmt/format.h>

#include <algorithm>

namespace rastertlm::shading {
namespace {

using parameter::About;
using parameter::Condition;
using parameter::Table;

constexpr const char* kReading = "budgets[] table_access, table_store";

void declare_latency(StageLatencies& latency, Table& table) {
  const std::string moves = "latency of the shading processor";
  table.integer("shading.latency.normaliser", latency.normaliser, {0, 1000},
                About{"cycles", "Pixel clocks from a normal's word to the normalised components.", moves});
  table.integer("shading.latency.dot_product", latency.dot_product, {0, 1000},
                About{"cycles", "Pixel clocks of the dot-product tables and the terminate adder.", moves});
  table.integer("shading.latency.tables", latency.tables, {0, 1000},
                About{"cycles", "Pixel clocks of a diffuse or specular table.", moves});
  table.integer("shading.latency.adders", latency.adders, {0, 1000},
                About{"cycles", "Pixel clocks of the final sums and their saturation.", moves});
}

}  // namespace

void ShadingParameters::declare(Table& table) {
  const std::string picture = "the picture";
  table.choice("shading.arithmetic", arithmetic, {"literal", "centred"},
               About{"", "The paper's truncations, or tables read at the centre of their intervals.", picture});
  table.integer("shading.lights", lights, {1, 16},
                About{"lights", "Light sources that the processor has units for.", "memory and loading of the tables"});
  table.integer(
      "shading.materials", materials, {1, 256},
      About{"materials", "Materials that the diffuse and specular tables hold.", "memory and loading of the tables"});
  table.integer("shading.normaliser_address_bits", normaliser_address_bits, {4, 20},
                About{"bits", "Address of the inverse square root ROM.", "the picture, memory bits"});
  table.integer("shading.normaliser_output_bits", normaliser_output_bits, {4, 16},
                About{"bits", "Word of the inverse square root ROM.", "the picture, memory bits"});
  table.integer("shading.dot_table_address_bits", dot_table_address_bits, {4, 15},
                About{"bits", "Magnitude of a normalised component, the address of a dot-product table.",
                      "the picture, memory bits, loading of the dot-product tables"});
  table.integer(
      "shading.dot_table_output_bits", dot_table_output_bits, {4, 15},
      About{"bits", "Word of a dot-product table and magnitude of a light word.", "the picture, memory bits"});
  table.integer("shading.index_bits", index_bits, {3, 15},
                About{"bits", "Address of the diffuse and specular tables within a material.",
                      "the picture, memory bits, loading of the diffuse and specular tables"});
  table.integer("shading.level_bits", level_bits, {2, 8},
                About{"bits", "Level of a colour channel.", "the picture, memory bits"});
  table.integer("shading.diffuse_fraction_bits", diffuse_fraction_bits, {0, 12},
                About{"bits", "Fraction bits of the diffuse constant that the loader accumulates.", picture,
                      Condition{"shading.arithmetic", {"centred"}}});
  table.integer("shading.specular_tables", specular_tables, {1, 3},
                About{"tables", "Specular tables a light: 1 (white highlights) or 3 (a table a colour).",
                      "the picture, memory and loading of the specular tables"});
  table.integers("shading.exponents", exponents, {1, 1000},
                 About{"", "Specular exponents whose paths the ROM holds.", "memory bits of the path ROM"});
  declare_latency(latency, table);
  table.text("shading.preset", preset,
             About{"", "Memory of the tables: sets the times of its reading that the file does not.", kReading});
  const auto time = [&](const std::string& path, double& target, const std::string& text) {
    table.real("shading." + path, target, {0.0, 100000.0}, About{"ns", text, kReading});
  };
  time("table_address_ns", table_address_ns, "Delay of the register that holds a table's address.");
  time("table_access_ns", table_access_ns, "Access time of the memories of the tables, address to data.");
  time("table_set_up_ns", table_set_up_ns, "Set-up time of the register that takes a table's word.");
}

void ShadingParameters::check(std::int64_t normal_bits, const std::string& file, Diagnostics& diagnostics) const {
  const auto refuse = [&](const std::string& key, const std::string& text) { diagnostics.add({file, 0, key, text}); };
  if (normal_bits < 4 || normal_bits > 16)
    refuse("object_processor.normal_bits", fmt::format("{} is not in 4..16", normal_bits));
  else if (normaliser_address_bits > 2 * normal_bits)
    refuse("shading.normaliser_address_bits", fmt::format("{} bits, but the sum of squares of {}-bit normals has {}",
                                                          normaliser_address_bits, normal_bits, 2 * normal_bits));
  if (normaliser_output_bits + normal_bits - 2 < dot_table_address_bits)
    refuse("shading.normaliser_output_bits", fmt::format("{} bits cannot give normalised components of {} bits",
                                                         normaliser_output_bits, dot_table_address_bits));
  if (dot_table_output_bits > dot_table_address_bits)
    refuse(
        "shading.dot_table_output_bits",
        fmt::format("{} bits, but shading.dot_table_address_bits is {}: the value would grow by more than one a step",
                    dot_table_output_bits, dot_table_address_bits));
  if (index_bits > dot_table_output_bits)
    refuse("shading.index_bits", fmt::format("{} bits, but a dot product has shading.dot_table_output_bits = {}",
                                             index_bits, dot_table_output_bits));
  if (specular_tables != 1 && specular_tables != 3)
    refuse("shading.specular_tables", fmt::format("{} is neither 1 nor 3", specular_tables));
  if (exponents.empty()) refuse("shading.exponents", "the path ROM holds no exponent");
  std::vector<std::int64_t> sorted = exponents;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    refuse("shading.exponents", fmt::format("{} stands twice", *twice));
}

Cycles ShadingParameters::total_latency() const {
  return Cycles(static_cast<std::uint64_t>(latency.normaliser + latency.dot_product + latency.tables + latency.adders));
}

}  // namespace rastertlm::shading
