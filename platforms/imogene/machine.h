// The I.M.O.G.E.N.E. machine as a machine file describes it: the units' parameters joined into one table.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "modules/decision_unit/parameters.h"
#include "modules/host/parameters.h"
#include "modules/object_processor/parameters.h"
#include "modules/quadric_processor/parameters.h"
#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/shading/loader_parameters.h"
#include "modules/shading/parameters.h"
#include "modules/video/parameters.h"
#include "modules/video/timing.h"
#include "src/base/errors.h"
#include "src/geometry/snapping.h"
#include "src/parameter/table.h"

namespace rastertlm::imogene {

enum class Platform { imogene };
enum class Fidelity { line };

struct Machine {
  std::int64_t schema = 1;
  Platform platform = Platform::imogene;
  Fidelity fidelity = Fidelity::line;
  video::VideoParameters video;
  host::HostParameters host;
  object_processor::ObjectProcessorParameters object_processor;
  quadric_processor::QuadricParameters quadric;
  decision_unit::DecisionUnitParameters decision_unit;
  shading::ShadingParameters shading;
  shading::LoaderParameters loader;

  void declare(parameter::Table& table);
  // What no single range can say; `file` names the machine file in the diagnostics.
  void check(Diagnostics& diagnostics, const std::string& file) const;

  std::uint64_t triangle_processors() const;
  std::uint64_t quadric_processors() const;
  std::uint64_t processors() const { return triangle_processors() + quadric_processors(); }
  unsigned material_bits() const;  // of a link word: enough for every material, at least 1
};

// What the object boards must do before pixels come, in pixel clocks.
struct BoardNeeds {
  Cycles line_start;   // the line start microprogram of triangles, once
  Cycles frame_start;  // the copy of loading RAMs: in every retrace C comes back, which the sums of lines have replaced
  Cycles skew;         // by which the last processor of a pipeline is behind the first; 0 in a tree
  Cycles quadric_line_start{};  // of quadrics, where there are any: with the steps over the lines of the other field
  // Of the first line of each field, with what they begin earlier than triangles' are.
  std::array<Cycles, 2> quadric_first_lines{};
  Cycles quadric_lead{};  // by which quadrics begin their lines before triangles do: the retrace holds that too
  Cycles copy() const { return skew + frame_start; }  // until the last processor has copied
  Cycles retrace() const { return copy() + quadric_lead; }
};
BoardNeeds board_needs(const Machine& machine);

// From a quadric's words to its fragment, which a triangle has at once; 0 where there are no quadrics.
Cycles quadric_latency(const Machine& machine);

// By how much quadrics are later than triangles; nothing where they start earlier, or there are none.
Cycles quadric_delay(const Machine& machine);

// By how much quadrics begin their lines before triangles do; nothing where triangles wait, or there are none.
Cycles quadric_lead(const Machine& machine);

// Pixel clocks of a displayed frame in which a quadric board begins lines.
Cycles quadric_line_starts(const Machine& machine);

// The depth words of the near and the far plane.
quadric_processor::DepthRange depth_range(const Machine& machine);

// The grids of this machine's edge words. Throws InputError with the word width that would do, where none fits.
geometry::SnapGrids snap_grids(const Machine& machine);

}  // namespace rastertlm::imogene
