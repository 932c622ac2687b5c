// A computation unit: one transputer with an object board on its bus, and a board of quadric processors where the
// machine has them. It receives a frame's changes, forwards them, transforms its triangles, reports and is told the
// frame's grid, fits the coefficients, computes the words of its solids, and writes them to the loading RAMs.
#pragma once

#include <tlm_utils/simple_initiator_socket.h>

#include <deque>
#include <systemc>
#include <vector>

#include "modules/host/bus_schedule.h"
#include "modules/host/quadric_computation.h"
#include "modules/host/serial_links_module.h"
#include "modules/object_processor/object_number_payload.h"
#include "modules/stream/occupancy.h"

namespace rastertlm::host {

class ComputationUnitModule : public sc_core::sc_module {
 public:
  MessageTarget<ComputationUnitModule> from_above;
  MessageInitiator<ComputationUnitModule> to_above;
  sc_core::sc_vector<MessageInitiator<ComputationUnitModule>> down;
  sc_core::sc_vector<MessageTarget<ComputationUnitModule>> up;
  using BusSocket = tlm_utils::simple_initiator_socket<ComputationUnitModule, 32>;
  BusSocket bus;                              // to the object board
  sc_core::sc_vector<BusSocket> quadric_bus;  // the same wires, to the quadric board: one, or none
  sc_core::sc_out<bool> ready;                // the loading RAMs hold the next frame

  struct Links {
    stream::Link* above;
    std::vector<stream::Link*> below;
    stream::Link* bus;
    std::vector<std::uint64_t> resident_below = {};  // bytes of meshes for the units behind each link below
  };

  // What it computes for quadric processors, and the words of such a slot; null in a machine that has none.
  struct Solids {
    QuadricComputation* computation = nullptr;
    std::uint64_t words_a_slot = 0;
  };

  // `swapped`: at a retrace at which every unit had finished; `copies`: when its board takes no words.
  ComputationUnitModule(const sc_core::sc_module_name& name, std::uint32_t unit, Computation& computation,
                        Solids solids, const HostCost& cost, std::size_t children, const sc_core::sc_event& swapped,
                        Links links, const CopyTimes& copies);
  ~ComputationUnitModule() override {
    write_payload_.clear_extension(&object_number_);
  }  // it is a member, not the payload's to free

  // Cycles of one update, from the retrace that started it to the last word written.
  struct Update {
    std::int64_t animation_frame = 0;
    Cycles cycles;     // all of it
    Cycles computing;  // of which arithmetic,
    Cycles starting;   // starts of messages,
    Cycles writing;    // and bus
    Cycles stalled;    // while the boards copied
    geometry::OperationCounts operations;
    std::uint64_t words = 0;
    std::uint64_t flops() const { return operations.flops(); }
  };
  const std::vector<Update>& updates() const { return updates_; }
  std::uint64_t words_sent() const { return words_sent_; }
  const stream::Occupancy& occupancy(std::uint64_t end_ps) { return meter_.close(end_ps); }
  stream::OccupancyMeter& meter() { return meter_; }

 private:
  void run_guarded();
  void run();
  Cycles cycles_since_swap() const;
  Message take(Message::Kind kind);
  void forward(const Message& message);
  void report();
  void work_on_frame(const FrameWork& work);
  void spend_computing(const geometry::OperationCounts& before);
  // What is written of a slot, and where it stands.
  struct Parcel {
    std::uint32_t slot = 0;
    std::uint32_t object = 0;  // from 1; 0: parked
    std::uint64_t words = 0;
  };
  std::size_t parcels() const { return loads_->size() + (solids_ == nullptr ? 0 : solids_->size()); }
  bool is_solid(std::size_t parcel) const { return parcel >= loads_->size(); }
  Parcel parcel(std::size_t number) const;
  void fit_and_write(const Message& plan, const FrameWork& work);
  void cut_into_segments(Cycles computing, const geometry::OperationCounts& of_triangles);
  void write_words(std::uint64_t count);
  void write(std::size_t number, std::size_t first_word, std::size_t count);
  void put_on_bus(BusSocket& socket, std::uint64_t address, std::uint32_t* words, std::size_t count);
  void send_on(MessageInitiator<ComputationUnitModule>& socket, LinkPort& port);  // what stands in payload_
  void receive_from_above(MessagePayload& payload, sc_core::sc_time& delay);
  void receive_from_below(MessagePayload& payload, sc_core::sc_time& delay);

  std::uint32_t unit_;
  Computation& computation_;
  QuadricComputation* quadrics_;
  std::uint64_t quadric_words_;  // of a slot
  const HostCost& cost_;
  const sc_core::sc_event& swapped_;
  Links links_;
  CopyTimes copies_;
  LinkPort above_;
  std::vector<LinkPort> below_;

  struct Letter {
    Message message;
    std::uint64_t arrives_ps;
  };
  std::deque<Letter> inbox_;  // from above, in order
  sc_core::sc_event sent_down_;
  Message subtree_;  // the survey of the units below, in the making
  Survey survey_;    // the own
  MessagePayload payload_;
  std::size_t surveys_ = 0;
  std::uint64_t last_survey_ps_ = 0;
  sc_core::sc_event sent_up_;

  tlm::tlm_generic_payload write_payload_;
  object_processor::ObjectNumber object_number_;
  std::vector<Segment> segments_;
  const std::vector<Load>* loads_ = nullptr;          // of the frame
  const std::vector<QuadricLoad>* solids_ = nullptr;  // after them
  std::size_t parcel_ = 0;                            // of the frame's parcels, the one that is being written
  std::size_t word_ = 0;                              // and how many words of it are
  Update update_;
  bool first_ = true;          // the initial load: nothing is copied meanwhile
  std::uint64_t swap_ps_ = 0;  // the retrace that started the current update; 0 for the first
  std::vector<Update> updates_;
  std::uint64_t words_sent_ = 0;
  stream::OccupancyMeter meter_;
};

}  // namespace rastertlm::host
