// The object machine's frame: planes of words at each pixel, the nearest, and the shading processor's chain.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "modules/set_up/triangle_set_up.h"
#include "src/analysis/blame_exact.h"
#include "src/analysis/blame_machines.h"
#include "src/analysis/blame_shading.h"
#include "src/base/fixed_point.h"
#include "src/run/exact_pictures.h"

namespace rastertlm::analysis {
namespace {

using object_processor::LinearWords;
using object_processor::TriangleWords;

class ImogeneFrame : public ExplainedFrame {
 public:
  ImogeneFrame(const imogene::Machine& machine, const scene::Scene& scene, const scene::Pose& pose,
               const frame::Frame& shown, const frame::ExactFrame& ideal)
      : shown_(shown),
        ideal_(ideal),
        background_(scene.background),
        format_{static_cast<int>(machine.object_processor.word_bits), shown.columns, shown.lines,
                machine.object_processor.edges},
        exact_(scene, pose, run::exact_options(machine).front()),
        shader_(loaded_shader(machine, scene, exact_.light().lights(), pose)),
        chain_(shader_, machine.object_processor, exact_.light().surfaces(), exact_.light().lights(),
               exact_.light().rules().ambient_light),
        nearest_(shown.pixels(), kNothing) {
    for (const ExactPiece& piece : exact_.pieces()) {
      const set_up::SetUpResult result = set_up::set_up_triangle<double>(
          piece.cut.piece.corners, piece.cut.piece.material, piece.cut.two_sided, exact_.grid().grid, format_);
      words_.push_back(result.outcome == set_up::Outcome::drawn ? std::optional(result.words) : std::nullopt);
      if (words_.back()) draw(piece, *words_.back());
    }
  }

  std::vector<Step> steps() const override {
    std::vector<Step> steps{Step::coverage, Step::depth_order};
    for (const Step step : ShadingChain::kChain) steps.push_back(step);
    return steps;
  }

  Step look_at(std::size_t column, std::size_t line) override {
    column_ = column;
    line_ = line;
    const std::size_t pixel = line * shown_.columns + column;
    seen_ = {shown_.object[pixel], ideal_.object[pixel], 0, 0};
    // What the pose's words show: its nearest depth, whichever of equal triangles the boards' order prefers.
    const TriangleWords* words = words_of(seen_.machine);
    const std::uint64_t depth = words == nullptr ? kNothing : at(words->depth);
    if (depth != nearest_[pixel] || (words != nullptr && !covers(*words))) return Step::other_words;
    if (seen_.machine == seen_.exact)
      seen_.exact_coverage = seen_.exact_depth = seen_.exact;
    else
      compare_covers();
    return seen_.to_blame();
  }

  glm::dvec3 levels(StepSet exact) const override {
    const std::uint32_t object = seen_.object(exact);
    if (object == 0) {
      if (exact.has(Step::output_rounding)) return background_;
      const auto& levels = shader_.front().background;
      return {levels[0], levels[1], levels[2]};
    }
    const ExactPiece& piece = *exact_.piece_of(object, column_, line_);
    PixelNormal normal;
    normal.exact = reference::PieceLight::normal_at(piece.piece, ExactSide::weights(piece, column_, line_));
    const TriangleWords* words = words_of(object);
    // What the machine does not draw has no words: its plane is the exact one.
    if (words == nullptr) return chain_.levels(normal, piece.piece.material, exact.with(Step::coefficients));
    for (std::size_t i = 0; i < 3; ++i) normal.words[i] = at(words->normals[i]);
    return chain_.levels(normal, piece.piece.material, exact);
  }

 private:
  static constexpr std::uint64_t kNothing = std::numeric_limits<std::uint64_t>::max();

  static shading::DeferredShader loaded_shader(const imogene::Machine& machine, const scene::Scene& scene,
                                               const std::vector<geometry::LightSource>& exact_lights,
                                               const scene::Pose& pose) {
    shading::DeferredShader shader(machine.shading, machine.object_processor.normal_bits);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
      const scene::Material& m = scene.materials[i];
      shader.set_material(i, {{m.colour.x, m.colour.y, m.colour.z}, m.ambient, m.diffuse, m.specular, m.exponent});
    }
    for (std::size_t i = 0; i < exact_lights.size(); ++i) {
      const glm::dvec3 towards = pose.lights[i].vector;
      const glm::dvec3 halfway = geometry::normalised<double>(towards + glm::dvec3(0.0, 0.0, 1.0));
      const glm::dvec3 intensity = pose.lights[i].intensity;
      shader.set_light(i, {{towards.x, towards.y, towards.z},
                           {halfway.x, halfway.y, halfway.z},
                           {intensity.x, intensity.y, intensity.z}});
    }
    shader.set_ambient_light({scene.ambient_light.x, scene.ambient_light.y, scene.ambient_light.z});
    shader.set_background({scene.background.x, scene.background.y, scene.background.z});
    shader.load();
    return shader;
  }

