// Running the machine: what each video frame shows is noted, books are closed, identities checked.
#include <fmt/format.h>

#include <algorithm>

#include "modules/stream/failure.h"
#include "modules/stream/simulated_time.h"
#include "platforms/imogene/imogene.h"

namespace rastertlm::imogene {

void Imogene::note_shown(std::uint64_t frame, std::size_t field, const frame::Frame& pixels,
                         std::uint64_t last_line_ps) {
  shown_.frame = frame;
  shown_.field = field;
  shown_.updated = video_timing_->updates() != updates_seen_;
  shown_.words_ahead = 0;
  for (const auto& board : board_modules_) shown_.words_ahead += board->words_ahead();
  for (const auto& board : quadric_modules_) shown_.words_ahead += board->words_ahead();
  shown_.light_apart = video_timing_->objects_ahead() != table_loader_->tables_ahead();
  shown_.flops = 0;
  shown_.words = 0;
  if (shown_.updated) {
    updates_seen_ = video_timing_->updates();
    const host::FrameWork& work = animation_unit_->work();
    shown_.animation_frame = work.animation_frame;
    shown_.pose = work.pose;
    shown_.guarded = animation_unit_->guarded();
    shown_.pieces_dropped = animation_unit_->pieces_dropped();
    shown_.triangles = {};
    shown_.solids = {};
    for (const auto& computation : quadric_computations_) shown_.solids += computation->counts();
    for (std::size_t k = 0; k < computations_.size(); ++k) {
      shown_.triangles += computations_[k]->triangle_counts();
      if (computation_units_[k]->updates().empty()) continue;
      shown_.flops += computation_units_[k]->updates().back().flops();
      shown_.words += computation_units_[k]->updates().back().words;
    }
  }
  shown_.late_table_lines = table_loader_->late_lines_of_frame();
  most_pieces_ = std::max(most_pieces_, shown_.triangles.pieces + shown_.pieces_dropped);
  note_deadlines();
  if (frame == 0 && field == 0) reset_host_links();
  const Cycles retrace = timing_.frame * (frame * timing_.fields + field);
  shown_.first_pixel_ps = timing_.clock.picoseconds(retrace + timing_.first_pixel(field) + pixel_latency_);
  // Of whole cycles, each step on the way rounded to a picosecond: the nearest number of cycles is the exact one.
  const Cycles last_line = timing_.clock.cycles_round(static_cast<double>(last_line_ps - start_ps()) * 1e-12);
  shown_.last_pixel_ps = timing_.clock.picoseconds(last_line + Cycles(pixels.columns - 1));
  pixels_ = &pixels;
}

// Lines are announced at the retrace, so the hosts have not begun their next update: their last one is what it copied.
void Imogene::note_deadlines() {
  const std::uint64_t video_frame = frames_before_first() + shown_.frame * timing_.fields + shown_.field;
  shown_.table_load = timing_.clock.cycles_at(table_loader_->load_left_ps(stream::picoseconds_now()));
  shown_.tables_wait = timing_.clock.cycles_at(table_loader_->lines_wait_ps(stream::picoseconds_now()));
  if (shown_.updated) {
    shown_.host_frames = video_frame - shown_.video_frame;
    shown_.host_cycles = Cycles(0);
    for (const auto& unit : computation_units_)
      if (!unit->updates().empty()) shown_.host_cycles = std::max(shown_.host_cycles, unit->updates().back().cycles);
    shown_.video_frame = video_frame;
  }
}

// What crossed the links before the first picture is the initial load: bandwidth counts from there. The display's links
// start with it.
void Imogene::reset_host_links() {
  const std::uint64_t now = stream::picoseconds_now();
  for (const auto* links : {&host_links_, &up_links_, &bus_links_, &table_links_})
    for (stream::Link* link : *links) link->reset(now);
  loader_bus_->reset(now);
}

void Imogene::run() {
  sc_core::sc_report_handler::set_actions("/OSCI/SystemC", sc_core::SC_INFO,
                                          sc_core::SC_DO_NOTHING);  // that it was stopped is no news
  // The video timing pauses after every frame, so that a frame is handed on outside the simulation: its processes have
  // small stacks, and what the sink throws is the caller's.
  while (!video_timing_->finished()) {
    sc_core::sc_start();
    stream::rethrow_failure();
    if (pixels_ != nullptr && sink_) sink_(shown_, *pixels_);
    pixels_ = nullptr;
  }
  close_books();
  check_identities();
  settle();
}

// What a report says of cycles and links is of the displayed frames.
void Imogene::close_books() {
  end_ps_ = stream::picoseconds_now();
  table_loader_->close(end_ps_);
  books_.animation_unit = animation_unit_->occupancy(end_ps_);
  for (const auto& unit : computation_units_) books_.computation_units.push_back(unit->occupancy(end_ps_));
  for (std::size_t i = 0; i < books_.table_loaders.size(); ++i)
    books_.table_loaders[i] = table_loader_->occupancy(i, end_ps_);
  for (const stream::Link& link : links_) books_.links.push_back(link.at(end_ps_));
}

// A unit that needs longer than the displayed frames must not look as if it had nothing to do: the hosts finish the
// update that they are at, and nothing is shown any more.
void Imogene::settle() {
  if (!animation_.moves()) return;
  const auto unsettled = [this] {
    return std::any_of(computation_units_.begin(), computation_units_.end(),
                       [](const auto& unit) { return unit->updates().size() < 2; });
  };
  for (std::uint64_t waited = 0; unsettled(); ++waited) {
    if (waited > kPatienceFrames)
      throw ModelError("computation units", waited, "an update has not ended after so many video frames");
    sc_core::sc_start(stream::to_time(timing_.clock, timing_.frame));
    stream::rethrow_failure();
  }
}

void Imogene::check_identities() {
  const std::uint64_t cycle = (timing_.frame * timing_.fields * options_.frames).count();
  const auto equal = [cycle](const char* unit, const char* rule, std::uint64_t left, std::uint64_t right) {
    if (left != right) throw ModelError(unit, cycle, fmt::format("{}: {} is not {}", rule, left, right));
  };
  std::uint64_t kept = 0;
  for (std::size_t k = 0; k < boards_.size(); ++k) {
    const auto& counters = boards_[k].counters();
    equal("object board", "fragments in = kept + hidden", counters.fragments_in,
          counters.fragments_kept + counters.fragments_hidden);
    equal("object board", "words sent = words loaded", computation_units_[k]->words_sent(),
          board_modules_[k]->words_loaded() + (quadric_modules_.empty() ? 0 : quadric_modules_[k]->words_loaded()));
    kept += counters.fragments_kept;
  }
  for (const quadric_processor::QuadricBoard& board : quadric_boards_) {
    const auto& counters = board.counters();
    equal("quadric board", "fragments in = kept + hidden", counters.fragments_in,
          counters.fragments_kept + counters.fragments_hidden);
    kept += counters.fragments_kept;
  }
  const auto& decided = decision_.counters();
  equal("decision unit", "fragments in = kept by the boards", decided.fragments_in, kept);
  equal("decision unit", "fragments in = kept + hidden", decided.fragments_in,
        decided.fragments_kept + decided.fragments_hidden);
  equal("shading processor", "pixels shaded = fragments kept", shader_.counters().pixels, decided.fragments_kept);
  equal("table loader", "words sent = words loaded", table_loader_->words_sent(), shading_module_->words_loaded());
  for (std::size_t i = 0; i < books_.table_loaders.size(); ++i) books_.table_loaders[i].check(shading::kEngineNames[i]);
  equal("video output", "lines shown = lines of all frames", video_output_->lines_shown(),
        options_.frames * static_cast<std::uint64_t>(machine_.video.lines));
}

}  // namespace rastertlm::imogene
