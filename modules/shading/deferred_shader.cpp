#include "modules/shading/deferred_shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/errors.h"
#include "src/base/fixed_point.h"

namespace rastertlm::shading {
namespace {

double clamp_product(double value) { return std::clamp(value, 0.0, 1.0); }
std::uint32_t rounded(double value) { return static_cast<std::uint32_t>(round_half_up(value)); }

// The constant of a diffuse product as the processor is given it.
double diffuse_product(const LightArguments& light, const MaterialArguments& material, std::size_t channel) {
  return light.intensity[channel] * material.diffuse * material.colour[channel];
}

}  // namespace

DeferredShader::DeferredShader(const ShadingParameters& parameters, std::int64_t normal_bits, std::size_t banks,
                               VectorVariant variant)
    : parameters_(parameters),
      magnitude_bits_(static_cast<unsigned>(normal_bits - 1)),
      full_level_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.level_bits)))),
      normaliser_(parameters, normal_bits),
      dot_product_(parameters),
      path_rom_(parameters),
      materials_(static_cast<std::size_t>(parameters.materials)),
      lights_(static_cast<std::size_t>(parameters.lights)),
      banks_(banks == 2 ? 2 : 1, Bank{TableBank(parameters), LoadRecord(), Bank::Copy::stale, std::nullopt}),
      kernels_(&shade_kernels(variant)) {
  // A converter of fewer bits still drives the display to full scale.
  for (std::uint32_t level = 0; level <= full_level_; ++level)
    display_.push_back(static_cast<std::uint8_t>((level * 510 + full_level_) / (2 * full_level_)));
}

void DeferredShader::set_material(std::size_t index, const MaterialArguments& material, const std::string& key) {
  if (index >= materials_.size())
    throw InputError(
        {"", 0, key,
         fmt::format("material {} of a machine with {} (shading.materials)", index + 1, materials_.size())});
  static_cast<void>(path_rom_.path(material.exponent, key));
  materials_[index] = {true, material};
}

void DeferredShader::set_light(std::size_t index, const LightArguments& light) {
  if (index >= lights_.size())
    throw InputError(
        {"", 0, "light", fmt::format("light {} of a machine with {} (shading.lights)", index + 1, lights_.size())});
  lights_[index] = {true, light};
  for (Bank& bank : banks_) written(bank);
}

std::uint32_t DeferredShader::light_word(double component) const {
  const double one = std::ldexp(1.0, static_cast<int>(parameters_.dot_table_output_bits));
  return rounded((parameters_.arithmetic == Arithmetic::literal ? one - 1.0 : one) *
                 std::min(1.0, std::abs(component)));
}

std::uint32_t DeferredShader::diffuse_constant(const LightArguments& light, const MaterialArguments& material,
                                               std::size_t channel) const {
  const auto fraction_bits = parameters_.arithmetic == Arithmetic::literal ? 0 : parameters_.diffuse_fraction_bits;
  return rounded(std::ldexp(full_level_ * clamp_product(diffuse_product(light, material, channel)),
                            static_cast<int>(fraction_bits)));
}

double DeferredShader::specular_product(const LightArguments& light, const MaterialArguments& material,
                                        std::size_t table) const {
  const double mean = (light.intensity[0] + light.intensity[1] + light.intensity[2]) / 3.0;
  return material.specular * (parameters_.specular_tables == 1 ? mean : light.intensity[table]);
}

std::uint32_t DeferredShader::specular_constant(const LightArguments& light, const MaterialArguments& material,
                                                std::size_t table) const {
  const std::uint32_t one = full_level_ + (parameters_.arithmetic == Arithmetic::literal ? 0 : 1);
  return rounded(one * clamp_product(specular_product(light, material, table)));
}

std::vector<std::string> DeferredShader::warnings() const {
  std::vector<std::string> texts;
  const auto note = [&](const std::string& what, double value, std::size_t material) {
    if (value > 1.0)
      texts.push_back(
          fmt::format("material {}: {} = {:.6g} is above 1 and is clamped to full scale", material + 1, what, value));
  };
  constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    if (!materials_[m].set) continue;
    const MaterialArguments& material = materials_[m].arguments;
    for (std::size_t c = 0; c < 3; ++c)
      note(fmt::format("Ka Ia colour ({})", kChannels[c]), material.ambient * ambient_light_[c] * material.colour[c],
           m);
    for (std::size_t l = 0; l < lights_.size(); ++l) {
      if (!lights_[l].set) continue;
      for (std::size_t c = 0; c < 3; ++c)
        note(fmt::format("Kd I colour ({}, light {})", kChannels[c], l + 1),
             diffuse_product(lights_[l].arguments, material, c), m);
      for (std::size_t t = 0; t < static_cast<std::size_t>(parameters_.specular_tables); ++t)
        note(fmt::format("Ks I (light {})", l + 1), specular_product(lights_[l].arguments, material, t), m);
    }
  }
  return texts;
}

