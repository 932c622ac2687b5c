#include "src/run/delay_budgets.h"

#include <fmt/format.h>

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
  add_tables(platform.machine(), period, budgets);
}

}  // namespace rastertlm::run
