#include "platforms/imogene/imogene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "modules/shading/loader_budget.h"
#include "modules/stream/simulated_time.h"
#include "src/scene/solids.h"

namespace rastertlm::imogene {
namespace {

std::vector<std::size_t> loaded_materials(const Machine& machine, const scene::Scene& scene) {
  if (machine.loader.materials == shading::LoadedMaterials::all) {
    std::vector<std::size_t> all(static_cast<std::size_t>(machine.shading.materials));
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  std::set<std::size_t> used;
  for (const scene::Object& object : scene.objects) {
    used.insert(object.mesh.material.begin(), object.mesh.material.end());
    if (object.solid) used.insert(object.solid->material);
  }
  return {used.begin(), used.end()};
}

host::ResidentScene resident_scene(const Machine& machine, const scene::Scene& scene) {
  host::ResidentScene resident;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    resident.objects.push_back(
        {&object.mesh, object.two_sided, scene::object_moves(scene, i), object.solid ? &*object.solid : nullptr});
  }
  resident.camera_moves = scene::camera_moves(scene);
  resident.pose = [&scene, columns = static_cast<std::size_t>(machine.video.columns),
                   lines = static_cast<std::size_t>(machine.video.lines)](std::int64_t frame) {
    return scene::pose(scene, frame, columns, lines);
  };
  return resident;
}

std::vector<const geometry::Solid*> solids_of(const scene::Scene& scene) {
  std::vector<const geometry::Solid*> solids;
  for (const scene::Object& object : scene.objects)
    if (object.solid) solids.push_back(&*object.solid);
  return solids;
}

// The meshes and solids of every unit and of those that it feeds, which cross the link to it once. Units feed units
// with higher numbers.
std::vector<std::uint64_t> subtree_mesh_bytes(const host::SlotMap& slots, const host::SlotMap& solid_slots,
                                              const scene::Scene& scene, const host::HostParameters& host) {
  std::vector<std::uint64_t> bytes;
  for (const auto& owners : slots.boards) bytes.push_back(host::kResidentTriangleBytes * owners.size());
  const auto solids = solids_of(scene);
  for (std::size_t k = 0; k < bytes.size(); ++k)
    for (const host::SlotOwner& owner : solid_slots.boards[k]) bytes[k] += host::resident_bytes(*solids[owner.object]);
  for (std::size_t k = bytes.size(); k-- > 0;)
    for (const std::size_t child :
         host::children(k + 1, bytes.size(), host.link_topology, static_cast<std::size_t>(host.links)))
      bytes[k] += bytes[child];
  return bytes;
}

std::size_t banks(const Machine& machine) { return machine.loader.when == shading::LoadTime::frame ? 2 : 1; }

std::uint32_t depth_of_nothing(const Machine& machine) {
  return static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(machine.object_processor.word_bits)));
}

// Words of solids are of 32 bits each on the bus, and a triangle's cross it as they do.
std::int64_t bus_word_bits(const Machine& machine) {
  constexpr std::int64_t kSolidWordBits = 32;
  return machine.quadric.per_unit > 0 ? kSolidWordBits : machine.object_processor.word_bits;
}

Cycles cycles_of(std::int64_t count) { return Cycles(static_cast<std::uint64_t>(count)); }

}  // namespace

Imogene::Imogene(const Machine& machine, const scene::Scene& scene, const Options& options, Sink sink)
    : machine_(machine),
      scene_(scene),
      options_(options),
      sink_(std::move(sink)),
      timing_(video::timing(machine.video)),
      grids_(snap_grids(machine)),
      cost_(machine.host, bus_word_bits(machine)),
      slots_(host::assign_objects(scene.triangle_count(), machine.host)),
      solid_slots_(host::assign_solids(scene.solid_count(), machine.host, machine.quadric.per_unit)),
      resident_(resident_scene(machine, scene)),
      animation_(resident_, machine.host.send == host::Send::all),
      decision_(machine.decision_unit, depth_of_nothing(machine)),
      composer_(machine.object_processor, static_cast<std::size_t>(machine.video.columns),
                options.observe || options.decided || options.shaded),
      shader_(machine.shading, machine.object_processor.normal_bits, banks(machine)) {
  if (sc_core::sc_get_time_resolution() != sc_core::sc_time(1, sc_core::SC_PS))
    throw ModelError("platform", 0, "SystemC's time resolution is not 1 ps");
  constexpr double kMostPicoseconds = 4e18;  // time is counted in 64 bits
  if (static_cast<double>(options.frames) *
          static_cast<double>(timing_.clock.picoseconds(timing_.frame * timing_.fields)) >
      kMostPicoseconds)
    throw InputError({"", 0, "--frames",
                      fmt::format("{} frames last longer than the 46 days that can be simulated", options.frames)});
  decision_latency_ = decision_unit::latency(machine.decision_unit.topology, machine.processors(),
                                             cycles_of(machine.object_processor.comparator_cycles));
  pixel_latency_ = cycles_of(machine.object_processor.prenormalisation_cycles) + quadric_delay(machine) +
                   decision_latency_ + machine.shading.total_latency();
  load_materials();
  build_links();
  build_hosts();
  build_boards();
  if (has_quadrics()) build_quadric_boards();
  build_shading();
  build_video();
  bind_hosts();
  bind_display();
}

