// The deferred shading processor (004, section 5.3.4, figure 5.8): normals and materials of the nearest objects in, RGB
// levels out. One normaliser; for each light two dot-product units, three diffuse tables and one or three specular
// tables; adders that saturate.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/shading/dot_product.h"
#include "modules/shading/normaliser.h"
#include "modules/shading/parameters.h"
#include "modules/shading/path_rom.h"
#include "modules/shading/shade_kernels.h"
#include "modules/shading/shade_tables.h"
#include "modules/shading/table_bank.h"
#include "modules/shading/table_load.h"
#include "src/base/vector_variant.h"
#include "src/frame/scan_line.h"

namespace rastertlm::shading {

using Rgb = std::array<double, 3>;
using Direction = std::array<double, 3>;
using Levels = std::array<std::uint8_t, 3>;

// As in a scene: coefficients from 0; colour 0..1 a channel.
struct MaterialArguments {
  Rgb colour{1, 1, 1};
  double ambient = 0.0;   // Ka
  double diffuse = 0.0;   // Kd
  double specular = 0.0;  // Ks
  std::int64_t exponent = 1;
};

// Unit vectors in eye space, both constant over the frame: towards the light, and half way between it and the viewer.
struct LightArguments {
  Direction towards{0, 0, 1};
  Direction halfway{0, 0, 1};
  Rgb intensity{1, 1, 1};
};

struct ShadingCounters {
  std::uint64_t pixels = 0;            // shaded
  std::uint64_t short_normals = 0;     // whose inverse root is clamped
  std::uint64_t zero_normals = 0;      // diffuse and specular 0
  std::uint64_t saturated_pixels = 0;  // a channel's sum was above full scale
  friend bool operator==(const ShadingCounters&, const ShadingCounters&) = default;
};

// A memory or register set of the processor: `instances` of `words` of `bits_per_word`.
struct MemorySize {
  std::string name;
  std::uint64_t instances = 0;
  std::uint64_t words = 0;
  std::uint64_t bits_per_word = 0;
};
struct LogicSize {
  std::string name;
  std::uint64_t instances = 0;
  std::uint64_t bits = 0;
};

class DeferredShader {
 public:
  // The parameters have passed ShadingParameters::check(normal_bits). `banks`: 1 or 2 copies of the loaded tables.
  DeferredShader(const ShadingParameters& parameters, std::int64_t normal_bits, std::size_t banks = 1,
                 VectorVariant variant = vector_variant());

  // What the next load brings into the tables. Throws InputError for an exponent that the ROM does not hold, or an
  // index that the machine does not have; `key` names the value in the scene file. Products above 1 are clamped to full
  // scale: see warnings().
  void set_material(std::size_t index, const MaterialArguments& material, const std::string& key = "exponent");
  void set_light(std::size_t index, const LightArguments& light);
  void set_ambient_light(const Rgb& intensity) { ambient_light_ = intensity; }
  void set_background(const Rgb& levels) { background_ = levels; }  // levels 0..255
  // One sentence for each product of light and material that is above 1.
  std::vector<std::string> warnings() const;

  // Light words, magnitude and sign: literal round((2^bits - 1) |l|), centred round(2^bits |l|).
  std::uint32_t light_word(double component) const;

  // The jobs whose arguments differ from what `record` says a bank holds, of the lights that were set and of
  // `materials` (those set), in the order dot products, diffuse, specular, light by light; all registers.
  LoadProgram program(const LoadRecord& record, std::span<const std::size_t> materials) const;
  LoadProgram program(const LoadRecord& record) const;  // of every material that was set

  // Tables in use, and tables being written (the same where there is one bank). What is got to be written must not be
  // written after the next line: a line is shaded from a copy if nobody asked for the tables since the line before.
  const TableBank& front() const { return banks_[front_].tables; }
  TableBank& front() { return written(banks_[front_]); }
  LoadRecord& front_record() { return banks_[front_].record; }
  TableBank& back() { return written(banks_[back_index()]); }
  LoadRecord& back_record() { return banks_[back_index()].record; }
  void swap_banks() { front_ = back_index(); }
  // Brings everything into the front bank at once: the state after a load that had all the time it needs.
  void load();
  static void write_registers(const LoadProgram& program, TableBank& bank);

