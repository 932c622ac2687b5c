// A table loader and its shading processor between a host, a video timing and a screen of the test.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "modules/shading/deferred_shading_module.h"
#include "modules/shading/table_loader_module.h"
#include "modules/stream/simulated_time.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::shading {

using Edge = stream::Edges::Edge;

inline constexpr std::uint64_t kMicrosecond = 1'000'000;
inline constexpr std::uint64_t kMillisecond = 1000 * kMicrosecond;
// N.L and N.H; a colour each; one table.
inline constexpr std::array<std::uint64_t, 3> kLoaders{2, 3, 1};
// From the start of a line to its first pixel's reading of the tables.
inline constexpr std::array<std::uint64_t, 3> kReachedPs{7 * kMicrosecond, 7'180'000, 7'180'000};
inline constexpr std::uint64_t kRetracePs = 600 * kMicrosecond;  // 004, section 5.3.6

inline LightArguments light(double x, double y, double z) {
  const auto unit = [](double a, double b, double c) {
    const double length = std::sqrt(a * a + b * b + c * c);
    return Direction{a / length, b / length, c / length};
  };
  const Direction towards = unit(x, y, z);
  return {towards, unit(towards[0], towards[1], towards[2] + 1), {1, 1, 1}};
}

inline const LightArguments kFirst = light(0.3, -0.5, 0.8);
inline const LightArguments kSecond = light(-0.2, 0.4, 0.7);

// Host, video timing and screen around a shading processor.
class Surroundings : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, LightProtocol> lights;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::SyncProtocol> to_loader;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::SyncProtocol> to_shading;
  tlm_utils::simple_initiator_socket<Surroundings, stream::kNoBusWidth, stream::FragmentProtocol> fragments;
  tlm_utils::simple_target_socket<Surroundings, stream::kNoBusWidth, stream::RgbProtocol> rgb;
  sc_core::sc_event swapped;
  const sc_core::sc_signal<bool>* tables_ready = nullptr;

  explicit Surroundings(const sc_core::sc_module_name& name)
      : sc_module(name),
        lights("lights"),
        to_loader("to_loader"),
        to_shading("to_shading"),
        fragments("fragments"),
        rgb("rgb") {
    rgb.register_b_transport(this, &Surroundings::receive);
  }

  void announce(bool changed, const LightArguments& arguments) {
    LightPayload payload;
    payload.changed = changed;
    payload.lights = {arguments};
    sc_core::sc_time delay;
    lights->b_transport(payload, delay);
  }
  // As the video timing, where loading RAMs are copied: the loader first, then the shading processor; then whoever
  // waits for a swap, if all are ready. Whether the tables were switched.
  bool retrace(bool copy, bool hosts_ready = true) {
    sc_core::wait(sc_core::SC_ZERO_TIME);  // who finishes at this very instant is in time
    stream::SyncPayload payload;
    payload.kind = stream::SyncPayload::Kind::retrace;
    payload.copy = copy;
    payload.swap = copy && hosts_ready && tables_ready->read();
    sc_core::sc_time delay;
    to_loader->b_transport(payload, delay);
    to_shading->b_transport(payload, delay);
    if (payload.swap) swapped.notify(sc_core::SC_ZERO_TIME);
    return payload.switch_tables;
  }
  // A line that starts `delay_ps` from now, announced before it does.
  void line(std::uint64_t delay_ps) {
    stream::SyncPayload payload;
    payload.kind = stream::SyncPayload::Kind::line;
    sc_core::sc_time delay = stream::to_time(delay_ps);
    to_loader->b_transport(payload, delay);
    to_shading->b_transport(payload, delay);
  }

 private:
  void receive(stream::RgbPayload&, sc_core::sc_time&) {}
};

inline ShadingParameters shading_parameters() {
  ShadingParameters parameters;
  parameters.materials = 4;
  return parameters;
}

inline void set_materials(DeferredShader& shader) {
  shader.set_material(0, {{0.9, 0.5, 0.2}, 0.1, 0.5, 0.4, 20});
  shader.set_material(2, {{1.0, 1.0, 1.0}, 0.2, 0.6, 0.2, 100});
  shader.set_ambient_light({1.0, 0.5, 1.0});
  shader.set_background({1, 2, 3});
}

// All of it, bound.
struct Machine {
  Surroundings around{"around"};
  DeferredShader shader;
  stream::Link rgb_link{"rgb", 24, Clock::from_period_ns("pixel clock", 60.0)};
  DeferredShadingModule shading;
  std::vector<stream::Link> links;
  TableLoaderModule loader;
  sc_core::sc_signal<bool> ready{"ready_signal"};
  stream::Edges edges{"edges", ready};

  static std::vector<stream::Link> engine_links(const LoaderParameters& p) {
    const auto clock = [&](double mhz) {
      return p.kind == LoaderKind::sequencer
                 ? Clock::from_period_ns("loader", p.sequencer_clock_ns)
                 : Clock::from_frequency_hz("loader", static_cast<std::uint64_t>(mhz * 1e6));
    };
    return {{"dot", 11, clock(p.dot.clock_mhz)},
            {"diffuse", 8, clock(p.diffuse.clock_mhz)},
            {"specular", 8, clock(p.specular.clock_mhz)}};
  }
  TableLoaderModule::Engine engine(std::size_t i, const LoaderParameters& p) {
    const std::int64_t units[] = {p.dot.units, p.diffuse.units, p.specular.units};
    return {&links[i], kLoaders[i] * static_cast<std::uint64_t>(units[i]), stream::OccupancyMeter(links[i].clock()),
            kReachedPs[i]};
  }

  explicit Machine(const LoaderParameters& parameters, std::vector<std::size_t> materials = {0})
      : shader(shading_parameters(), 12, parameters.when == LoadTime::frame ? 2 : 1),
        shading("deferred_shading", shader, 16, Clock::from_period_ns("pixel clock", 60.0), Cycles(10), rgb_link),
        links(engine_links(parameters)),
        loader("table_loader", shader, parameters, std::move(materials), kRetracePs, around.swapped,
               {engine(0, parameters), engine(1, parameters), engine(2, parameters)}) {
    set_materials(shader);
    around.lights.bind(loader.lights);
    around.to_loader.bind(loader.sync);
    around.to_shading.bind(shading.sync);
    around.fragments.bind(shading.in);
    shading.out.bind(around.rgb);
    loader.bus.bind(shading.bus);
    loader.ready.bind(ready);
    around.tables_ready = &ready;
  }
};

inline LoaderParameters loader(LoaderKind kind, LoadTime when) {
  LoaderParameters parameters;
  parameters.kind = kind;
  parameters.when = when;
  return parameters;
}

// Every word that a processor with all the time it needs would have, given this light.
inline void expect_tables(const TableBank& bank, const LightArguments& arguments) {
  DeferredShader shader(shading_parameters(), 12, 1);
  set_materials(shader);
  shader.set_light(0, arguments);
  shader.load();
  const std::uint32_t index_mask = (1U << 10) - 1;
  std::size_t different = 0;
  for (std::uint32_t address = 0; address < bank.words(); ++address) {
    const EntryAddress place = bank.decode(address);
    const bool by_material = place.table.kind == TableKind::diffuse || place.table.kind == TableKind::specular;
    if (by_material && (place.entry & ~index_mask) != 0) continue;  // material 0 alone is loaded
    different += bank.read(address) != shader.front().read(address) ? 1U : 0U;
  }
  EXPECT_EQ(different, 0U);
}

}  // namespace rastertlm::shading