void Imogene::load_materials() {
  Diagnostics diagnostics;
  if (scene_.materials.size() > static_cast<std::size_t>(machine_.shading.materials))
    diagnostics.add({"", 0, "shading.materials",
                     fmt::format("the scene has {} materials and the shading tables hold {}", scene_.materials.size(),
                                 machine_.shading.materials)});
  if (scene_.lights.size() > static_cast<std::size_t>(machine_.shading.lights))
    diagnostics.add({"", 0, "shading.lights",
                     fmt::format("the scene has {} lights and the shading processor units for {}", scene_.lights.size(),
                                 machine_.shading.lights)});
  for (std::size_t i = 0; i < scene_.lights.size(); ++i)
    if (scene_.lights[i].kind == scene::LightKind::point)
      diagnostics.add(
          {"", 0, fmt::format("light[{}].type", i), "this machine lights from infinitely far: \"directional\" alone"});
  if (scene_.model != scene::LightingModel::blinn)
    diagnostics.add({"", 0, "lighting.model", "this machine shades by Blinn's model: \"blinn\" alone"});
  if (scene_.specular_gate)
    diagnostics.add(
        {"", 0, "lighting.specular_gate", "this machine's specular tables know nothing of N.L: false alone"});
  for (std::size_t i = 0; i < scene_.materials.size(); ++i)
    if (const auto& known = machine_.shading.exponents;
        std::find(known.begin(), known.end(), scene_.materials[i].exponent) == known.end())
      diagnostics.add({"", 0, fmt::format("material[{}].exponent", i),
                       fmt::format("{} is not in the path ROM; accepted: {} (shading.exponents)",
                                   scene_.materials[i].exponent, fmt::join(known, ", "))});
  diagnostics.throw_if_any();
  for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
    const scene::Material& material = scene_.materials[i];
    shader_.set_material(i,
                         {{material.colour.x, material.colour.y, material.colour.z},
                          material.ambient,
                          material.diffuse,
                          material.specular,
                          material.exponent},
                         fmt::format("material[{}].exponent", i));
  }
  // A loader of all materials also fills the tables of those that the scene does not have: black ones.
  if (machine_.loader.materials == shading::LoadedMaterials::all)
    for (std::size_t i = scene_.materials.size(); i < static_cast<std::size_t>(machine_.shading.materials); ++i)
      shader_.set_material(i, {.colour = {0, 0, 0}, .exponent = machine_.shading.exponents.front()});
  shader_.set_ambient_light({scene_.ambient_light.x, scene_.ambient_light.y, scene_.ambient_light.z});
  shader_.set_background({scene_.background.x, scene_.background.y, scene_.background.z});
}

stream::Link& Imogene::add_link(const std::string& name, unsigned bits, const Clock& clock) {
  return links_.emplace_back(name, bits, clock);
}

std::uint64_t Imogene::resident_solid_bytes() const {
  const auto solids = solids_of(scene_);
  std::uint64_t bytes = 0;
  for (const auto& owners : solid_slots_.boards)
    for (const host::SlotOwner& owner : owners) bytes += host::resident_bytes(*solids[owner.object]);
  return bytes;
}