  std::uint32_t at(const LinearWords& words) const { return at(words, column_, line_); }
  std::uint32_t at(const LinearWords& words, std::size_t column, std::size_t line) const {
    const auto x = static_cast<std::uint32_t>(column);
    const auto y = static_cast<std::uint32_t>(line + 1);
    return (words.a * x + words.b * y + words.c) & mask();
  }
  std::uint32_t mask() const { return static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(format_.word_bits))); }
  bool covers(const TriangleWords& words) const { return covers(words, column_, line_); }
  bool covers(const TriangleWords& words, std::size_t column, std::size_t line) const {
    return std::all_of(words.edges.begin(), words.edges.end(), [&](const LinearWords& edge) {
      return (at(edge, column, line) >> (format_.word_bits - 1) & 1U) == 0;
    });
  }

  // The depth words of what covers; edges cannot wrap on the screen, so nothing is covered far from the corners.
  void draw(const ExactPiece& piece, const TriangleWords& words) {
    const auto& [a, b, c] = piece.piece.corners;
    const auto range = [](double p, double q, double r, std::size_t count) {
      constexpr double kAround = 2.0;  // pixels: what corners move
      const double last = static_cast<double>(count);
      return std::pair(static_cast<std::size_t>(std::clamp(std::floor(std::min({p, q, r}) - kAround), 0.0, last)),
                       static_cast<std::size_t>(std::clamp(std::ceil(std::max({p, q, r}) + kAround), 0.0, last)));
    };
    const auto [left, right] = range(a.x, b.x, c.x, shown_.columns);
    const auto [top, bottom] = range(a.y, b.y, c.y, shown_.lines);
    for (std::size_t y = top; y < bottom; ++y)
      for (std::size_t x = left; x < right; ++x) {
        if (!covers(words, x, y)) continue;
        std::uint64_t& nearest = nearest_[y * shown_.columns + x];
        nearest = std::min<std::uint64_t>(nearest, at(words.depth, x, y));
      }
  }

  // Of the object's pieces that are drawn: the nearest that covers the pixel, else that of the exact side; null where
  // it has none.
  const TriangleWords* words_of(std::uint32_t object) const {
    if (object == 0) return nullptr;
    const TriangleWords* best = nullptr;
    const auto [begin, end] = exact_.indices_of(object);
    for (std::size_t i = begin; i < end; ++i)
      if (words_[i] && covers(*words_[i]) && (best == nullptr || at(words_[i]->depth) < at(best->depth)))
        best = &*words_[i];
    if (best != nullptr) return best;
    const ExactPiece* piece = exact_.piece_of(object, column_, line_);
    if (piece == nullptr) return nullptr;
    const auto& words = words_[static_cast<std::size_t>(piece - exact_.pieces().data())];
    return words ? &*words : nullptr;
  }

  void compare_covers() {
    std::vector<Cover> by_exact, by_machine;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const ExactPiece& piece = exact_.pieces()[i];
      const bool in_machine = words_[i] && covers(*words_[i]);
      const bool in_exact = ExactSide::covers(piece, column_, line_);
      if (!in_machine && !in_exact) continue;
      const Cover cover = cover_of(piece, words_[i]);
      if (in_machine) by_machine.push_back(cover);
      if (in_exact) by_exact.push_back(cover);
    }
    seen_ = seen_by(seen_.machine, seen_.exact, by_exact, by_machine);
  }

  // A plane of words may wrap outside its triangle: of all it may stand for there, what is nearest the exact one.
  Cover cover_of(const ExactPiece& piece, const std::optional<TriangleWords>& words) const {
    Cover cover;
    cover.object = piece.piece.object;
    const auto near = static_cast<double>(set_up::near_depth(format_));
    const auto range = static_cast<double>(set_up::far_depth(format_)) - near;
    cover.exact_depth = near + ExactSide::depth(piece, column_, line_) * range;
    cover.machine_depth = cover.exact_depth;
    if (!words) return cover;
    const std::int64_t exact = round_half_up(cover.exact_depth);
    const std::int64_t off =
        wrap_signed(static_cast<std::int64_t>(at(words->depth)) - exact, static_cast<unsigned>(format_.word_bits));
    cover.machine_depth = static_cast<double>(exact + off);
    return cover;
  }

  const frame::Frame& shown_;
  const frame::ExactFrame& ideal_;
  glm::dvec3 background_;
  set_up::WordFormat format_;
  ExactSide exact_;
  shading::DeferredShader shader_;
  ShadingChain chain_;
  std::vector<std::optional<TriangleWords>> words_;  // by exact_.pieces()
  std::vector<std::uint64_t> nearest_;               // depth words
  std::size_t column_ = 0;
  std::size_t line_ = 0;
  Seen seen_;
};

}  // namespace

std::unique_ptr<ExplainedFrame> explained_imogene(const imogene::Machine& machine, const scene::Scene& scene,
                                                  const scene::Pose& pose, const frame::Frame& shown,
                                                  const frame::ExactFrame& ideal) {
  return std::make_unique<ImogeneFrame>(machine, scene, pose, shown, ideal);
}

}  // namespace rastertlm::analysis
