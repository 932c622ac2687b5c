#include "platforms/quadratic/quadratic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "modules/stream/failure.h"
#include "modules/stream/simulated_time.h"
#include "src/base/fixed_point.h"
#include "src/scene/solids.h"

namespace rastertlm::quadratic {
namespace {

host::HostParameters host_of(const Machine& machine) {
  host::HostParameters parameters;
  static_cast<host::ProcessorParameters&>(parameters) = machine.host;
  return parameters;
}

host::ResidentScene resident_scene(const Machine& machine, const scene::Scene& scene) {
  host::ResidentScene resident;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    resident.objects.push_back({&scene.objects[i].mesh, scene.objects[i].two_sided, scene::object_moves(scene, i)});
  resident.camera_moves = scene::camera_moves(scene);
  resident.pose = [&scene, viewport = machine.viewport()](std::int64_t frame) {
    return scene::pose(scene, frame, viewport.columns, viewport.lines);
  };
  return resident;
}

std::vector<geometry::Reflectance> surfaces_of(const scene::Scene& scene) {
  std::vector<geometry::Reflectance> surfaces;
  for (const scene::Material& m : scene.materials)
    surfaces.push_back({m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent});
  return surfaces;
}

geometry::LightingRules rules_of(const scene::Scene& scene) {
  return {scene.model == scene::LightingModel::phong ? geometry::Model::phong : geometry::Model::blinn,
          scene.specular_gate, scene.ambient_light};
}

bool viewer_at_eye(const scene::Scene& scene) { return scene.camera.projection == scene::ProjectionKind::perspective; }

frame_store::FrameStore::Format store_format(const Machine& machine, const scene::Scene& scene, bool observe) {
  frame_store::FrameStore::Format format;
  format.columns = static_cast<std::uint32_t>(machine.video.columns);
  format.lines = static_cast<std::uint32_t>(machine.video.lines);
  format.farthest = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(machine.span_unit.depth_bits)));
  for (std::size_t c = 0; c < 3; ++c)
    format.background[c] = static_cast<std::uint8_t>(scene.background[static_cast<int>(c)]);
  format.pixels = span_unit::pixel_format(machine.span_unit);
  format.ties = machine.stores_numbers();
  using Keep = frame_store::FrameStore::Keep;
  format.keep = observe ? Keep::everything : (machine.stores_numbers() ? Keep::numbers : Keep::nothing);
  return format;
}

}  // namespace

Quadratic::Quadratic(const Machine& machine, const scene::Scene& scene, const Options& options, Sink sink)
    : machine_(machine),
      scene_(scene),
      options_(options),
      sink_(std::move(sink)),
      timing_(video::timing(machine.video)),
      cost_(host_of(machine)),
      resident_(resident_scene(machine, scene)),
      store_(machine.frame_store, store_format(machine, scene, options.observe)) {
  check_scene();
  work_ = std::make_unique<host::SetUpWork>(resident_, machine.set_up, machine.set_up_format(), surfaces_of(scene),
                                            rules_of(scene));
  const auto pixels_bits =
      static_cast<unsigned>(machine.layout().pixel_bits()) * static_cast<unsigned>(machine.span_unit.units);
  const Clock bus_clock =
      Clock::slower("bus words", cost_.clock(), static_cast<std::uint64_t>(machine.host.bus_cycles_per_word));
  stream::Link& bus = links_.emplace_back("bus", static_cast<unsigned>(machine.host.bus_bits), bus_clock);
  stream::Link& pixels = links_.emplace_back("span unit to frame store", pixels_bits, machine.span_unit.clock());
  links_.emplace_back("frame store to video", frame_store::kColourBits, timing_.clock);
  set_up_processor_ = std::make_unique<host::SetUpProcessorModule>(
      "set_up_processor", *work_, cost_,
      host::SetUpProcessorModule::Timeline{resident_.pose, viewer_at_eye(scene), options.frames,
                                           [this](const auto& frame) { note_drawn(frame); },
                                           [this] { return waits_for_screen(); }},
      bus);
  span_unit_ = std::make_unique<span_unit::SpanUnitModule>("span_unit", machine.span_unit,
                                                           static_cast<std::uint32_t>(machine.video.columns),
                                                           static_cast<std::uint32_t>(machine.video.lines), pixels);
  // Several units ask for a pixel each in a pixel's time, in turn: a memory that serves all of them in that time keeps
  // none waiting.
  const std::uint64_t pixel_ps =
      machine.span_unit.clock().picoseconds(Cycles(static_cast<std::uint64_t>(machine.span_unit.pixel_cycles)));
  const auto units = static_cast<std::uint64_t>(machine.span_unit.units);
  frame_store_ = std::make_unique<frame_store::FrameStoreModule>("frame_store", machine.frame_store, store_,
                                                                 machine.layout(), timing_, pixel_ps / units);
  video_output_ = std::make_unique<video::VideoOutputModule>(
      "video_output",
      video::FrameAssembly::Format{static_cast<std::size_t>(machine.video.columns),
                                   static_cast<std::size_t>(machine.video.lines), 1, 12, 0, false},
      [this](std::uint64_t number, std::size_t, const frame::Frame& picture, std::uint64_t) {
        note_screen(number, picture);
      });
  set_up_processor_->bus.bind(span_unit_->bus);
  bind_pixels();
  frame_store_->out.bind(video_output_->in);
}

