#include "src/run/software_budgets.h"

#include <fmt/format.h>

#include "src/base/shading_method.h"
#include "src/run/budget.h"

namespace rastertlm::run {
namespace {

// Of some frames, a frame each.
std::string what_counts(const host::SoftwareWork& work, std::size_t frames) {
  const auto mean = [frames](std::uint64_t count) { return (count + frames / 2) / frames; };
  return fmt::format("{} flop, {} triangles, {} pixels, {} of them lit one by one, {} lights at points, {}",
                     mean(work.operations.flops()), mean(work.triangles), mean(work.pixels), mean(work.lit_pixels),
                     mean(work.lights),
                     frames == 1 ? std::string("of the first frame") : fmt::format("means of {} frames", frames));
}

}  // namespace

std::vector<Budget> software_budgets(const host::SoftwareParameters& software, const host::Rendering& rendering,
                                     const std::string& platform, const std::vector<geometry::Pose>& poses,
                                     double frame_seconds) {
  constexpr double kMicroseconds = 1e6;
  std::vector<Budget> budgets;
  for (const ShadingMethodTraits& traits : kShadingMethods) {
    const bool offered =
        traits.method == ShadingMethod::phong || traits.platform.find(platform) != std::string_view::npos;
    if (!offered || !host::has_software(traits.method)) continue;
    host::SoftwareWork all;
    double seconds = 0.0;
    for (const geometry::Pose& pose : poses) {
      const host::SoftwareWork work = host::software_work(rendering, traits.method, pose);
      seconds += host::software_seconds(software, work);
      all += work;
    }
    budgets.push_back(budget(fmt::format("software.{}", traits.name),
                             kMicroseconds * seconds / static_cast<double>(poses.size()), kMicroseconds * frame_seconds,
                             "us", what_counts(all, poses.size()), "software.*", false));
  }
  return budgets;
}

}  // namespace rastertlm::run
