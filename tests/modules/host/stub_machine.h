// An animation unit and computation units on stub boards, for tests of their timing: the test is their video timing.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "modules/host/animation_unit_module.h"
#include "modules/host/computation_unit_module.h"
#include "modules/host/link_topology.h"
#include "tests/modules/host/resident_world.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::host {

// Takes bus writes, notes them, and refuses them where told to.
class StubBoard : public sc_core::sc_module {
 public:
  struct Write {
    std::uint64_t address;
    std::vector<std::uint32_t> words;
    std::uint32_t object;
  };
  tlm_utils::simple_target_socket<StubBoard> bus;
  std::vector<Write> writes;
  bool refuses = false;

  explicit StubBoard(const sc_core::sc_module_name& name) : sc_module(name), bus("bus") {
    bus.register_b_transport(this, &StubBoard::write);
  }

 private:
  void write(tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(payload.get_data_ptr());
    object_processor::ObjectNumber* number = nullptr;
    payload.get_extension(number);
    writes.push_back({payload.get_address(), {words, words + payload.get_data_length() / 4}, number->object});
    payload.set_response_status(refuses ? tlm::TLM_ADDRESS_ERROR_RESPONSE : tlm::TLM_OK_RESPONSE);
  }
};

class StubLoader : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<StubLoader, stream::kNoBusWidth, shading::LightProtocol> lights;
  std::deque<shading::LightPayload> received;

  explicit StubLoader(const sc_core::sc_module_name& name) : sc_module(name), lights("lights") {
    lights.register_b_transport(this, &StubLoader::receive);
  }

 private:
  void receive(shading::LightPayload& payload, sc_core::sc_time&) {
    auto& copy = received.emplace_back();
    copy.changed = payload.changed;
    copy.lights = payload.lights;
  }
};

struct Hosts {
  World world{glm::dmat4(1.0)};
  HostParameters parameters;
  std::unique_ptr<HostCost> cost;
  std::unique_ptr<Animation> animation;
  SlotMap slots;
  std::deque<stream::Link> links;      // to unit k
  std::deque<stream::Link> up_links;   // from unit k
  std::deque<stream::Link> bus_links;  // of unit k
  std::deque<Computation> computations;
  std::deque<StubBoard> boards;
  std::deque<sc_core::sc_signal<bool>> ready;
  std::deque<stream::Edges> edges;
  StubLoader loader{"loader"};
  sc_core::sc_event swapped;
  std::uint64_t displayed_frame = 0;
  CopyTimes copies{Clock::from_period_ns("pixel clock", 60.0), Cycles(333'333), Cycles(8)};
  std::unique_ptr<AnimationUnitModule> animation_unit;
  std::deque<ComputationUnitModule> units;

  std::vector<stream::Link*> below(std::size_t node) {
    std::vector<stream::Link*> result;
    for (const std::size_t unit : fed(node)) result.push_back(&links[unit]);
    return result;
  }
  std::vector<std::size_t> fed(std::size_t node) const {
    return children(node, slots.boards.size(), parameters.link_topology, static_cast<std::size_t>(parameters.links));
  }

  void build() {
    cost = std::make_unique<HostCost>(parameters);
    animation = std::make_unique<Animation>(world.resident, parameters.send == Send::all);
    slots = assign_objects(world.triangles(), parameters);
    const std::size_t count = slots.boards.size();
    const auto processors = static_cast<std::uint32_t>(parameters.processors_per_unit);
    for (std::size_t k = 0; k < count; ++k) {
      links.emplace_back("link", 8, Clock::from_frequency_hz("bytes", 1'739'130));
      up_links.emplace_back("link up", 8, Clock::from_frequency_hz("bytes", 1'739'130));
      bus_links.emplace_back("bus", 32, Clock::from_frequency_hz("words", 6'666'666));
      computations.emplace_back(world.resident, format(processors), slots.boards[k]);
      boards.emplace_back(("board_" + std::to_string(k)).c_str());
      ready.emplace_back(("ready_" + std::to_string(k)).c_str());
      edges.emplace_back(("edges_" + std::to_string(k)).c_str(), ready[k]);
    }
    animation_unit = std::make_unique<AnimationUnitModule>(
        "animation_unit", *animation, *cost, fed(0).size(), count, parameters.overflow,
        AnimationUnitModule::Timeline{&swapped, [this] { return displayed_frame; }}, below(0));
    for (std::size_t k = 0; k < count; ++k) {
      units.emplace_back(("computation_unit_" + std::to_string(k)).c_str(), static_cast<std::uint32_t>(k),
                         computations[k], ComputationUnitModule::Solids{}, *cost, fed(k + 1).size(), swapped,
                         ComputationUnitModule::Links{&up_links[k], below(k + 1), &bus_links[k]}, copies);
      units[k].ready.bind(ready[k]);
      units[k].bus.bind(boards[k].bus);
    }
    animation_unit->loader.bind(loader.lights);
    for (std::size_t node = 0; node <= count; ++node)
      for (std::size_t i = 0; i < fed(node).size(); ++i) {
        ComputationUnitModule& child = units[fed(node)[i]];
        if (node == 0) {
          animation_unit->down[i].bind(child.from_above);
          child.to_above.bind(animation_unit->up[i]);
        } else {
          units[node - 1].down[i].bind(child.from_above);
          child.to_above.bind(units[node - 1].up[i]);
        }
      }
  }
};

}  // namespace rastertlm::host
