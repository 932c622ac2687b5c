// The timeline of a host's update, worked out from counted operations, message sizes and words alone, on the T800-20 of
// the default machine: 20 MHz, 40 / 3 cycles a floating-point operation, 19 + 23 / 2 cycles a byte on a link, store and
// forward, 3 cycles a word on the bus.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/host/computation.h"
#include "platforms/imogene/machine.h"
#include "src/run/inputs.h"
#include "src/run/simulate.h"

namespace rastertlm::test {

inline constexpr std::uint64_t kHostPs = 50'000;
inline constexpr std::uint64_t kFramePs = 333'333ULL * 60'000;
inline constexpr double kDisplayHz = 1e12 / kFramePs;
inline constexpr std::uint64_t kWords = 22;                    // 21 coefficients and a material
inline constexpr std::uint64_t kParkWords = 3;                 // one edge is enough
inline constexpr std::uint64_t kTriangleBytes = 4 * (18 + 1);  // three corners of position and normal, and a material
inline constexpr std::uint64_t kPieceBytes = 4 * (kWords + 1);

inline std::uint64_t arithmetic(std::uint64_t flops) { return (40 * flops + 2) / 3; }
inline constexpr std::uint64_t kMessageStart = 19;
inline std::uint64_t message(std::uint64_t bytes) { return kMessageStart + (23 * bytes + 1) / 2; }

// Who feeds unit k: another unit, or the animation unit (-1), which feeds three, as every unit does.
using Parents = std::vector<int>;
inline const Parents kTwo{-1, -1};
inline const Parents kThree{-1, -1, -1};
inline const Parents kFour{-1, -1, -1, 0};
inline const Parents kEight{-1, -1, -1, 0, 0, 0, 1, 1};
inline const Parents kChainOfFour{-1, 0, 1, 2};

struct Write {
  host::Load load;
  std::uint64_t before = 0;  // flops of the second step up to it
  std::uint64_t words = 0;
};

struct UnitWork {
  std::uint64_t first_flops = 0;   // transformation
  std::uint64_t second_flops = 0;  // coefficients
  std::uint64_t words = 0;
  std::uint64_t homeless = 0;  // pieces that it reports
  std::vector<Write> writes;   // in order
  std::uint64_t flops() const { return first_flops + second_flops; }
};

struct UpdateWork {
  std::uint64_t message_bytes = 0;        // what the animation unit says
  std::vector<std::uint64_t> mesh_bytes;  // of each unit, with the first message; empty later
  std::uint64_t placed = 0;               // pieces in its plan
  std::vector<UnitWork> units;
};

// Host cycles from the retrace at which the animation unit begins, by unit.
struct Schedule {
  std::vector<std::uint64_t> fits;  // to the start of the second step
  std::vector<std::uint64_t> done;  // to the last word
};

inline Schedule timeline(const UpdateWork& work, const Parents& parents) {
  const std::size_t count = parents.size();
  const auto parent = [&](std::size_t k) { return static_cast<std::size_t>(parents[k]); };
  std::vector<std::uint64_t> told(count), ready(count), subtree(count, 1), homeless(count), planned(count);
  Schedule schedule{std::vector<std::uint64_t>(count), std::vector<std::uint64_t>(count)};
  auto& [fits, done] = schedule;
  // The link to a unit carries its own meshes and those of the units behind it.
  std::vector<std::uint64_t> meshes = work.mesh_bytes;
  meshes.resize(count);
  for (std::size_t k = count; k-- > 0;)
    if (parents[k] >= 0) meshes[parent(k)] += meshes[k];
  // A processor starts the messages to those that it feeds one after the other, and then works.
  std::vector<std::uint64_t> earlier(count), fed(count);
  for (std::size_t k = 0; k < count; ++k) {
    earlier[k] = kMessageStart * static_cast<std::uint64_t>(
                                     std::count(parents.begin(), parents.begin() + static_cast<long>(k), parents[k]));
    fed[k] =
        kMessageStart * static_cast<std::uint64_t>(std::count(parents.begin(), parents.end(), static_cast<int>(k)));
  }
  for (std::size_t k = 0; k < count; ++k) {
    told[k] = (parents[k] < 0 ? 0 : told[parent(k)]) + earlier[k] + message(work.message_bytes + meshes[k]);
    ready[k] = told[k] + fed[k] + arithmetic(work.units[k].first_flops);
    homeless[k] = work.units[k].homeless;
  }
  // A survey goes up when the own one and those from below are there.
  std::uint64_t settled = 0;
  for (std::size_t k = count; k-- > 0;) {
    const std::uint64_t arrives = ready[k] + message(1 + 4 * subtree[k] + kPieceBytes * homeless[k]);
    std::uint64_t& waits = parents[k] < 0 ? settled : ready[parent(k)];
    waits = std::max(waits, arrives);
    if (parents[k] < 0) continue;
    subtree[parent(k)] += subtree[k];
    homeless[parent(k)] += homeless[k];
  }
  for (std::size_t k = 0; k < count; ++k) {
    planned[k] = (parents[k] < 0 ? settled : planned[parent(k)]) + earlier[k] + message(1 + kPieceBytes * work.placed);
    fits[k] = planned[k] + fed[k];
    done[k] = fits[k] + arithmetic(work.units[k].second_flops) + 3 * work.units[k].words;
  }
  return schedule;
}

// The computation units' arithmetic, without the machine around it: what it counts.
class Units {
 public:
  explicit Units(const run::Inputs& inputs) : scene_(*inputs.content->scene) {
    const imogene::Machine& machine = inputs.content->object_machine("this test");
    const auto columns = static_cast<std::size_t>(machine.video.columns);
    const auto lines = static_cast<std::size_t>(machine.video.lines);
    for (const scene::Object& object : scene_.objects)
      resident_.objects.push_back({&object.mesh, object.two_sided, !object.animation.empty()});
    resident_.pose = [this, columns, lines](std::int64_t frame) { return scene::pose(scene_, frame, columns, lines); };
    const host::MachineFormat format{
        {static_cast<int>(machine.object_processor.word_bits), columns, lines, machine.object_processor.edges},
        imogene::snap_grids(machine),
        {columns, lines},
        static_cast<std::uint32_t>(machine.host.processors_per_unit)};
    for (const auto& owners : host::assign_objects(scene_.triangle_count(), machine.host).boards)
      units_.emplace_back(resident_, format, owners);
  }

