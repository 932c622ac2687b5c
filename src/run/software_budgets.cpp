#include "src/run/software_budgets.h"

#include <fmt/format.h>

#include "src/run/budget.h"

namespace rastertlm::run {

std::vector<Budget> software_budgets(const host::SoftwareParameters& software, const host::Rendering& rendering,
                                     const geometry::Pose& pose, double frame_seconds) {
  constexpr double kMicroseconds = 1e6;
  std::vector<Budget> budgets;
  for (const auto& [method, name] :
       {std::pair(ShadingMethod::gouraud, "software.gouraud"),
        std::pair(ShadingMethod::quadratic, "software.quadratic"), std::pair(ShadingMethod::phong, "software.phong")}) {
    const host::SoftwareWork work = host::software_work(rendering, method, pose);
    budgets.push_back(budget(name, kMicroseconds * host::software_seconds(software, work),
                             kMicroseconds * frame_seconds, "us",
                             fmt::format("{} flop, {} triangles, {} pixels of the first frame on software.preset",
                                         work.operations.flops(), work.triangles, work.pixels),
                             "software.*", false));
  }
  return budgets;
}

}  // namespace rastertlm::run