void Imogene::build_links() {
  const auto units = static_cast<std::size_t>(machine_.host.computation_units);
  const Clock byte_clock =
      Clock::from_period_ns("link bytes", 1e3 * cost_.link_bits_per_byte() / machine_.host.link_mbit_per_s);
  const Clock bus_clock =
      Clock::slower("bus words", cost_.clock(), static_cast<std::uint64_t>(machine_.host.bus_cycles_per_word));
  const decision_unit::LinkWidth width{static_cast<std::uint64_t>(machine_.object_processor.word_bits),
                                       static_cast<std::uint64_t>(machine_.object_processor.normal_bits),
                                       machine_.material_bits()};
  for (std::size_t k = 0; k < units; ++k)
    host_links_.push_back(&add_link(fmt::format("host link {}", k), 8, byte_clock));
  for (std::size_t k = 0; k < units; ++k)
    up_links_.push_back(&add_link(fmt::format("host link {}, up", k), 8, byte_clock));
  loader_bus_ = &add_link("animation unit's bus", static_cast<unsigned>(machine_.host.bus_bits), bus_clock);
  for (std::size_t k = 0; k < units; ++k)
    bus_links_.push_back(&add_link(fmt::format("bus {}", k), static_cast<unsigned>(machine_.host.bus_bits), bus_clock));
  for (std::size_t k = 0; k < units; ++k)
    board_links_.push_back(
        &add_link(fmt::format("board {} to decision unit", k), static_cast<unsigned>(width.bits()), timing_.clock));
  for (std::size_t k = 0; has_quadrics() && k < units; ++k)
    quadric_links_.push_back(&add_link(fmt::format("quadric board {} to decision unit", k),
                                       static_cast<unsigned>(width.bits()), timing_.clock));
}

void Imogene::build_hosts() {
  const host::MachineFormat format{
      {static_cast<int>(machine_.object_processor.word_bits), static_cast<std::size_t>(machine_.video.columns),
       static_cast<std::size_t>(machine_.video.lines), machine_.object_processor.edges},
      grids_,
      {static_cast<std::size_t>(machine_.video.columns), static_cast<std::size_t>(machine_.video.lines)},
      static_cast<std::uint32_t>(machine_.host.processors_per_unit)};
  const std::size_t units = slots_.boards.size();
  const auto links = static_cast<std::size_t>(machine_.host.links);
  const auto below = [&](std::size_t node) {
    std::vector<stream::Link*> result;
    for (const std::size_t child : host::children(node, units, machine_.host.link_topology, links))
      result.push_back(host_links_[child]);
    return result;
  };
  const std::vector<std::uint64_t> subtree = subtree_mesh_bytes(slots_, solid_slots_, scene_, machine_.host);
  const auto meshes_below = [&](std::size_t node) {
    std::vector<std::uint64_t> result;
    for (const std::size_t child : host::children(node, units, machine_.host.link_topology, links))
      result.push_back(subtree[child]);
    return result;
  };
  // The last processor copies later than the first by the skew of the microinstruction.
  const host::CopyTimes copies{timing_.clock, timing_.frame, board_needs(machine_).copy(),
                               machine_.host.swap == host::Swap::unconditional};
  const std::size_t quadric_boards = has_quadrics() ? units : 0;
  // The retraces are the video timing's, which comes first.
  video_timing_ = std::make_unique<video::VideoTimingModule>(
      "video_timing", timing_, static_cast<std::size_t>(machine_.video.lines), units + quadric_boards + 2, units,
      options_.frames, kPatienceFrames,
      machine_.host.swap == host::Swap::unconditional ? video::VideoTimingModule::Copy::at_every_retrace
                                                      : video::VideoTimingModule::Copy::when_ready);
  animation_unit_ = std::make_unique<host::AnimationUnitModule>(
      "animation_unit", animation_, cost_, below(0).size(), units, machine_.host.overflow,
      host::AnimationUnitModule::Timeline{&video_timing_->swapped,
                                          [this] { return video_timing_->video_frames_shown() - 1; }},
      below(0), meshes_below(0), loader_bus_);
  const set_up::QuadricFormat solid_format{machine_.quadric, format.words};
  for (std::size_t k = 0; k < units; ++k) {
    if (has_quadrics())
      quadric_computations_.push_back(
          std::make_unique<host::QuadricComputation>(resident_, solid_format, solid_slots_.boards[k]));
    const host::ComputationUnitModule::Solids solids{
        has_quadrics() ? quadric_computations_.back().get() : nullptr,
        quadric_processor::words_of_slot(static_cast<std::size_t>(machine_.quadric.caps))};
    computations_.push_back(std::make_unique<host::Computation>(resident_, format, slots_.boards[k]));
    computation_units_.push_back(std::make_unique<host::ComputationUnitModule>(
        fmt::format("computation_unit_{}", k).c_str(), static_cast<std::uint32_t>(k), *computations_[k], solids, cost_,
        below(k + 1).size(), video_timing_->swapped,
        host::ComputationUnitModule::Links{up_links_[k], below(k + 1), bus_links_[k], meshes_below(k + 1)}, copies));
  }
}