// What shades pixels stands between the span unit and the store.
void Quadratic::bind_pixels() {
  if (work_->shader() == nullptr) return span_unit_->out.bind(frame_store_->in);
  stream::Link& shaded = links_.emplace_back(
      "pixel unit to frame store", static_cast<unsigned>(machine_.layout().pixel_bits()), machine_.pixel_unit.clock());
  pixel_unit_ =
      std::make_unique<pixel_unit::PixelUnitModule>("pixel_unit", machine_.pixel_unit, *work_->shader(), shaded);
  span_unit_->out.bind(pixel_unit_->in);
  pixel_unit_->out.bind(frame_store_->in);
}

host::Rendering Quadratic::rendering() const {
  return {resident_,           machine_.set_up,  machine_.set_up_format(), machine_.span_unit,
          surfaces_of(scene_), rules_of(scene_), viewer_at_eye(scene_)};
}

void Quadratic::check_scene() const {
  Diagnostics diagnostics;
  for (const Diagnostic& solid : scene::refuse_solids(scene_, scene::kTrianglesAlone)) diagnostics.add(solid);
  for (std::size_t i = 0; i < scene_.materials.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(scene_.materials[i].colour[c]))
        diagnostics.add({"", 0, fmt::format("material[{}].colour", i), "is not finite"});
  diagnostics.throw_if_any();
}

// Called with the last line of a frame's screen.
void Quadratic::note_screen(std::uint64_t number, const frame::Frame& pixels) {
  shown_pixels_ = &pixels;
  if (options_.observe) {
    pixels_ = pixels;
    store_.observe(pixels_);
    shown_pixels_ = &pixels_;
  }
  if (machine_.frame_store.changes_while_shown()) screens_.emplace_back(number, *shown_pixels_);
}

// Later frames are seen on the last one's screen: they are drawn too where somebody looks, if time passes at all.
bool Quadratic::waits_for_screen() const {
  if (!sink_ || !machine_.frame_store.changes_while_shown() || screens_shown_ >= options_.frames) return false;
  const std::size_t count = frames_.size();
  return count < 2 || frames_[count - 1].set_up.shown_ps > frames_[count - 2].set_up.shown_ps;
}

// Called when a frame is in the store and its lines are on their way.
void Quadratic::note_drawn(const host::SetUpFrame& frame) {
  shown_.set_up = frame;
  shown_.drawn_ps = std::max(span_unit_->end_ps(), pixel_unit_ ? pixel_unit_->drained_ps() : 0);
  const std::uint64_t screen_ps = frame_store_->screen_ps(frame.shown_ps);
  const Cycles last_pixel = timing_.first_pixel(static_cast<std::size_t>(machine_.video.lines) - 1) +
                            Cycles(static_cast<std::uint64_t>(machine_.video.columns) - 1);
  shown_.first_pixel_ps = screen_ps + timing_.clock.picoseconds(timing_.first_pixel(0));
  shown_.last_pixel_ps = screen_ps + timing_.clock.picoseconds(last_pixel);
  const span_unit::SpanCounters now = span_unit_->counters();
  shown_.drawn = {now.triangles - drawn_before_.triangles,     now.lines - drawn_before_.lines,
                  now.empty_lines - drawn_before_.empty_lines, now.carries - drawn_before_.carries,
                  now.pixels - drawn_before_.pixels,           now.off_screen - drawn_before_.off_screen};
  drawn_before_ = now;
  shown_.work = work_since_last();
  waiting_ = true;
}

FrameWork Quadratic::work_since_last() {
  FrameWork work;
  const std::vector<stream::Occupancy> units = span_unit_->occupancies();
  busy_before_.resize(units.size());
  for (std::size_t k = 0; k < units.size(); ++k) {
    work.span_cycles = std::max(work.span_cycles, units[k].busy - busy_before_[k]);
    busy_before_[k] = units[k].busy;
  }
  std::uint64_t starved = 0;
  for (const stream::Occupancy& unit : units) starved += unit.starved;
  work.starved_cycles = (starved - starved_before_) / units.size();
  starved_before_ = starved;
  const std::uint64_t waiting = span_unit_->memory_cycles();
  work.waiting_cycles = (waiting - waiting_before_) / units.size();
  waiting_before_ = waiting;
  if (pixel_unit_) {
    work.shading_cycles = pixel_unit_->occupancy().busy - shading_before_;
    shading_before_ = pixel_unit_->occupancy().busy;
    work.shaded_pixels = pixel_unit_->shaded() - shaded_before_;
    shaded_before_ = pixel_unit_->shaded();
    const pixel_unit::ShaderCounters& shader = work_->shader()->counters();
    const std::uint64_t flops = shader.line.flops() + shader.pixel.flops();
    work.shading_flops = flops - shading_flops_before_;
    shading_flops_before_ = flops;
  }
  work.accesses = frame_store_->drawing_accesses() - accesses_before_;
  accesses_before_ = frame_store_->drawing_accesses();
  return work;
}

