#include "src/run/delay_budgets.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/quadric_processor/quadric_pipeline.h"
#include "modules/shading/loader_budget.h"
#include "src/run/budget.h"

namespace rastertlm::run {
namespace {

const std::string kReadMoves = "shading.preset, shading.table_access_ns";

void add_adders(const imogene::Machine& machine, double period, std::vector<Budget>& budgets) {
  const object_processor::ObjectProcessorParameters& p = machine.object_processor;
  budgets.push_back(
      budget("adder_delay", p.adder_delay_ns(), period, "ns",
             fmt::format("{} + {} a bit x {} bits; the pixel clock's period ({} slices of the {}-bit word would fit)",
                         p.adder_ns, p.adder_ns_per_bit, p.slice_bits, p.slices_that_fit(period), p.word_bits),
             "object_processor.slice_bits, object_processor.adder_ns_per_bit, video.pixel_clock_ns"));
  // What cutting it into slices is for; where there is one slice, it is the machine's own adder again.
  const double whole = p.adder_ns + p.adder_ns_per_bit * static_cast<double>(p.word_bits);
  budgets.push_back(budget("adder_delay_unsliced", whole, period, "ns",
                           fmt::format("{} + {} a bit x {} bits in one piece; the pixel clock's period", p.adder_ns,
                                       p.adder_ns_per_bit, p.word_bits),
                           "object_processor.word_bits, object_processor.adder_ns_per_bit, video.pixel_clock_ns",
                           false));
}

std::string clocks(std::uint64_t count) { return fmt::format("{} clock{}", count, count == 1 ? "" : "s"); }

// Of a quadric processor: what is added up in one clock, of the slices of its adders and of each part behind them.
void add_quadric_adders(const imogene::Machine& machine, double period, std::vector<Budget>& budgets) {
  const quadric_processor::QuadricParameters& q = machine.quadric;
  if (q.per_unit == 0) return;
  const object_processor::ObjectProcessorParameters& p = machine.object_processor;
  const quadric_processor::QuadricPipeline pipeline = quadric_processor::quadric_pipeline(q, p);
  const auto add = [&](const char* name, std::uint64_t bits, const std::string& what, const std::string& moves) {
    budgets.push_back(budget(
        name, p.adder_ns + p.adder_ns_per_bit * static_cast<double>(bits), period, "ns",
        fmt::format("{} + {} a bit x {} bits{}; the pixel clock's period", p.adder_ns, p.adder_ns_per_bit, bits, what),
        "quadric_processor.slice_bits" + moves + ", object_processor.adder_ns_per_bit, video.pixel_clock_ns"));
  };
  const std::uint64_t stages = q.root().stages();
  const quadric_processor::NormalRows rows = quadric_processor::normal_rows(q, p);
  add("quadric_adder_delay", static_cast<std::uint64_t>(std::min(q.slice_bits, std::max(q.word_bits, q.plane_bits))),
      "", "");
  const std::uint64_t last = quadric_processor::subtracter_bits(stages);
  add("quadric_root_delay", pipeline.longest.root,
      fmt::format(", of the root's last subtracter: {} bits in {}, all {} stages in {}", last,
                  clocks(q.slices_of(last)), stages, pipeline.root_cycles),
      ", quadric_processor.root_integer_bits, quadric_processor.root_guard_bits");
  add("quadric_sum_delay", pipeline.longest.sums,
      fmt::format(", of the sums l -/+ s and the comparators behind them: {} bits in {}", q.plane_bits,
                  clocks(pipeline.sum_cycles)),
      ", quadric_processor.plane_bits");
  add("quadric_multiplier_delay", pipeline.longest.normal,
      fmt::format(", of a full adder a carry-save row: {} rows in {}; or of what joins sum and carry: {} bits in {}",
                  rows.rows, clocks(pipeline.row_cycles), rows.joined(), clocks(pipeline.join_cycles)),
      ", quadric_processor.multiplier_bits, quadric_processor.root_integer_bits, quadric_processor.root_guard_bits");
}

void add_tables(const imogene::Machine& machine, double period, std::vector<Budget>& budgets) {
  const shading::ShadingParameters& p = machine.shading;
  const std::string path =
      fmt::format("address register {} + access {} + set-up {}{}", p.table_address_ns, p.table_access_ns,
                  p.table_set_up_ns, p.preset.empty() ? "" : fmt::format(" ({})", p.preset));
  budgets.push_back(budget("table_access", p.table_read_ns(), period, "ns", path + "; the pixel clock's period",
                           kReadMoves + ", video.pixel_clock_ns"));
  // A memory must take the two stores that follow each other the soonest: the shortest time is what it has.
  const shading::StoreTime store = shading::shortest_store_time(machine.loader);
  budgets.push_back(budget("table_store", p.table_read_ns(), store.ns, "ns", path + "; " + store.source,
                           kReadMoves + ", " + store.moved_by));
}

}  // namespace

void add_delay_budgets(const imogene::Imogene& platform, std::vector<Budget>& budgets) {
  const double period = platform.timing().clock.period_ns();
  add_adders(platform.machine(), period, budgets);
  add_quadric_adders(platform.machine(), period, budgets);
  add_tables(platform.machine(), period, budgets);
}

}  // namespace rastertlm::run
