// What a deferred shading processor is: declared once, here (its table loaders: loader_parameters.h). 004,
// sections 5.3.4 to 5.3.7.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/errors.h"
#include "src/base/units.h"
#include "src/parameter/table.h"

namespace rastertlm::shading {

// literal: the paper to the letter, every division a floor. centred: the same tables read at the centre of their
// intervals, presets of one half in the error registers, one more bit at one input of the normaliser's multipliers.
enum class Arithmetic { literal, centred };

// Cycles of the pixel clock that each stage's registers add.
struct StageLatencies {
  std::int64_t normaliser = 4;   // squares, sum, 1/sqrt ROM, products
  std::int64_t dot_product = 3;  // tables, two ranks of adders
  std::int64_t tables = 1;       // diffuse and specular tables, read together
  std::int64_t adders = 2;       // sum of lights and ambient, saturation
};

struct ShadingParameters {
  Arithmetic arithmetic = Arithmetic::centred;
  std::int64_t lights = 1;                    // 1..16
  std::int64_t materials = 16;                // 1..256
  std::int64_t normaliser_address_bits = 14;  // a, 4..20, at most 2 * normal_bits
  std::int64_t normaliser_output_bits = 12;   // o, 4..16
  std::int64_t dot_table_address_bits = 11;   // of a normalised component, 4..15
  std::int64_t dot_table_output_bits =
      11;                        // of a partial product, and of the light words, 4..15, at most the address bits
  std::int64_t index_bits = 10;  // of the diffuse and specular tables, 3..15, at most the dot table's output bits
  std::int64_t level_bits = 8;   // of a colour channel, 2..8
  std::int64_t diffuse_fraction_bits = 4;  // of I Kd colour, centred only; literal has none. 0..12
  std::int64_t specular_tables = 1;        // a light: 1 (white highlights, mean of I) or 3
  std::vector<std::int64_t> exponents{1, 2, 4, 5, 8, 10, 16, 20, 32, 50, 64, 100, 128, 200};  // of the path ROM
  StageLatencies latency;
  // Static memories of the tables: which grade, and what a read takes of it.
  std::string preset = "cy7c162_35";
  double table_address_ns = 10.0;  // the register that holds the address
  double table_access_ns = 35.0;   // address to data
  double table_set_up_ns = 5.0;    // of the register that takes the data

  // Paths "shading.lights" ...
  void declare(parameter::Table& table);
  // What no single range can say: widths that must fit each other and `normal_bits`, the width of a normal's word on
  // the link (object_processor.normal_bits, 4..16); the values 1 and 3; exponents twice. Adds to `diagnostics`; file
  // names the machine file.
  void check(std::int64_t normal_bits, const std::string& file, Diagnostics& diagnostics) const;

  // From the normal's word to the RGB levels, in pixel clocks.
  Cycles total_latency() const;
  // From the clock edge that gives a table its address to the earliest one that can take its word.
  double table_read_ns() const { return table_address_ns + table_access_ns + table_set_up_ns; }
};

}  // namespace rastertlm::shading
