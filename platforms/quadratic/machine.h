// The quadratic-shading machine (000/001) as a machine file describes it: the units' parameters joined into one table.
#pragma once

#include <cstdint>
#include <string>

#include "modules/frame_store/memory_schedule.h"
#include "modules/frame_store/parameters.h"
#include "modules/host/parameters.h"
#include "modules/host/set_up_work.h"
#include "modules/host/software_renderer.h"
#include "modules/pixel_unit/parameters.h"
#include "modules/set_up/parameters.h"
#include "modules/set_up/word_format.h"
#include "modules/span_unit/parameters.h"
#include "modules/video/parameters.h"
#include "src/base/errors.h"
#include "src/geometry/snapping.h"
#include "src/parameter/table.h"

namespace rastertlm::quadratic {

enum class Platform { quadratic };
enum class Fidelity { line };

struct Machine {
  std::int64_t schema = 1;
  Platform platform = Platform::quadratic;
  Fidelity fidelity = Fidelity::line;
  video::VideoParameters video;
  host::ProcessorParameters host;
  set_up::SetUpParameters set_up;
  span_unit::SpanUnitParameters span_unit;
  pixel_unit::PixelUnitParameters pixel_unit;  // of machines whose method shades pixels
  frame_store::FrameStoreParameters frame_store;
  host::SoftwareParameters software;  // that the machine is compared with

  const char* platform_name = "quadratic";

  void declare(parameter::Table& table);
  // What no single range can say; `file` names the machine file in the diagnostics.
  void check(Diagnostics& diagnostics, const std::string& file) const;

  geometry::Viewport viewport() const {
    return {static_cast<std::size_t>(video.columns), static_cast<std::size_t>(video.lines)};
  }
  host::SetUpFormat set_up_format() const;
  // Depth from near to far on this screen.
  set_up::WordFormat depth_format() const;
  // Numbers of triangles are stored for ties where several units draw in an order of their own.
  bool stores_numbers() const { return span_unit.units > 1 && span_unit.share == span_unit::Share::triangles; }
  frame_store::MemoryLayout layout() const;

 protected:
  // What machines with a span unit have in common.
  void declare_file(parameter::Table& table);
  void declare_units(parameter::Table& table);
  void check_units(Diagnostics& diagnostics, const std::string& file) const;

 private:
  void check_depth(Diagnostics& diagnostics, const std::string& file) const;
};

}  // namespace rastertlm::quadratic