void Quadratic::run() {
  sc_core::sc_report_handler::set_actions("/OSCI/SystemC", sc_core::SC_INFO,
                                          sc_core::SC_DO_NOTHING);  // that it was stopped is no news
  // The set-up processor pauses after every frame, so that it is handed on outside the simulation: its processes have
  // small stacks, and what the sink throws is the caller's.
  while (!set_up_processor_->finished()) {
    sc_core::sc_start();
    stream::rethrow_failure();
    if (!waiting_) continue;
    waiting_ = false;
    frames_.push_back(shown_);
    hand_on();
  }
  frame_store_->finish();
  hand_on_screens();
  note_screens();
  check_identities();
}

void Quadratic::hand_on() {
  if (machine_.frame_store.changes_while_shown()) return hand_on_screens();
  if (sink_) sink_(shown_, *shown_pixels_);
}

void Quadratic::hand_on_screens() {
  for (const auto& [number, pixels] : screens_) {
    frames_[number].torn_lines = frame_store_->torn_lines(number);
    if (sink_) sink_(frames_[number], pixels);
  }
  screens_shown_ += screens_.size();
  screens_.clear();
}

void Quadratic::watch(const Watchers& watchers) {
  set_up_processor_->watch(watchers.set_up_processor);
  span_unit_->watch(watchers.span_units);
  frame_store_->watch(watchers.memory);
  links_.at(kBusLink).watch(watchers.bus);
  links_.at(kPixelLink).watch(watchers.pixels);
}

// The display is sent pixels whatever is drawn, from when there is a picture on.
void Quadratic::note_screens() {
  const auto lines = static_cast<std::uint64_t>(machine_.video.lines);
  const auto sent_by = [&](std::uint64_t ps) { return timing_.pixels_sent(timing_.clock.cycles_at(ps), lines); };
  const std::uint64_t pixels = sent_by(end_ps()) - sent_by(frames_.front().set_up.shown_ps);
  links_.at(kScreenLink).record(pixels, Cycles(pixels));
}

double Quadratic::frames_per_second() const {
  constexpr double kPicosecond = 1e-12;
  if (frames_.size() < 2) throw std::logic_error("a rate takes two frames");
  const std::uint64_t passed = frames_.back().set_up.shown_ps - frames_.front().set_up.shown_ps;
  if (passed == 0) return timing_.obtained_refresh_hz();
  return static_cast<double>(frames_.size() - 1) / (static_cast<double>(passed) * kPicosecond);
}

void Quadratic::check_identities() const {
  const auto require = [](const char* unit, std::uint64_t a, std::uint64_t b, const char* what) {
    if (a != b) throw ModelError(unit, 0, fmt::format("{}: {} is not {}", what, a, b));
  };
  set_up_processor_->occupancy().check("set-up processor");
  for (const stream::Occupancy& unit : span_unit_->occupancies()) unit.check("span unit");
  if (pixel_unit_) {
    pixel_unit_->occupancy().check("pixel unit");
    require("pixel unit", pixel_unit_->shaded() + pixel_unit_->passed(), span_unit_->counters().pixels,
            "pixels shaded and passed = pixels drawn");
  }
  const frame_store::StoreCounters& store = store_.counters();
  require("frame store", store.fragments_in, store.fragments_kept + store.fragments_hidden,
          "fragments in = kept + hidden");
  require("frame store", store.fragments_in, span_unit_->counters().pixels, "fragments in = pixels drawn");
  std::uint64_t loads = 0;
  set_up::LoadWords kinds;
  for (const ShownFrame& frame : frames_) {
    const host::SetUpCounts& counts = frame.set_up.counts;
    loads += counts.loads;
    kinds += counts.words;
    require("set-up processor", counts.triangles,
            counts.facing + counts.back_faces + counts.degenerate + counts.outside,
            "triangles = facing + back faces + degenerate + outside");
  }
  const std::uint64_t words = kinds.total();
  require("span unit", loads, span_unit_->loads_received(), "loads sent = loads received");
  require("set-up processor", words, set_up_processor_->words_sent(), "words computed = words sent");
  require("span unit", words, span_unit_->words_loaded(), "words sent = words loaded");
  require("bus", set_up::bus_words(kinds, work_->widths(), cost_.bus_bits()), links_.front().words(),
          "bus words of what was sent = bus words that crossed");
  for (const stream::Link& link : links_) {
    const std::uint64_t cycles = link.clock().cycles_at(end_ps()).count();
    if (link.words() > cycles)
      throw ModelError(link.name(), cycles, fmt::format("{} words crossed in {} cycles", link.words(), cycles));
  }
}

}  // namespace rastertlm::quadratic