  // One pixel from the front bank; words of normal_bits as on the link.
  Levels shade_pixel(std::uint32_t normal_x, std::uint32_t normal_y, std::uint32_t normal_z, std::uint32_t material,
                     ShadingCounters& counters) const;
  // All columns of `out` (which has in.columns() columns): background where nothing is seen. Throws ModelError for a
  // material that the tables do not have. The same levels and counts as shade_pixel (tested).
  void shade_line(const frame::FragmentLine& in, frame::RgbLine& out);

  const ShadingCounters& counters() const { return counters_; }
  const ShadingParameters& parameters() const { return parameters_; }
  const Normaliser& normaliser() const { return normaliser_; }
  const DotProduct& dot_product() const { return dot_product_; }
  const PathRom& path_rom() const { return path_rom_; }

  // Every table and register, for the memory budget; adders, multipliers and comparators, for the logic budget.
  std::vector<MemorySize> memories() const;
  std::vector<LogicSize> logic() const;

 private:
  // `copy` is what the kernel reads.
  struct Bank {
    enum class Copy { stale, wanted, made };
    TableBank tables;
    LoadRecord record;
    Copy state = Copy::stale;
    std::optional<ShadeTables> copy;
  };
  static TableBank& written(Bank& bank) {
    bank.state = Bank::Copy::stale;
    return bank.tables;
  }
  // Covered pixels of a line, gathered: structure of arrays for the vector units.
  struct Scratch {
    std::vector<std::uint32_t> column, base, visible, squares, diffuse_index, specular_index;
    std::array<std::vector<std::uint32_t>, 3> word, magnitude, negative, sum;
    void resize(std::size_t columns);
  };
  struct SetMaterial {
    bool set = false;
    MaterialArguments arguments;
  };
  struct SetLight {
    bool set = false;
    LightArguments arguments;
  };

  std::size_t back_index() const { return banks_.size() == 1 ? 0 : 1 - front_; }
  std::uint32_t diffuse_constant(const LightArguments& light, const MaterialArguments& material,
                                 std::size_t channel) const;
  std::uint32_t specular_constant(const LightArguments& light, const MaterialArguments& material,
                                  std::size_t table) const;
  double specular_product(const LightArguments& light, const MaterialArguments& material, std::size_t table) const;
  void add_light_jobs(std::size_t light, std::span<const std::size_t> materials, std::vector<TableJob>& jobs) const;
  std::vector<RegisterWrite> registers() const;

  const ShadeTables* copy_of_tables();
  void shade_line_from(const ShadeTables& tables, const frame::FragmentLine& in, frame::RgbLine& out);
  void shade_line_by_stages(const frame::FragmentLine& in, frame::RgbLine& out);
  void paint(std::size_t first, std::size_t last, frame::RgbLine& out) const;
  void check_material(std::uint32_t largest, std::size_t pixels) const;
  std::size_t gather(const frame::FragmentLine& in, frame::RgbLine& out);
  void normalise(std::size_t count);
  void add_light(const LightTables& light, const MaterialTables& tables, std::size_t count);
  void finish(std::size_t count, frame::RgbLine& out);

  ShadingParameters parameters_;
  unsigned magnitude_bits_;
  std::uint32_t full_level_;
  Normaliser normaliser_;
  DotProduct dot_product_;
  PathRom path_rom_;
  std::vector<std::uint8_t> display_;  // level of level_bits -> 0..255
  std::vector<SetMaterial> materials_;
  std::vector<SetLight> lights_;
  Rgb ambient_light_{1, 1, 1};
  Rgb background_{0, 0, 0};
  std::vector<Bank> banks_;
  std::size_t front_ = 0;
  ShadingCounters counters_;
  Scratch scratch_;
  const ShadeKernels* kernels_;
};

}  // namespace rastertlm::shading
