#include "modules/host/quadric_computation.h"

#include <fmt/format.h>

#include <utility>

#include "modules/set_up/solid_in_eye_space.h"
#include "src/base/errors.h"

namespace rastertlm::host {

using geometry::operation_counts;
using set_up::QuadricOutcome;

QuadricCounts& QuadricCounts::operator+=(const QuadricCounts& other) {
  drawn += other.drawn;
  outside += other.outside;
  refused += other.refused;
  return *this;
}

QuadricComputation::QuadricComputation(const ResidentScene& scene, const set_up::QuadricFormat& format,
                                       const std::vector<SlotOwner>& owners)
    : scene_(scene), format_(format) {
  std::vector<Solid> all;  // of the scene, without slots
  std::uint32_t number = 0;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const ResidentObject& object = scene.objects[i];
    if (object.solid != nullptr) all.push_back({number, i, 0});
    number += machine_objects(object);
  }
  for (const SlotOwner& owner : owners) {
    solids_.push_back(all.at(owner.object));
    solids_.back().slot = owner.slot;
  }
}

const std::vector<QuadricLoad>& QuadricComputation::set_up(const FrameWork& work, bool timed) {
  step_start_ = operations_;
  counted_start_ = operation_counts;
  timed_ = timed;
  loads_.clear();
  before_.clear();
  for (Solid& solid : solids_)
    if (work.renew[solid.object] != 0) renew(solid, work);
  operations_ = step_start_;
  operations_ += operation_counts - counted_start_;
  return loads_;
}

// The way back from the screen is computed once for all solids, until the projection changes.
void QuadricComputation::renew(Solid& solid, const FrameWork& work) {
  if (!eye_to_clip_ || *eye_to_clip_ != work.pose.eye_to_clip) {
    eye_to_clip_ = work.pose.eye_to_clip;
    screen_to_eye_ = set_up::screen_to_eye<Number>(*eye_to_clip_, {format_.words.columns, format_.words.lines});
  }
  const geometry::Solid& resident = *scene_.objects[solid.object].solid;
  const set_up::EyeSolid placed = set_up::solid_in_eye_space<Number>(resident, work.pose.object_to_eye[solid.object]);
  const set_up::QuadricSetUp result =
      set_up::set_up_quadric<Number>(placed.quadric, placed.planes, resident.material, screen_to_eye_, format_);
  switch (result.outcome) {
    case QuadricOutcome::drawn:
      solid.fate = Fate::drawn;
      break;
    case QuadricOutcome::outside:
      solid.fate = Fate::outside;
      break;
    case QuadricOutcome::refused:
      if (format_.parameters.on_refusal == quadric_processor::OnRefusal::error) refuse(solid, work, result.problem);
      solid.fate = Fate::refused;
      break;
  }
  const bool drawn = solid.fate == Fate::drawn;
  if (drawn || solid.loaded) put(solid, !drawn, result.words);
  solid.loaded = drawn;
}

void QuadricComputation::refuse(const Solid& solid, const FrameWork& work,
                                const set_up::QuadricProblem& problem) const {
  const std::string object = fmt::format("object[{}]", solid.object);
  std::string message = problem.message;
  if (problem.key.empty()) {
    message += fmt::format(" (frame {})", work.animation_frame);
  } else {
    message += fmt::format(" ({} of the scene, frame {})", object, work.animation_frame);
    if (problem.width > 0) message += fmt::format("; {} = {} would do", problem.key, problem.width);
  }
  message += "; quadric_processor.on_refusal = \"drop\" leaves out what cannot be drawn";
  if (problem.key.empty()) throw InputError({"", 0, object, std::move(message)});
  throw InputError(std::vector<Diagnostic>{
      {"", 0, problem.key, std::move(message)},
      {"", 0, object,
       fmt::format("is the solid that {} is too small for, in frame {}", problem.key, work.animation_frame)}});
}

void QuadricComputation::put(const Solid& solid, bool park, const quadric_processor::QuadricWords& words) {
  if (timed_) before_.push_back(operation_counts - counted_start_);
  loads_.push_back({solid.slot, park ? 0 : solid.number, park, words});
}

QuadricCounts QuadricComputation::counts() const {
  QuadricCounts counts;
  for (const Solid& solid : solids_) {
    counts.drawn += solid.fate == Fate::drawn ? 1U : 0U;
    counts.outside += solid.fate == Fate::outside ? 1U : 0U;
    counts.refused += solid.fate == Fate::refused ? 1U : 0U;
  }
  return counts;
}

}  // namespace rastertlm::host
