// The line form of the deferred shading processor: the covered pixels of a line are gathered, and each stage runs over
// all of them, as the pipeline would, so that the compiler can use the vector units.
#include <algorithm>

#include "modules/shading/deferred_shader.h"
#include "src/base/errors.h"

namespace rastertlm::shading {

void DeferredShader::Scratch::resize(std::size_t columns) {
  column.resize(columns);
  base.resize(columns);
  visible.resize(columns);
  squares.resize(columns);
  for (std::size_t i = 0; i < 3; ++i) {
    word[i].resize(columns);
    magnitude[i].resize(columns);
    negative[i].resize(columns);
    sum[i].resize(columns);
  }
}

std::size_t DeferredShader::gather(const frame::FragmentLine& in, frame::RgbLine& out) {
  const Levels background = front().background;
  const auto index_bits = static_cast<unsigned>(parameters_.index_bits);
  const auto paint = [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) std::copy(background.begin(), background.end(), &out.levels[3 * c]);
  };
  const std::size_t begin = std::min(in.begin, in.columns());
  const std::size_t end = std::clamp(in.end, begin, in.columns());
  paint(0, begin);
  paint(end, in.columns());
  std::size_t count = 0;
  std::uint32_t largest_material = 0;
  for (std::size_t c = begin; c < end; ++c) {
    if (in.object[c] == 0) {
      paint(c, c + 1);
      continue;
    }
    scratch_.column[count] = static_cast<std::uint32_t>(c);
    scratch_.word[0][count] = in.normal_x[c];
    scratch_.word[1][count] = in.normal_y[c];
    scratch_.word[2][count] = in.normal_z[c];
    const std::uint32_t material = in.material[c];
    largest_material = std::max(largest_material, material);
    scratch_.base[count] = material << index_bits;
    ++count;
  }
  if (largest_material >= materials_.size())
    throw ModelError("shading", counters_.pixels + count, "a pixel selects a material that the tables do not have");
  return count;
}

void DeferredShader::normalise(std::size_t count) {
  const std::uint32_t mask = (std::uint32_t{1} << magnitude_bits_) - 1;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t word = scratch_.word[i][k];
      scratch_.magnitude[i][k] = word & mask;
      scratch_.negative[i][k] = (word >> magnitude_bits_) & 1U;
    }
  const std::uint32_t* x = scratch_.magnitude[0].data();
  const std::uint32_t* y = scratch_.magnitude[1].data();
  const std::uint32_t* z = scratch_.magnitude[2].data();
  std::uint32_t zeros = 0;
  std::uint32_t shorts = 0;
  for (std::size_t k = 0; k < count; ++k) {
    std::uint32_t squares = 0;
    for (std::size_t i = 0; i < 3; ++i)
      squares += normaliser_.square(scratch_.magnitude[i][k], scratch_.negative[i][k]);
    const std::uint32_t visible = (x[k] | y[k] | z[k]) != 0 ? 1 : 0;
    scratch_.squares[k] = squares;
    scratch_.visible[k] = visible;
    zeros += 1 - visible;
    shorts += visible & (normaliser_.is_short(squares) ? 1U : 0U);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t root = normaliser_.inverse_root(scratch_.squares[k]);
    for (auto& magnitude : scratch_.magnitude) magnitude[k] = normaliser_.product(magnitude[k], root);
  }
  counters_.pixels += count;
  counters_.zero_normals += zeros;
  counters_.short_normals += shorts;
}

void DeferredShader::add_light(const LightTables& light, const MaterialTables& tables, std::size_t count) {
  const auto evaluate = [&](const DotTables& dot, std::size_t k) {
    std::array<std::int32_t, 3> term{};
    for (std::size_t i = 0; i < 3; ++i)
      term[i] = DotProduct::signed_term(dot.products[i][scratch_.magnitude[i][k]],
                                        (scratch_.negative[i][k] != 0) != dot.negative[i]);
    return dot_product_.index(dot_product_.sum(term[0], term[1], term[2]));
  };
  std::array<const std::uint8_t*, 3> diffuse_levels{};
  std::array<const std::uint8_t*, 3> specular_levels{};
  for (std::size_t c = 0; c < 3; ++c) {
    diffuse_levels[c] = tables.diffuse[c].data();
    specular_levels[c] = tables.specular[tables.specular.size() == 1 ? 0 : c].data();
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t diffuse = scratch_.base[k] + evaluate(light.diffuse, k);
    const std::size_t specular = scratch_.base[k] + evaluate(light.specular, k);
    for (std::size_t c = 0; c < 3; ++c)
      scratch_.sum[c][k] +=
          scratch_.visible[k] * (std::uint32_t{diffuse_levels[c][diffuse]} + specular_levels[c][specular]);
  }
}

void DeferredShader::finish(std::size_t count, frame::RgbLine& out) {
  const std::vector<std::uint8_t>& ambient = front().ambient;
  const auto index_bits = static_cast<unsigned>(parameters_.index_bits);
  std::uint64_t saturated_pixels = 0;
  for (std::size_t k = 0; k < count; ++k) {
    std::uint8_t* pixel = &out.levels[3 * std::size_t{scratch_.column[k]}];
    const std::uint8_t* ambient_level = &ambient[3 * std::size_t{scratch_.base[k] >> index_bits}];
    bool saturated = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t sum = scratch_.sum[c][k] + ambient_level[c];
      saturated |= sum > full_level_;
      pixel[c] = display_[std::min(sum, full_level_)];
    }
    saturated_pixels += saturated ? 1 : 0;
  }
  counters_.saturated_pixels += saturated_pixels;
}

void DeferredShader::shade_line(const frame::FragmentLine& in, frame::RgbLine& out) {
  if (out.columns() != in.columns()) out.resize(in.columns());
  if (scratch_.column.size() < in.columns()) scratch_.resize(in.columns());
  const std::size_t count = gather(in, out);
  normalise(count);
  for (auto& sum : scratch_.sum) std::fill_n(sum.begin(), count, 0U);
  const TableBank& tables = front();
  for (std::size_t l = 0; l < tables.lights.size(); ++l)
    if (lights_[l].set) add_light(tables.lights[l], tables.material_tables[l], count);
  finish(count, out);
}

}  // namespace rastertlm::shading
