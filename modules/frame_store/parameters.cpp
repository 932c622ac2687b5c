#include "modules/frame_store/parameters.h"

#include <fmt/format.h>

#include <cmath>

namespace rastertlm::frame_store {

using parameter::About;

namespace {
constexpr double kPicosecondsANanosecond = 1000.0;
}

void FrameStoreParameters::declare(parameter::Table& table) {
  const std::string rate = "answer.frame_rate_hz, units[] frame store";
  table.text("frame_store.preset", preset,
             About{"", "Memory: sets the frame store's keys that the file does not.", rate});
  table.boolean(
      "frame_store.depth_test", depth_test,
      About{"", "The nearest is kept, by a depth buffer; otherwise what is drawn last.", "the picture, " + rate});
  table.real("frame_store.access_ns", access_ns, {0.001, 1e6}, About{"ns", "Time of one memory access.", rate});
  table.integer("frame_store.width_bits", width_bits, {8, 4096},
                About{"bits", "Width of an access of one bank.", rate});
  table.integer("frame_store.banks", banks, {1, kMostBanks},
                About{"banks", "Banks that work side by side, words dealt to them in turn along a line.", rate});
  table.integer("frame_store.buffers", buffers, {1, 2},
                About{"buffers", "Pictures that the store holds: one is drawn while the other is shown.",
                      "memories[] frame store, " + rate});
  table.boolean(
      "frame_store.clear", clear,
      About{"", "The buffer is cleared before a frame is drawn; otherwise what was drawn into it before stays.",
            "the picture, " + rate});
  table.choice("frame_store.swap", swap, {"retrace", "completion"},
               About{"", "When a picture that has been drawn is shown.", rate});
  table.choice("frame_store.scan_out", scan_out, {"shared", "separate"},
               About{"", "Whether the screen is read through the port that pixels are drawn through.", rate});
}

void FrameStoreParameters::check(const std::string& file, Diagnostics& diagnostics) const {
  constexpr double kNoise = 1e-6;  // of a decimal fraction as a double
  const double picoseconds = access_ns * kPicosecondsANanosecond;
  if (std::fabs(picoseconds - std::round(picoseconds)) > kNoise)
    diagnostics.add({file, 0, "frame_store.access_ns",
                     fmt::format("{} ns is no whole number of picoseconds; the nearest that is accepted is {}",
                                 access_ns, std::round(picoseconds) / kPicosecondsANanosecond)});
}

std::uint64_t FrameStoreParameters::access_ps() const {
  return static_cast<std::uint64_t>(std::llround(access_ns * kPicosecondsANanosecond));
}

}  // namespace rastertlm::frame_store
