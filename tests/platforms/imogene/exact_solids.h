// What a pixel of a frame with solids may show, by exact arithmetic and the bounds of rounding.
//
// Each solid's surface lies between the solid grown and the solid shrunk by the bounds of its words
// (modules/set_up/solid_bounds.h: dQ <= (k^2 + 2 k + 2) / 4 of the discriminant's last place, k pixels from
// its anchor, hence a root that is off by sqrt(dQ) at the outline and dQ / (2 s) away from it, a place of the root, and
// (k + 1) / 2 depth words of l and of caps). What is within the grown one and outside of the shrunk one is nearer to an
// outline than dQ / |grad d|, and may be seen or not. Triangles cover what the exact renderer says, to a bound of
// depth.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "modules/set_up/quadric_set_up.h"
#include "modules/set_up/solid_in_eye_space.h"
#include "src/reference/renderer.h"
#include "src/reference/solids.h"
#include "src/run/exact_pictures.h"
#include "src/run/inputs.h"
#include "tests/modules/set_up/solid_comparison.h"

namespace rastertlm::test {

// Depth words between which something is seen first at a pixel; not certain: it may also not be there.
struct SeenRange {
  std::uint32_t object = 0;
  double low = 0;
  double high = 0;
  bool certain = false;
};

// One solid in one pose.
class JudgedSolid {
 public:
  JudgedSolid(const reference::PlacedSolid& placed, const geometry::Solid& solid, const glm::dmat4& object_to_eye,
              const set_up::View& view, const set_up::QuadricFormat& format)
      : placed_(placed), format_(format) {
    const set_up::EyeSolid eye = set_up::solid_in_eye_space<double>(solid, object_to_eye);
    result_ = set_up::set_up_quadric<double>(eye.quadric, eye.planes, solid.material, view.screen_to_eye, format);
    if (result_.outcome == set_up::QuadricOutcome::drawn)
      exact_.emplace(set_up::bounds_of({eye.quadric, eye.planes}, view, format_, result_));
  }
  JudgedSolid(const JudgedSolid&) = delete;
  JudgedSolid& operator=(const JudgedSolid&) = delete;

  const reference::PlacedSolid& placed() const { return placed_; }
  set_up::QuadricOutcome outcome() const { return result_.outcome; }
  const quadric_processor::QuadricWords& words() const { return result_.words; }

  // A depth that is read is a whole word: one more on either side.
  std::optional<SeenRange> range(double x, double y) const {
    if (!exact_) return std::nullopt;
    const auto grown = exact_->first(x, y, 1.0);
    const auto shrunk = exact_->first(x, y, -1.0);
    if (!grown) return std::nullopt;
    return SeenRange{placed_.number(), *grown - 1, shrunk ? *shrunk + 1 : 0, shrunk.has_value()};
  }

  // Radians by which the normal that the link carries may be off where `pixel` shows it: what E, k and the root are off
  // in the words' unit, then half an interval of the link word of each component. Nothing where that is everything.
  std::optional<double> normal_bound(const quadric_processor::QuadricPixel& pixel, double x, double y,
                                     unsigned link_bits) const {
    using quadric_processor::Surface;
    const auto bits = static_cast<unsigned>(format_.words.word_bits);
    double length = 0;
    unsigned longest = 0;
    for (const std::uint32_t word : pixel.normal) {
      const std::int64_t value = sign_extend(word, bits);
      length = std::hypot(length, static_cast<double>(value));
      longest = std::max(longest, bit_length(static_cast<std::uint64_t>(value < 0 ? ~value : value)));
    }
    const unsigned shift = longest > link_bits - 1 ? longest - (link_bits - 1) : 0;
    double off = std::sqrt(3.0) / 2 * std::ldexp(1.0, static_cast<int>(shift));
    if (pixel.surface == Surface::cap) off += std::sqrt(3.0) / 2;
    if (pixel.surface == Surface::near_root || pixel.surface == Surface::far_root) off += exact_->normal_error(x, y);
    if (!(off < length)) return std::nullopt;
    return std::asin(off / length);
  }

  // The exact depth, in words, of the surface that `pixel` shows.
  double depth_of(const quadric_processor::QuadricPixel& pixel, double x, double y) const {
    return exact_->surface_depth(pixel, x, y).depth;
  }

 private:
  const reference::PlacedSolid& placed_;
  const set_up::QuadricFormat& format_;
  set_up::QuadricSetUp result_;
  std::optional<set_up::SolidBounds> exact_;
};

// A pose of a scene whose triangles come before its solids, on a machine's screen.
class JudgedFrame {
 public:
  JudgedFrame(const run::Inputs& inputs, std::int64_t animation_frame)
      : machine_(inputs.content->object_machine("this test")),
        scene_(*inputs.content->scene),
        depth_(*run::depth_words(machine_)) {
    const auto columns = static_cast<std::size_t>(machine_.video.columns);
    const auto lines = static_cast<std::size_t>(machine_.video.lines);
    format_ = {
        machine_.quadric,
        {static_cast<int>(machine_.object_processor.word_bits), columns, lines, machine_.object_processor.edges}};
    const scene::Pose pose = scene::pose(scene_, animation_frame, columns, lines);
    const reference::RenderOptions snapped = run::exact_options(machine_).at(1);
    exact = reference::render(scene_, pose, snapped);
    scene::Scene bare = scene_;
    std::erase_if(bare.objects, [](const scene::Object& object) { return object.solid.has_value(); });
    triangles = reference::render(bare, scene::pose(bare, animation_frame, columns, lines), snapped);
    const geometry::Viewport viewport{columns, lines};
    const set_up::View view{viewport, set_up::screen_to_eye<double>(pose.eye_to_clip, viewport)};
    placed_ = reference::placed_solids(scene_, pose, viewport);
    std::size_t next = 0;
    for (std::size_t o = 0; o < scene_.objects.size(); ++o)
      if (const scene::Object& object = scene_.objects[o]; object.solid)
        solids.emplace_back(placed_.at(next++), *object.solid, pose.object_to_eye[o], view, format_);
  }
  JudgedFrame(const JudgedFrame&) = delete;
  JudgedFrame& operator=(const JudgedFrame&) = delete;

  const imogene::Machine& machine() const { return machine_; }
  double near() const { return depth_.near_word; }
  double range() const { return depth_.far_word - depth_.near_word; }
  double word(double depth) const { return near() + range() * depth; }
  bool is_solid(std::uint32_t object) const { return object > scene_.triangle_count(); }
  std::size_t refused() const {
    return static_cast<std::size_t>(std::count_if(solids.begin(), solids.end(), [](const JudgedSolid& solid) {
      return solid.outcome() == set_up::QuadricOutcome::refused;
    }));
  }

  // Everything that may be seen at a pixel, all depths of it.
  std::vector<SeenRange> ranges(std::size_t column, std::size_t line) const {
    std::vector<SeenRange> all;
    const std::size_t at = line * exact.columns + column;
    if (triangles.object[at] != 0)
      all.push_back({triangles.object[at], word(triangles.depth[at]) - depth_.bound,
                     word(triangles.depth[at]) + depth_.bound, true});
    for (const JudgedSolid& solid : solids)
      if (const auto seen = solid.range(static_cast<double>(column), static_cast<double>(line))) all.push_back(*seen);
    return all;
  }

  frame::ExactFrame exact, triangles;
  std::deque<JudgedSolid> solids;

 private:
  const imogene::Machine& machine_;
  const scene::Scene& scene_;
  reference::DepthWords depth_;
  set_up::QuadricFormat format_;
  std::vector<reference::PlacedSolid> placed_;
};

}  // namespace rastertlm::test
