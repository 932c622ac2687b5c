// The line form of the deferred shading processor. Tables that a loader has finished are read by a vector kernel.
// Otherwise the covered pixels of a line are gathered, and each stage runs over all of them, as the pipeline would.
#include <algorithm>
#include <utility>

#include "modules/shading/deferred_shader.h"
#include "src/base/errors.h"

namespace rastertlm::shading {

void DeferredShader::Scratch::resize(std::size_t columns) {
  column.resize(columns);
  base.resize(columns);
  visible.resize(columns);
  squares.resize(columns);
  diffuse_index.resize(columns);
  specular_index.resize(columns);
  for (std::size_t i = 0; i < 3; ++i) {
    word[i].resize(columns);
    magnitude[i].resize(columns);
    negative[i].resize(columns);
    sum[i].resize(columns);
  }
}

void DeferredShader::paint(std::size_t first, std::size_t last, frame::RgbLine& out) const {
  if (first >= last) return;
  const Levels background = front().background;
  std::uint8_t* levels = &out.levels[3 * first];
  const std::size_t size = 3 * (last - first);
  std::copy(background.begin(), background.end(), levels);
  // What is painted is the pattern of what comes next.
  for (std::size_t done = 3; done < size; done *= 2) std::copy_n(levels, std::min(done, size - done), levels + done);
}

void DeferredShader::check_material(std::uint32_t largest, std::size_t pixels) const {
  if (largest >= materials_.size())
    throw ModelError("shading", counters_.pixels + pixels, "a pixel selects a material that the tables do not have");
}

std::size_t DeferredShader::gather(const frame::FragmentLine& in, frame::RgbLine& out) {
  const auto index_bits = static_cast<unsigned>(parameters_.index_bits);
  const std::size_t begin = std::min(in.begin, in.columns());
  const std::size_t end = std::clamp(in.end, begin, in.columns());
  paint(0, begin, out);
  paint(end, in.columns(), out);
  std::size_t count = 0;
  std::uint32_t largest_material = 0;
  for (std::size_t c = begin; c < end; ++c) {
    if (in.object[c] == 0) {
      paint(c, c + 1, out);
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
  check_material(largest_material, count);
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
  std::uint32_t* roots = scratch_.squares.data();
  for (std::size_t k = 0; k < count; ++k) roots[k] = normaliser_.inverse_root(roots[k]);
  for (auto& component : scratch_.magnitude) {
    std::uint32_t* magnitude = component.data();
    for (std::size_t k = 0; k < count; ++k) magnitude[k] = normaliser_.product(magnitude[k], roots[k]);
  }
  counters_.pixels += count;
  counters_.zero_normals += zeros;
  counters_.short_normals += shorts;
}

void DeferredShader::add_light(const LightTables& light, const MaterialTables& tables, std::size_t count) {
  // Bare pointers and a copy of the adder: nothing that the loop writes can then alias what it reads through.
  const DotProduct adder = dot_product_;
  const auto index_into = [&](const DotTables& dot, std::uint32_t* index) {
    const std::uint16_t* products[3] = {dot.products[0].data(), dot.products[1].data(), dot.products[2].data()};
    const std::uint32_t* n[3] = {scratch_.magnitude[0].data(), scratch_.magnitude[1].data(),
                                 scratch_.magnitude[2].data()};
    const std::uint32_t* sign[3] = {scratch_.negative[0].data(), scratch_.negative[1].data(),
                                    scratch_.negative[2].data()};
    const std::uint32_t flip[3] = {dot.negative[0], dot.negative[1], dot.negative[2]};
    for (std::size_t k = 0; k < count; ++k) {
      std::int32_t term[3];
      for (std::size_t i = 0; i < 3; ++i)
        term[i] = DotProduct::signed_term(products[i][n[i][k]], (sign[i][k] ^ flip[i]) != 0);
      index[k] = adder.index(adder.sum(term[0], term[1], term[2]));
    }
  };
  index_into(light.diffuse, scratch_.diffuse_index.data());
  index_into(light.specular, scratch_.specular_index.data());
  const std::uint32_t* base = scratch_.base.data();
  const std::uint32_t* visible = scratch_.visible.data();
  const std::uint32_t* diffuse_index = scratch_.diffuse_index.data();
  const std::uint32_t* specular_index = scratch_.specular_index.data();
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint8_t* diffuse = tables.diffuse[c].data();
    const std::uint8_t* specular = tables.specular[tables.specular.size() == 1 ? 0 : c].data();
    std::uint32_t* sum = scratch_.sum[c].data();
    for (std::size_t k = 0; k < count; ++k)
      sum[k] +=
          visible[k] * (std::uint32_t{diffuse[base[k] + diffuse_index[k]]} + specular[base[k] + specular_index[k]]);
  }
}

void DeferredShader::finish(std::size_t count, frame::RgbLine& out) {
  const std::vector<std::uint8_t>& ambient = std::as_const(*this).front().ambient;
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

// A copy is worth its making where nobody has written since the line before; a bank that is being written is read as it
// stands.
const ShadeTables* DeferredShader::copy_of_tables() {
  Bank& bank = banks_[front_];
  if (bank.state == Bank::Copy::stale) {
    bank.state = Bank::Copy::wanted;
    return nullptr;
  }
  if (bank.state == Bank::Copy::wanted) {
    std::vector<std::size_t> lit;
    for (std::size_t l = 0; l < lights_.size(); ++l)
      if (lights_[l].set) lit.push_back(l);
    bank.copy = ShadeTables::of(bank.tables, normaliser_, parameters_, magnitude_bits_ + 1, lit, *kernels_);
    bank.state = Bank::Copy::made;
  }
  return bank.copy ? &*bank.copy : nullptr;
}

void DeferredShader::shade_line_from(const ShadeTables& tables, const frame::FragmentLine& in, frame::RgbLine& out) {
  const std::size_t begin = std::min(in.begin, in.columns());
  const std::size_t end = std::clamp(in.end, begin, in.columns());
  paint(0, begin, out);
  paint(end, in.columns(), out);
  ShadeRequest request = tables.request();
  request.normal[0] = in.normal_x.data() + begin;
  request.normal[1] = in.normal_y.data() + begin;
  request.normal[2] = in.normal_z.data() + begin;
  request.material = in.material.data() + begin;
  request.object = in.object.data() + begin;
  request.count = end - begin;
  request.rgb = out.levels.data() + 3 * begin;
  const ShadeTotals totals = kernels_->shade(request);
  check_material(totals.largest_material, totals.pixels);
  counters_.pixels += totals.pixels;
  counters_.zero_normals += totals.zero_normals;
  counters_.short_normals += totals.short_normals;
  counters_.saturated_pixels += totals.saturated_pixels;
}

void DeferredShader::shade_line_by_stages(const frame::FragmentLine& in, frame::RgbLine& out) {
  if (scratch_.column.size() < in.columns()) scratch_.resize(in.columns());
  const std::size_t count = gather(in, out);
  normalise(count);
  for (auto& sum : scratch_.sum) std::fill_n(sum.begin(), count, 0U);
  const TableBank& tables = std::as_const(*this).front();
  for (std::size_t l = 0; l < tables.lights.size(); ++l)
    if (lights_[l].set) add_light(tables.lights[l], tables.material_tables[l], count);
  finish(count, out);
}

void DeferredShader::shade_line(const frame::FragmentLine& in, frame::RgbLine& out) {
  if (out.columns() != in.columns()) out.resize(in.columns());
  if (const ShadeTables* tables = copy_of_tables())
    shade_line_from(*tables, in, out);
  else
    shade_line_by_stages(in, out);
}

}  // namespace rastertlm::shading
