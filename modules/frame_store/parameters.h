// What a frame store is: declared once, here.
#pragma once

#include <cstdint>
#include <string>

#include "src/base/errors.h"
#include "src/parameter/table.h"

namespace rastertlm::frame_store {

// retrace: what is drawn is shown from the next vertical retrace on. completion: as soon as it is whole.
enum class Swap { retrace, completion };
// shared: the screen's lines are read through the port that pixels are written through. separate: a port of its own
// (video memory).
enum class ScanOut { shared, separate };

inline constexpr std::int64_t kMostBanks = 64;
inline constexpr unsigned kColourBits = 24;
inline constexpr unsigned kTieBits = 24;  // the triangle's number, where several units draw in any order

struct FrameStoreParameters {
  std::string preset = "sram_25";
  bool depth_test = true;
  double access_ns = 25.0;
  std::int64_t width_bits = 64;
  std::int64_t banks = 1;
  std::int64_t buffers = 2;
  bool clear = true;
  Swap swap = Swap::retrace;
  ScanOut scan_out = ScanOut::separate;

  // Paths "frame_store.depth_test" ...
  void declare(parameter::Table& table);
  // Times that are no whole number of picoseconds.
  void check(const std::string& file, Diagnostics& diagnostics) const;

  std::uint64_t access_ps() const;
  // A screen that is being shown may change: by a swap, or by what is drawn into the one buffer.
  bool changes_while_shown() const { return swap == Swap::completion; }
};

}  // namespace rastertlm::frame_store
