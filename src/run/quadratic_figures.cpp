#include "src/run/quadratic_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "modules/frame_store/memory_limits.h"
#include "modules/span_unit/parameters.h"

namespace rastertlm::run {
namespace {

using quadratic::Quadratic;

constexpr double kPicosecond = 1e-12;

// The processor writes its words itself: while it computes the bus waits for them, and where no register set is free
// they wait with it.
stream::Occupancy bus_occupancy(const Quadratic& platform) {
  stream::Occupancy bus;
  for (const quadratic::ShownFrame& frame : platform.frames()) {
    bus.busy += frame.set_up.writing.count();
    bus.starved += frame.set_up.computing.count();
    bus.blocked += frame.set_up.blocked.count();
  }
  bus.cycles = bus.busy + bus.starved + bus.blocked;
  return bus;
}

// The display is sent pixels whatever happens; before the first picture there is nothing to send.
stream::Occupancy scan_out_occupancy(const Quadratic& platform) {
  const video::Timing& timing = platform.timing();
  const auto lines = static_cast<std::uint64_t>(platform.machine().video.lines);
  stream::Occupancy screen;
  screen.cycles = timing.clock.cycles_at(platform.end_ps()).count();
  const std::uint64_t sent = timing.pixels_sent(Cycles(screen.cycles), lines);
  screen.busy = platform.links().at(Quadratic::kScreenLink).words();
  screen.starved = sent - screen.busy;
  screen.idle = screen.cycles - sent;
  return screen;
}

}  // namespace

std::vector<UnitFigures> unit_figures(const Quadratic& platform) {
  std::vector<UnitFigures> units;
  const std::uint64_t end = platform.end_ps();
  // To the end of the run, whose rest a unit that has nothing left to do is idle.
  const auto add = [&](const std::string& name, const Clock& clock, stream::Occupancy o) {
    const std::uint64_t passed = std::max(clock.cycles_at(end).count(), o.cycles);
    o.idle += passed - o.cycles;
    o.cycles = passed;
    o.check(name);
    units.push_back({name, clock.frequency_hz(), o.cycles, o.busy, o.starved, o.blocked, o.idle, clock.name()});
  };
  const Clock& host = platform.cost().clock();
  add("set-up processor", host, platform.set_up_processor().occupancy());
  add("bus", host, bus_occupancy(platform));
  const std::vector<stream::Occupancy> spans = platform.span_unit().occupancies();
  for (std::size_t k = 0; k < spans.size(); ++k)
    add(spans.size() > 1 ? fmt::format("span unit {}", k) : std::string("span unit"),
        platform.machine().span_unit.clock(), spans[k]);
  if (platform.pixel_unit() != nullptr)
    add("pixel unit", platform.machine().pixel_unit.clock(), platform.pixel_unit()->occupancy());
  add("frame store", platform.frame_store().clock(), platform.frame_store().occupancy(end));
  add("scan-out", platform.timing().clock, scan_out_occupancy(platform));
  return units;
}

std::vector<LinkFigures> link_figures(const Quadratic& platform) {
  std::vector<LinkFigures> figures;
  const double seconds = static_cast<double>(platform.frames().back().set_up.shown_ps) * kPicosecond;
  for (const stream::Link& link : platform.links()) {
    LinkFigures f;
    f.name = link.name();
    f.bits = link.bits();
    f.clock_hz = link.clock().frequency_hz();
    f.bytes = link.bytes();
    f.peak_bytes_per_s = link.peak_bytes_per_second();
    const double active = link.clock().seconds(link.active());
    f.active_bytes_per_s = active > 0.0 ? static_cast<double>(link.bytes()) / active : 0.0;
    f.achieved_bytes_per_s = seconds > 0.0 ? static_cast<double>(link.bytes()) / seconds : 0.0;
    f.utilisation = f.achieved_bytes_per_s / f.peak_bytes_per_s;
    figures.push_back(f);
  }
  return figures;
}

// The frame store's are what its layout puts side by side for a pixel, in every buffer.
std::vector<Memory> memory_figures(const quadratic::Machine& m) {
  const frame_store::MemoryLayout store = m.layout();
  std::vector<Memory> memories;
  for (const auto& [name, bits] :
       {std::pair("frame store, colour", store.colour_bits), std::pair("frame store, depth", store.depth_bits),
        std::pair("frame store, triangle numbers", store.number_bits)})
    if (bits > 0) memories.push_back({name, store.buffers, store.columns * store.lines, bits});
  // Six registers a channel and three of depth, and the edges' and lines' in each set; a set is drawn from.
  const auto sets = static_cast<std::uint64_t>((m.span_unit.shadow_sets + 1) * m.span_unit.units);
  const bool linear = m.set_up.linear();
  memories.push_back({"span unit, colour registers", sets, span_unit::kChannels * (linear ? 3U : 6U),
                      static_cast<std::uint64_t>(m.span_unit.word_bits)});
  memories.push_back({"span unit, depth registers", sets, 3,
                      static_cast<std::uint64_t>(m.span_unit.depth_bits + m.span_unit.depth_fraction_bits)});
  return memories;
}

std::vector<Logic> logic_figures(const Quadratic& platform) {
  const span_unit::SpanUnitParameters& p = platform.machine().span_unit;
  const auto units = static_cast<std::uint64_t>(p.units);
  const bool linear = platform.machine().set_up.linear();
  const bool rank = p.start_edge == span_unit::StartEdge::lattice && p.carry == span_unit::Carry::rank;
  // Figure 6: two adders a channel along the line, three at the start edge, and as many again for carries at once.
  const std::uint64_t channel = linear ? 2U + (rank ? 1U : 0U) : 5U + (rank ? 3U : 0U);
  std::vector<Logic> logic{
      {"adders of colour channels", units * span_unit::kChannels * channel, "adders"},
      {"adders of depth", units * (2U + (rank ? 1U : 0U)), "adders"},
      {"comparators of line ends", units, "comparators"},
      {"counters of columns and lines", 2 * units, "counters"},
  };
  if (p.start_edge == span_unit::StartEdge::prestep)
    logic.push_back({"short multipliers", units * (3 * span_unit::kChannels + 1), "multipliers"});
  const quadratic::Machine& m = platform.machine();
  if (m.frame_store.depth_test) logic.push_back({"comparators of depth", units, "comparators"});
  const frame_store::MemoryPins pins = frame_store::memory_pins(m.frame_store, m.layout());
  logic.push_back({"frame store: data", pins.data, "pins"});
  logic.push_back({"frame store: address and control", pins.address + pins.control, "pins"});
  return logic;
}

}  // namespace rastertlm::run
