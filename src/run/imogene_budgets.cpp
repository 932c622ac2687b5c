#include "src/run/imogene_budgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/second_order_program.h"
#include "modules/quadric_processor/quadric_logic.h"
#include "modules/shading/shared_load.h"
#include "src/run/budget.h"
#include "src/run/delay_budgets.h"
#include "src/run/table_budgets.h"

namespace rastertlm::run {
namespace {

using imogene::Imogene;

double as_real(Cycles cycles) { return static_cast<double>(cycles.count()); }

void add_display_budgets(const Imogene& platform, std::vector<Budget>& budgets) {
  const imogene::Machine& machine = platform.machine();
  const video::Timing& timing = platform.timing();
  const unsigned slices = machine.object_processor.slices();
  const double retrace = as_real(timing.vertical_retrace);
  budgets.push_back(
      budget("line_start", as_real(object_processor::line_start_cycles(slices, timing.fields)),
             as_real(timing.horizontal_blanking), "cycles",
             fmt::format("{}2 x {} slices + 5{} (004, section 5.2.2); horizontal blanking of {} - {} pixel clocks",
                         timing.fields > 1 ? "twice (" : "", slices, timing.fields > 1 ? "), for two lines" : "",
                         timing.line.count(), machine.video.columns),
             "object_processor.slice_bits, video.interlaced, video.columns, video.pixel_clock_ns"));
  const imogene::BoardNeeds needs = imogene::board_needs(machine);
  const bool leads = needs.quadric_lead > Cycles(0);
  const std::string lead =
      leads ? fmt::format("{} by which quadrics start early; ", needs.quadric_lead.count()) : std::string();
  const std::string moves_lead = leads ? ", quadric_processor.alignment" : "";
  budgets.push_back(budget("frame_start", as_real(needs.frame_start + needs.quadric_lead), retrace, "cycles",
                           (machine.quadric.per_unit > 0 ? "the copy's 14 steps of a second order processor; "
                                                         : "the copy's 8 steps (004, section 5.2.2); ") +
                               lead + "vertical retrace",
                           "video.vertical_retrace_us" + moves_lead));
  budgets.push_back(
      budget("pipeline_skew", as_real(needs.retrace()), retrace, "cycles",
             "the last processor works later than the first by one comparator each (0 in a tree), then copies; " +
                 lead + "vertical retrace",
             "decision_unit.topology, host.computation_units, host.processors_per_unit, quadric_processor.per_unit, "
             "video.vertical_retrace_us" +
                 moves_lead));
}

// What a quadric processor must do before a line's pixels, in time.
void add_quadric_budgets(const Imogene& platform, std::vector<Budget>& budgets) {
  const imogene::Machine& machine = platform.machine();
  const quadric_processor::QuadricParameters& quadric = machine.quadric;
  if (quadric.per_unit == 0) return;
  const video::Timing& timing = platform.timing();
  const Cycles line_start = imogene::board_needs(machine).quadric_line_start;
  const bool by_discriminant =
      line_start == object_processor::second_order_line_cycles(quadric.slices(), timing.fields);
  const std::string what =
      by_discriminant ? fmt::format("{} x (3 x {} slices + 12) to the next line, and {} + 5 to its first pixel",
                                    timing.fields, quadric.slices(), quadric.slices())
                      : fmt::format("{} x (2 x {} slices + 5), of the first order processors of depth", timing.fields,
                                    quadric.plane_slices());
  budgets.push_back(budget(
      "quadric_line_start", as_real(line_start), as_real(timing.horizontal_blanking), "cycles",
      fmt::format("{}; horizontal blanking of {} - {} pixel clocks", what, timing.line.count(), machine.video.columns),
      by_discriminant
          ? "quadric_processor.slice_bits, quadric_processor.word_bits, video.interlaced, video.pixel_clock_ns"
          : "quadric_processor.slice_bits, quadric_processor.plane_bits, video.interlaced, "
            "video.pixel_clock_ns"));
  std::uint64_t used = platform.solid_slots().dropped;
  for (const auto& owners : platform.solid_slots().boards) used += owners.size();
  budgets.push_back(budget("quadrics", static_cast<double>(used), static_cast<double>(machine.quadric_processors()),
                           "processors", "one a solid of the scene; units x quadric processors a unit",
                           "host.computation_units, quadric_processor.per_unit"));
}

// What an operation costs is said by these; those of the other cost model are refused.
std::string arithmetic_keys(const host::HostParameters& host) {
  return host.cost == host::CostModel::sustained ? "host.sustained_mflops" : "host.instruction, host.clock_hz";
}

void add_host_budgets(Imogene& platform, std::vector<Budget>& budgets) {
  const HostLoad load = host_load(platform);
  const bool moves = platform.animation().moves();
  const std::string which =
      fmt::format("computation unit {}, the slowest{}", load.unit, load.steady ? "" : ", when everything is new");
  const host::HostParameters& host = platform.machine().host;
  const std::string units_and_arithmetic = "host.computation_units, " + arithmetic_keys(host);
  budgets.push_back(budget(
      "host.update", as_real(load.update.cycles), as_real(load.frame), "cycles",
      which + (load.steady ? ": links, arithmetic, waiting for the frame's grid, and bus" : ": arithmetic and bus") +
          "; host cycles of a video frame",
      units_and_arithmetic + ", host.assignment", moves));
  const double seconds = platform.timing().clock.seconds(platform.timing().frame);
  const bool sustained = host.cost == host::CostModel::sustained;
  const double a_flop = platform.cost().cycles_per_flop(load.update.operations);
  budgets.push_back(budget(
      "host.flops", static_cast<double>(load.update.flops()),
      sustained ? host.sustained_mflops * 1e6 * seconds : static_cast<double>(host.clock_hz) * seconds / a_flop, "flop",
      which + (sustained
                   ? ": operations counted in the code that computes; sustained rate x video frame"
                   : fmt::format(": operations counted in the code that computes; video frame / {:.4g} cycles, "
                                 "the mean of these operations by the table of instructions, integer ones included",
                                 a_flop)),
      units_and_arithmetic, moves));
  budgets.push_back(budget("host.bus", as_real(load.update.writing), as_real(load.frame), "cycles",
                           fmt::format("{}: {} words x {} bus words a word x {} cycles", which, load.update.words,
                                       platform.cost().bus_words(1), host.bus_cycles_per_word),
                           "host.bus_bits, host.bus_cycles_per_word, object_processor.word_bits, host.clock_hz",
                           moves));
  std::uint64_t used = 0;
  for (const auto& owners : platform.slots().boards) used += owners.size();
  budgets.push_back(budget(
      "processors", static_cast<double>(used + platform.slots().dropped + platform.most_pieces()),
      static_cast<double>(platform.machine().triangle_processors()), "processors",
      fmt::format("one an object (triangle) of the scene, and {} for pieces of clipped ones; units x processors a unit",
                  platform.most_pieces()),
      "host.computation_units, host.processors_per_unit"));
}

void take(Bottleneck& worst, const std::string& unit, const std::string& resource, double utilisation) {
  if (utilisation > worst.utilisation) worst = {unit, resource, utilisation};
}

// Rates are told apart from deadlines: a late host or loader shows the old picture again, a unit behind them that is
// late shows a wrong one.
bool is_rate(const imogene::Machine& machine, const Budget& budget) {
  if (budget.name == "tables.update") return !late_tables_are_shown(machine);
  return budget.name.starts_with("host.");
}

std::string limit_sentence(const Budget& b) {
  return fmt::format("{} needs {:.6g} {} and has {:.6g}; it moves with {}", b.name, b.used, b.unit, b.available,
                     b.moved_by);
}

// Of a displayed frame: copies, line starts and pixels.
double quadric_board_cycles(const imogene::Machine& machine) {
  const auto fields = static_cast<double>(video::timing(machine.video).fields);
  return fields * as_real(object_processor::second_order_frame_start_cycles()) +
         as_real(imogene::quadric_line_starts(machine)) +
         static_cast<double>(machine.video.columns) * static_cast<double>(machine.video.lines);
}

// Whose budget it is, of those that are met by what is wide and many enough.
const char* unit_of(const std::string& budget) {
  if (budget == "processors") return "object boards";
  if (budget == "quadrics") return "quadric boards";
  return budget.starts_with("quadric_") ? "quadric processors" : "object processors";
}

// What a budget of a quadric processor's delays is of; null of any other.
const char* quadric_delay_of(const std::string& budget) {
  if (budget == "quadric_adder_delay") return "adder delay in a pixel clock";
  if (budget == "quadric_root_delay") return "the root's subtracter in a pixel clock";
  if (budget == "quadric_sum_delay") return "sum of depth and root in a pixel clock";
  if (budget == "quadric_multiplier_delay") return "multiplier's adders in a pixel clock";
  return nullptr;
}

Bottleneck find_bottleneck(Imogene& platform, const std::vector<Budget>& budgets, const HostLoad& host) {
  const imogene::Machine& machine = platform.machine();
  const std::size_t fields = platform.timing().fields;
  const std::uint64_t line_cycles =
      object_processor::line_start_cycles(machine.object_processor.slices(), fields).count() +
      static_cast<std::uint64_t>(machine.video.columns);
  const std::uint64_t board_cycles = object_processor::frame_start_cycles().count() +
                                     line_cycles * (static_cast<std::uint64_t>(machine.video.lines) / fields);
  Bottleneck worst;
  take(worst, "object boards", "pixel clocks of a frame",
       static_cast<double>(board_cycles) / as_real(platform.timing().frame));
  if (machine.quadric.per_unit > 0)
    take(worst, "quadric boards", "pixel clocks of a frame",
         quadric_board_cycles(machine) / (as_real(platform.timing().frame) * static_cast<double>(fields)));
  for (const Budget& b : budgets) {
    if (!b.applies || b.available <= 0.0) continue;
    const double utilisation = b.used / b.available;
    if (b.name == "host.update")
      take(worst, fmt::format("computation unit {}", host.unit),
           fmt::format("host cycles of a frame ({:.0f} % of them arithmetic)",
                       100.0 * as_real(host.update.computing) / as_real(host.update.cycles)),
           utilisation);
    else if (b.name == "tables.update")
      take(worst, shading::kEngineNames[platform.table_loader().longest_load_engine()],
           machine.loader.when == shading::LoadTime::retrace ? "time of the vertical retrace" : "time of a frame",
           utilisation);
    else if (b.name == "adder_delay")
      take(worst, "object processors", "adder delay in a pixel clock", utilisation);
    else if (const char* const delay = quadric_delay_of(b.name); delay != nullptr)
      take(worst, "quadric processors", delay, utilisation);
    else if (b.name == "table_access")
      take(worst, "shading processor", "a table's access in a pixel clock", utilisation);
    else if (b.name == "table_store")
      take(worst, "table loader", "a table's access between two stores", utilisation);
    else if (!b.fits && !is_rate(machine, b))
      take(worst, unit_of(b.name), b.name, utilisation);
  }
  return worst;
}

}  // namespace

HostLoad host_load(Imogene& platform) {
  HostLoad load;
  const Clock& clock = platform.cost().clock();
  const std::uint64_t frame_ps = platform.timing().clock.picoseconds(platform.timing().frame);
  // A frame is no whole number of host cycles: the one that has begun when it ends is too late.
  load.frame = clock.cycles_at(frame_ps + 1) - Cycles(1);
  const auto& units = platform.computation_units();
  load.steady = platform.animation().moves() &&
                std::all_of(units.begin(), units.end(), [](const auto& unit) { return unit->updates().size() > 1; });
  for (std::size_t k = 0; k < platform.computation_units().size(); ++k) {
    const auto& updates = platform.computation_units()[k]->updates();
    for (std::size_t i = load.steady ? 1 : 0; i < updates.size(); ++i) {
      host::ComputationUnitModule::Update update = updates[i];
      // The first update waits for the meshes, which come once: what it computes and writes is what moving everything
      // would take.
      if (i == 0) update.cycles = update.computing + update.writing;
      if (update.cycles > load.update.cycles) {
        load.update = update;
        load.unit = k;
      }
    }
  }
  load.frames = (clock.picoseconds(load.update.cycles) + frame_ps - 1) / frame_ps;
  return load;
}

std::vector<Budget> imogene_budgets(Imogene& platform) {
  std::vector<Budget> budgets;
  add_display_budgets(platform, budgets);
  add_quadric_budgets(platform, budgets);
  add_delay_budgets(platform, budgets);
  add_host_budgets(platform, budgets);
  add_table_budgets(platform, budgets);
  return budgets;
}

Answer imogene_answer(Imogene& platform, const std::vector<Budget>& budgets) {
  const imogene::Machine& machine = platform.machine();
  const video::Timing& timing = platform.timing();
  const HostLoad host = host_load(platform);
  const bool moves = platform.animation().moves();
  const double frame_seconds = timing.clock.seconds(timing.frame);
  const double load_seconds = platform.table_loader().longest_load_seconds();

  Answer answer;
  answer.required_rate_hz = machine.video.refresh_hz;
  answer.display_rate_hz = timing.obtained_refresh_hz();
  const auto load_frames = static_cast<std::uint64_t>(std::ceil(load_seconds / frame_seconds));
  const std::uint64_t update_frames = moves ? std::max<std::uint64_t>({1, host.frames, load_frames}) : 1;
  answer.update_rate_hz = answer.display_rate_hz / static_cast<double>(update_frames);
  answer.frame_rate_hz = answer.update_rate_hz;
  answer.latency_frames = update_frames;
  const Cycles first_pixel = timing.first_pixel(0) + platform.pixel_latency();
  const Cycles last_pixel = timing.first_pixel(static_cast<std::size_t>(machine.video.lines - 1)) +
                            platform.pixel_latency() + Cycles(static_cast<std::uint64_t>(machine.video.columns - 1));
  answer.latency_first_pixel_us = 1e6 * timing.clock.seconds(timing.frame * update_frames + first_pixel);
  answer.latency_last_pixel_us = 1e6 * timing.clock.seconds(timing.frame * update_frames + last_pixel);
  answer.initial_load_frames = platform.frames_before_first();
  for (const auto& unit : platform.computation_units())
    answer.initial_load_us =
        std::max(answer.initial_load_us, 1e6 * platform.cost().clock().seconds(unit->updates().front().cycles));
  for (const auto& owners : platform.slots().boards)
    answer.initial_load_bytes += host::kResidentTriangleBytes * owners.size();
  answer.initial_load_bytes += platform.resident_solid_bytes();

  answer.bottleneck = find_bottleneck(platform, budgets, host);
  answer.headroom = answer.display_rate_hz / answer.bottleneck.utilisation / answer.required_rate_hz - 1.0;

  if (update_frames > 1) {
    const bool by_host = host.frames >= load_frames;
    answer.limits.push_back(fmt::format(
        "{} takes {} video frames for an update, so the picture changes {:.6g} times a second; it moves with {}",
        by_host ? fmt::format("computation unit {}", host.unit)
                : fmt::format("the {}", shading::kEngineNames[platform.table_loader().longest_load_engine()]),
        update_frames, answer.update_rate_hz,
        by_host ? "host.computation_units, " + arithmetic_keys(machine.host) : kLoaderKeys));
  }
  for (const Budget& b : budgets)
    if (b.applies && !b.fits && !is_rate(machine, b)) {
      answer.limits.push_back(limit_sentence(b));
      answer.display_works = false;
    }
  answer.sustained = answer.limits.empty();
  return answer;
}

}  // namespace rastertlm::run