void Imogene::build_boards() {
  const std::size_t units = slots_.boards.size();
  const auto processors = static_cast<std::uint32_t>(machine_.host.processors_per_unit);
  const Cycles first_pixel = first_pixel_of_boards();
  boards_.reserve(units);
  for (std::size_t k = 0; k < units; ++k) {
    boards_.emplace_back(
        machine_.object_processor, processors, static_cast<std::uint32_t>(k) * processors,
        static_cast<std::uint32_t>(machine_.video.columns), static_cast<std::uint32_t>(machine_.video.lines),
        options_.model_everything ? object_processor::Visit::everything : object_processor::Visit::needed);
    board_modules_.push_back(std::make_unique<object_processor::ObjectBoardModule>(
        fmt::format("object_board_{}", k).c_str(), static_cast<std::uint32_t>(k), boards_[k],
        object_processor::ObjectBoardModule::Timing{timing_.clock, first_pixel},
        static_cast<std::size_t>(machine_.video.columns), *board_links_[k]));
  }
}

Cycles Imogene::first_pixel_of_boards() const {
  return timing_.horizontal_blanking + cycles_of(machine_.object_processor.prenormalisation_cycles) +
         quadric_delay(machine_);
}

// Behind all triangle processors: of equal depths a triangle's wins.
void Imogene::build_quadric_boards() {
  const std::size_t units = slots_.boards.size();
  const auto processors = static_cast<std::uint32_t>(machine_.quadric.per_unit);
  const quadric_processor::QuadricScreen screen{
      static_cast<std::uint32_t>(machine_.video.columns), static_cast<std::uint32_t>(machine_.video.lines),
      static_cast<unsigned>(machine_.object_processor.word_bits), depth_range(machine_)};
  quadric_boards_.reserve(units);
  for (std::size_t k = 0; k < units; ++k) {
    const auto first = static_cast<std::uint32_t>(machine_.triangle_processors() + k * processors);
    quadric_boards_.emplace_back(
        machine_.quadric, screen, processors, first,
        options_.model_everything ? object_processor::Visit::everything : object_processor::Visit::needed);
    quadric_modules_.push_back(std::make_unique<quadric_processor::QuadricBoardModule>(
        fmt::format("quadric_board_{}", k).c_str(), static_cast<std::uint32_t>(k), quadric_boards_[k],
        quadric_processor::QuadricBoardModule::Timing{timing_.clock, first_pixel_of_boards()},
        static_cast<std::size_t>(machine_.video.columns), *quadric_links_[k]));
  }
}

void Imogene::build_shading() {
  const auto columns = static_cast<std::size_t>(machine_.video.columns);
  const unsigned fragment_bits = board_links_.front()->bits();
  stream::Link& decided = add_link("decision unit to shading", fragment_bits, timing_.clock);
  stream::Link& rgb =
      add_link("shading to video", 3 * static_cast<unsigned>(machine_.shading.level_bits), timing_.clock);
  decision_module_ = std::make_unique<decision_unit::DecisionUnitModule>("decision_unit", decision_, composer_, columns,
                                                                         boards_.size() + quadric_boards_.size(),
                                                                         timing_.clock, decision_latency_, decided);
  shading_module_ = std::make_unique<shading::DeferredShadingModule>(
      "deferred_shading", shader_, columns, timing_.clock, machine_.shading.total_latency(), rgb);

  const bool sequencer = machine_.loader.kind == shading::LoaderKind::sequencer;
  // A line's first pixel reads the dot-product tables behind the normaliser, the others behind the dot products.
  const Cycles reads_dots =
      first_pixel_of_boards() + decision_latency_ + cycles_of(machine_.shading.latency.normaliser);
  const Cycles reads_levels = reads_dots + cycles_of(machine_.shading.latency.dot_product);
  const auto engine = [&](const char* name, shading::TableKind kind, double mhz, std::int64_t bits,
                          std::int64_t tables) {
    const Clock clock = sequencer ? Clock::from_period_ns(name, machine_.loader.sequencer_clock_ns)
                                  : Clock::from_period_ns(name, 1e3 / mhz);
    const Clock steps = Clock::from_period_ns(name, 1e9 * shading::step_seconds(machine_.loader, kind, false));
    const std::int64_t loaders = tables * shading::units_of(machine_.loader, kind);
    stream::Link& link = add_link(fmt::format("{} to tables", name), static_cast<unsigned>(bits * loaders), steps);
    table_links_.push_back(&link);
    const bool dots = shading::engine_of(kind) == 0;
    return shading::TableLoaderModule::Engine{&link, static_cast<std::uint64_t>(loaders), stream::OccupancyMeter(clock),
                                              timing_.clock.picoseconds(dots ? reads_dots : reads_levels)};
  };
  const std::int64_t lights = machine_.shading.lights;
  table_loader_ = std::make_unique<shading::TableLoaderModule>(
      "table_loader", shader_, machine_.loader, loaded_materials(machine_, scene_),
      timing_.clock.picoseconds(timing_.vertical_retrace), video_timing_->swapped,
      std::array<shading::TableLoaderModule::Engine, 3>{
          engine(shading::kEngineNames[0], shading::TableKind::diffuse_dot, machine_.loader.dot.clock_mhz,
                 machine_.shading.dot_table_output_bits, 2 * lights),
          engine(shading::kEngineNames[1], shading::TableKind::diffuse, machine_.loader.diffuse.clock_mhz,
                 machine_.shading.level_bits, 3 * lights),
          engine(shading::kEngineNames[2], shading::TableKind::specular, machine_.loader.specular.clock_mhz,
                 machine_.shading.level_bits, machine_.shading.specular_tables * lights)});
}

