// What crosses the links between boards: one transaction a scan line. The payloads derive from tlm_generic_payload
// because the simple sockets ask for it; its command, address and data mean nothing here.
#pragma once

#include <array>
#include <cstdint>
#include <tlm>

#include "modules/stream/line_pool.h"
#include "src/frame/covered_line.h"
#include "src/frame/scan_line.h"

namespace rastertlm::stream {

// Lines whose numbers differ by less, from a multiple of it on, may travel together: a band.
inline constexpr std::size_t kBandLines = 8;

// Some lines of a band, one after the other; or just one.
struct Lines {
  std::size_t first = 0;
  std::size_t count = 1;
  std::size_t step = 1;                              // between their numbers: 2 where the video is interlaced
  std::array<std::uint64_t, kBandLines> later_ps{};  // by which each begins after the first

  std::size_t number(std::size_t k) const { return first + k * step; }
  friend bool operator==(const Lines&, const Lines&) = default;
};

// What a board covers of some lines, before anybody looks at a pixel of it.
struct SpanLines {
  Lines lines;
  std::array<const frame::CoveredLine*, kBandLines> covered{};  // of each
};

// A scan line of fragments on its way to the screen: its pixels; or, from a board, the spans of some lines, to which
// pixels are what is seen of them in the end. Whoever receives it takes the handle, and may write into the line; spans
// stay the sender's, until it is told of other lines.
struct FragmentPayload : tlm::tlm_generic_payload {
  std::uint64_t frame = 0;  // displayed frame
  std::size_t line = 0;     // of pixels
  LinePool::Handle fragments;
  const SpanLines* spans = nullptr;
};

// A shaded line. `fragments` is what observers may look at beside the levels.
struct RgbPayload : tlm::tlm_generic_payload {
  std::uint64_t frame = 0;
  std::size_t line = 0;
  const frame::RgbLine* rgb = nullptr;
  const frame::FragmentLine* fragments = nullptr;
};

// The video timing's signals: vertical retrace begins (with or without a copy of the loading RAMs), or a line begins;
// or, where nobody minds, the lines of a band begin, one after the other.
struct SyncPayload : tlm::tlm_generic_payload {
  enum class Kind { retrace, line };
  Kind kind = Kind::line;
  std::uint64_t frame = 0;
  Lines lines;         // line
  bool copy = false;   // retrace: loading RAMs go to backup RAMs
  bool whole = false;  // retrace: they hold a whole frame, with which the computation units have finished
  bool swap = false;   // retrace: so do the tables, and the hosts go on to the next frame
  bool switch_tables =
      false;  // retrace: set by the table loader for the shading processor behind it: use the other bank
};

template <class Payload>
struct Protocol {
  using tlm_payload_type = Payload;
  using tlm_phase_type = tlm::tlm_phase;
};

using FragmentProtocol = Protocol<FragmentPayload>;
using RgbProtocol = Protocol<RgbPayload>;
using SyncProtocol = Protocol<SyncPayload>;

// A socket's BUSWIDTH has no meaning here: width, clock and latency belong to the Link.
inline constexpr unsigned kNoBusWidth = 32;

}  // namespace rastertlm::stream
