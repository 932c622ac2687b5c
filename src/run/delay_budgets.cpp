#include "src/run/delay_budgets.h"

#include <fmt/format.h>

#include "src/run/budget.h"

namespace rastertlm::run {

void add_delay_budgets(const imogene::Imogene& platform, std::vector<Budget>& budgets) {
  const imogene::Machine& machine = platform.machine();
  const video::Timing& timing = platform.timing();
  const double period = timing.clock.period_ns();
  budgets.push_back(
      budget("adder_delay", machine.object_processor.adder_delay_ns(), period, "ns",
             fmt::format("{} + {} a bit x {} bits; the pixel clock's period ({} slices of the {}-bit word would fit)",
                         machine.object_processor.adder_ns, machine.object_processor.adder_ns_per_bit,
                         machine.object_processor.slice_bits, machine.object_processor.slices_that_fit(period),
                         machine.object_processor.word_bits),
             "object_processor.slice_bits, video.pixel_clock_ns"));
}

}  // namespace rastertlm::run