  // Of an animation frame in which every object moves: a header, the matrices of the moving objects, and in the first
  // one the camera's two and the lights.
  UpdateWork update(std::int64_t animation_frame, bool initial) {
    const host::FrameWork work = host::Animation(resident_, false).frame_work(animation_frame, initial);
    UpdateWork result;
    result.message_bytes = 8 + 64 * scene_.objects.size() + (initial ? 2 * 64 + 12 * scene_.lights.size() : 0);
    bool guarded = false;
    std::vector<host::Piece> homeless;
    std::vector<std::uint32_t> free_slots;
    for (host::Computation& unit : units_) {
      const std::uint64_t before = unit.operations().flops();
      const host::Survey survey = unit.survey(work);
      guarded = guarded || survey.guarded;
      free_slots.push_back(survey.free_slots);
      homeless.insert(homeless.end(), survey.homeless.begin(), survey.homeless.end());
      UnitWork& own = result.units.emplace_back();
      own.first_flops = unit.operations().flops() - before;
      own.homeless = survey.homeless.size();
      if (initial) result.mesh_bytes.push_back(kTriangleBytes * unit.triangles());
    }
    const auto placed = host::place_pieces(homeless, free_slots);
    for (std::size_t k = 0; k < units_.size(); ++k) {
      const std::uint64_t before = units_[k].operations().flops();
      for (const host::Load& load : units_[k].set_up(guarded, placed[k])) {
        const std::size_t number = result.units[k].writes.size();
        result.units[k].writes.push_back({load, units_[k].before()[number].flops(), load.park ? kParkWords : kWords});
        result.units[k].words += result.units[k].writes.back().words;
      }
      result.units[k].second_flops = units_[k].operations().flops() - before;
      result.placed += placed[k].size();
    }
    return result;
  }

 private:
  const scene::Scene& scene_;
  host::ResidentScene resident_;
  std::vector<host::Computation> units_;
};

}  // namespace rastertlm::test