void DeferredShader::add_light_jobs(std::size_t light, std::span<const std::size_t> materials,
                                    std::vector<TableJob>& jobs) const {
  const LightArguments& arguments = lights_[light].arguments;
  const auto specular_tables = static_cast<std::size_t>(parameters_.specular_tables);
  const std::size_t first = light * (6 + materials_.size() * (3 + specular_tables));
  const auto address_bits = static_cast<unsigned>(parameters_.dot_table_address_bits);
  const auto index_bits = static_cast<unsigned>(parameters_.index_bits);
  for (std::size_t i = 0; i < 3; ++i)
    jobs.push_back({{TableKind::diffuse_dot, light, i},
                    0,
                    product_ramp(light_word(arguments.towards[i]), address_bits, parameters_.arithmetic),
                    first + i});
  for (std::size_t i = 0; i < 3; ++i)
    jobs.push_back({{TableKind::specular_dot, light, i},
                    0,
                    product_ramp(light_word(arguments.halfway[i]), address_bits, parameters_.arithmetic),
                    first + 3 + i});
  const auto fraction_bits =
      parameters_.arithmetic == Arithmetic::literal ? 0U : static_cast<unsigned>(parameters_.diffuse_fraction_bits);
  for (std::size_t c = 0; c < 3; ++c)
    for (const std::size_t m : materials)
      jobs.push_back({{TableKind::diffuse, light, c},
                      static_cast<std::uint32_t>(m << index_bits),
                      level_ramp(diffuse_constant(arguments, materials_[m].arguments, c), index_bits, fraction_bits,
                                 parameters_.arithmetic),
                      first + 6 + c * materials_.size() + m});
  for (std::size_t t = 0; t < specular_tables; ++t)
    for (const std::size_t m : materials) {
      const MaterialArguments& material = materials_[m].arguments;
      const ScaledPath path{path_rom_.path(material.exponent),
                            path_scale(specular_constant(arguments, material, t),
                                       static_cast<unsigned>(parameters_.level_bits), parameters_.arithmetic),
                            material.exponent};
      jobs.push_back({{TableKind::specular, light, t},
                      static_cast<std::uint32_t>(m << index_bits),
                      path,
                      first + 6 + (3 + t) * materials_.size() + m});
    }
}

std::vector<RegisterWrite> DeferredShader::registers() const {
  std::vector<RegisterWrite> writes;
  for (std::size_t l = 0; l < lights_.size(); ++l) {
    std::uint32_t signs = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      signs |= static_cast<std::uint32_t>(lights_[l].arguments.towards[i] < 0) << i;
      signs |= static_cast<std::uint32_t>(lights_[l].arguments.halfway[i] < 0) << (i + 3);
    }
    if (lights_[l].set) writes.push_back({{TableKind::signs, l, 0}, 0, signs});
  }
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    const MaterialArguments& material = materials_[m].arguments;
    for (std::size_t c = 0; c < 3 && materials_[m].set; ++c) {
      const double product = clamp_product(material.ambient * ambient_light_[c] * material.colour[c]);
      writes.push_back(
          {{TableKind::ambient, 0, 0}, static_cast<std::uint32_t>(3 * m + c), rounded(full_level_ * product)});
    }
  }
  for (std::uint32_t c = 0; c < 3; ++c)
    writes.push_back({{TableKind::background, 0, 0}, c, rounded(std::clamp(background_[c], 0.0, 255.0))});
  return writes;
}

LoadProgram DeferredShader::program(const LoadRecord& record, std::span<const std::size_t> materials) const {
  std::vector<std::size_t> wanted;
  for (const std::size_t m : materials)
    if (m < materials_.size() && materials_[m].set) wanted.push_back(m);
  LoadProgram program;
  for (std::size_t l = 0; l < lights_.size(); ++l)
    if (lights_[l].set) add_light_jobs(l, wanted, program.jobs);
  std::erase_if(program.jobs, [&](const TableJob& job) { return record.holds(job); });
  program.registers = registers();
  return program;
}

LoadProgram DeferredShader::program(const LoadRecord& record) const {
  std::vector<std::size_t> all;
  for (std::size_t m = 0; m < materials_.size(); ++m) all.push_back(m);
  return program(record, all);
}

void DeferredShader::write_registers(const LoadProgram& program, TableBank& bank) {
  for (const RegisterWrite& write : program.registers) bank.write(write.table, write.entry, write.value);
}

void DeferredShader::load() {
  const LoadProgram changes = program(front_record());
  for (const TableJob& job : changes.jobs) {
    run(job, front());
    front_record().mark(job);
  }
  write_registers(changes, front());
}

Levels DeferredShader::shade_pixel(std::uint32_t normal_x, std::uint32_t normal_y, std::uint32_t normal_z,
                                   std::uint32_t material, ShadingCounters& counters) const {
  const TableBank& tables = front();
  const NormalisedNormal normal = normaliser_.normalise(normal_x, normal_y, normal_z);
  std::array<std::uint32_t, 3> sum{};
  for (std::size_t c = 0; c < 3; ++c) sum[c] = tables.ambient.at(3 * material + c);
  const std::size_t base = std::size_t{material} << parameters_.index_bits;
  for (std::size_t l = 0; l < tables.lights.size() && !normal.is_zero; ++l) {
    const std::size_t diffuse = base + dot_product_.evaluate(tables.lights[l].diffuse, normal);
    const std::size_t specular = base + dot_product_.evaluate(tables.lights[l].specular, normal);
    const MaterialTables& levels = tables.material_tables[l];
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += levels.diffuse[c][diffuse] + levels.specular[levels.specular.size() == 1 ? 0 : c][specular];
  }
  Levels out{};
  bool saturated = false;
  for (std::size_t c = 0; c < 3; ++c) {
    saturated = saturated || sum[c] > full_level_;
    out[c] = display_[std::min(sum[c], full_level_)];
  }
  counters.pixels += 1;
  counters.short_normals += normal.is_short ? 1 : 0;
  counters.zero_normals += normal.is_zero ? 1 : 0;
  counters.saturated_pixels += saturated ? 1 : 0;
  return out;
}

}  // namespace rastertlm::shading
