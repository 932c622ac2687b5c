// Who fills the tables of the shading processor, when, and what a step costs (004, sections 5.3.5 and 5.3.6).
#pragma once

#include <cstdint>
#include <string>

#include "modules/shading/parameters.h"
#include "src/base/errors.h"
#include "src/parameter/table.h"

namespace rastertlm::shading {

enum class LoaderKind { mc68000, sequencer };
enum class LoadTime { frame, retrace };
enum class Overrun { refuse, show };
enum class LoadedMaterials { used, all };

// What a 68000 does for an entry of a ramp: add, store, and a share of the loop's end. A preset is a loop with the
// clock that 004 gives it: configs/presets/loader.dot, loader.diffuse.
struct RampLoop {
  std::string preset;
  double clock_mhz = 0.0;
  double body_cycles = 0.0;  // an entry, without the end of the loop
  double loop_cycles = 0.0;  // dbra, taken
  std::int64_t unroll = 1;   // entries a pass of the loop; 0: straight-line code, no dbra
  double cycles = 0.0;       // an entry, whatever the loop says; 0: what the loop says
  std::int64_t units = 1;    // loaders that share the work of one

  double cycles_an_entry() const;
  // The fewest from one store to the next: of a loop that is unrolled, within a pass.
  double cycles_between_stores() const;
  // How cycles_an_entry() comes about: "26 cycles (add_l_move_w: 16 + 10 / 1)".
  std::string text() const;
};

// What a 68000 does for the moves of a path, which are its program: no loop. configs/presets/loader.specular.
struct PathProgram {
  std::string preset;
  double clock_mhz = 0.0;
  double right_cycles = 0.0;  // store, next address
  double up_cycles = 0.0;     // add Ks; also what an argument step costs
  std::int64_t units = 1;
};

struct LoaderParameters {
  LoaderKind kind = LoaderKind::mc68000;
  LoadTime when = LoadTime::frame;                    // frame: two banks; retrace: one
  Overrun on_overrun = Overrun::refuse;               // of the retrace
  LoadedMaterials materials = LoadedMaterials::used;  // of those that changed
  std::int64_t argument_cycles = 1;                   // steps to change exponent and Ks, a material (004: "1280")
  double sequencer_clock_ns = 60.0;                   // one step a clock
  // The defaults are those of the presets that they name, where the reasons stand.
  RampLoop dot{.preset = "add_l_move_w", .clock_mhz = 8.0, .body_cycles = 16.0, .loop_cycles = 10.0, .unroll = 1};
  RampLoop diffuse{.preset = "add_l_move_w", .clock_mhz = 16.0, .body_cycles = 16.0, .loop_cycles = 10.0, .unroll = 4};
  PathProgram specular{.preset = "move_l_add_l", .clock_mhz = 12.5, .right_cycles = 12.0, .up_cycles = 8.0};

  // Paths "loader.kind" ...
  void declare(parameter::Table& table);
  // More loaders than there is work to share. Adds to `diagnostics`; file names the machine file.
  void check(const ShadingParameters& shading, const std::string& file, Diagnostics& diagnostics) const;
};

}  // namespace rastertlm::shading