void Imogene::build_video() {
  const video::FrameAssembly::Format format{static_cast<std::size_t>(machine_.video.columns),
                                            static_cast<std::size_t>(machine_.video.lines),
                                            timing_.fields,
                                            static_cast<unsigned>(machine_.object_processor.normal_bits),
                                            depth_of_nothing(machine_),
                                            options_.observe};
  video_output_ = std::make_unique<video::VideoOutputModule>(
      "video_output", format,
      [this](std::uint64_t frame, std::size_t field, const frame::Frame& pixels, std::uint64_t last_line_ps) {
        note_shown(frame, field, pixels, last_line_ps);
      });
}

void Imogene::bind_hosts() {
  const std::size_t units = computation_units_.size();
  const auto links = static_cast<std::size_t>(machine_.host.links);
  for (std::size_t k = 0; k < units; ++k) {
    auto& signal = ready_.emplace_back(fmt::format("ready_{}", k).c_str());
    computation_units_[k]->ready.bind(signal);
    video_timing_->ready[k].bind(signal);
    computation_units_[k]->bus.bind(board_modules_[k]->bus);
    if (has_quadrics()) computation_units_[k]->quadric_bus[0].bind(quadric_modules_[k]->bus);
  }
  for (std::size_t node = 0; node <= units; ++node) {
    const std::vector<std::size_t> fed = host::children(node, units, machine_.host.link_topology, links);
    for (std::size_t i = 0; i < fed.size(); ++i) {
      host::ComputationUnitModule& child = *computation_units_[fed[i]];
      if (node == 0) {
        animation_unit_->down[i].bind(child.from_above);
        child.to_above.bind(animation_unit_->up[i]);
      } else {
        computation_units_[node - 1]->down[i].bind(child.from_above);
        child.to_above.bind(computation_units_[node - 1]->up[i]);
      }
    }
  }
  animation_unit_->loader.bind(table_loader_->lights);
  table_loader_->bus.bind(shading_module_->bus);
  table_loader_->ready.bind(tables_ready_);
  video_timing_->tables_ready.bind(tables_ready_);
}

// At a retrace the loader says whether tables are switched, the shading processor switches them, and the boards copy.
// The last board's line reaches the screen while it is announced: what the line reads has advanced before the boards.
void Imogene::bind_display() {
  const std::size_t boards = board_modules_.size();
  video_timing_->sync[0].bind(table_loader_->sync);
  video_timing_->sync[1].bind(shading_module_->sync);
  // A line concerns tables only where they are written while it is announced.
  if (machine_.loader.when == shading::LoadTime::frame) {
    video_timing_->announce_retraces_alone(0);
    if (boards_.front().covers_in_spans()) video_timing_->announce_lines_in_bands();
  }
  video_timing_->announce_retraces_alone(1);
  for (std::size_t k = 0; k < boards; ++k) {
    video_timing_->sync[k + 2].bind(board_modules_[k]->sync);
    board_modules_[k]->out.bind(decision_module_->in[k]);
  }
  for (std::size_t k = 0; k < quadric_modules_.size(); ++k) {
    video_timing_->sync[boards + k + 2].bind(quadric_modules_[k]->sync);
    quadric_modules_[k]->out.bind(decision_module_->in[boards + k]);
  }
  decided_tap_ = stream::bind_watched("decided_tap", options_.decided, decision_module_->out, shading_module_->in);
  shaded_tap_ = stream::bind_watched("shaded_tap", options_.shaded, shading_module_->out, video_output_->in);
}

}  // namespace rastertlm::imogene
