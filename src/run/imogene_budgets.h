// What an object machine's frame needs of each resource, beside what there is of it; and the answer that follows.
#pragma once

#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"

namespace rastertlm::run {

// The slowest computation unit's update in steady state, in cycles of the host clock.
struct HostLoad {
  std::size_t unit = 0;
  host::ComputationUnitModule::Update update;
  bool steady = false;  // measured on an update after the first picture; else on the first, in which everything is new
  Cycles frame;         // host cycles that end within one video frame
  std::uint64_t frames = 0;  // video frames that the update takes
};
HostLoad host_load(imogene::Imogene& platform);

std::vector<Budget> imogene_budgets(imogene::Imogene& platform);
Answer imogene_answer(imogene::Imogene& platform, const std::vector<Budget>& budgets);

}  // namespace rastertlm::run
