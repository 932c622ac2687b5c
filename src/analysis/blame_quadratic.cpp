// The span unit's frame: the set-up processor's work done again, and its spans drawn twice, in the machine's words and
// in wide ones.
#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/host/set_up_work.h"
#include "modules/span_unit/span_unit.h"
#include "src/analysis/blame_colour.h"
#include "src/analysis/blame_machines.h"
#include "src/base/fixed_point.h"
#include "src/run/exact_pictures.h"

namespace rastertlm::analysis {
namespace {

// Of registers that lose nothing that matters: at 2,048 steps their six roundings together make less than 2^-20 level.
constexpr std::int64_t kWideWord = 64;
constexpr std::int64_t kWideFraction = 40;

constexpr double kFullScale = 255.0;
constexpr double kHalfLevel = 0.5;

span_unit::SpanUnitParameters wide(span_unit::SpanUnitParameters parameters) {
  parameters.word_bits = kWideWord;
  parameters.fraction_bits = kWideFraction;
  return parameters;
}

// A register as a level; 0.5 has been added to its start.
double level_of(std::uint64_t word, const span_unit::SpanUnitParameters& p) {
  const std::int64_t value = sign_extend(word, static_cast<unsigned>(p.word_bits));
  return std::ldexp(static_cast<double>(value), -static_cast<int>(p.fraction_bits)) - kHalfLevel;
}

class QuadraticFrame : public ExplainedFrame {
 public:
  QuadraticFrame(const quadratic::Machine& machine, const scene::Scene& scene, const scene::Pose& pose,
                 const frame::Frame& shown, const frame::ExactFrame& ideal)
      : machine_(machine),
        wide_(wide(machine.span_unit)),
        shown_(shown),
        ideal_(ideal),
        background_(scene.background),
        exact_(scene, pose, run::exact_options(machine).front()),
        pixels_(shown.pixels()) {
    first_of_object_.assign(scene.object_count() + 2, 0);
    draw(scene, pose);
    for (std::size_t object = 1; object < first_of_object_.size(); ++object)
      first_of_object_[object] += first_of_object_[object - 1];
  }

  std::vector<Step> steps() const override {
    if (shades_pixels(machine_.set_up.method))
      return {Step::coverage, Step::depth_order, Step::coefficients, Step::interpolation, Step::output_rounding};
    return {Step::coverage,      Step::depth_order, Step::coefficients,   Step::interpolation,
            Step::set_up_solver, Step::start_edge,  Step::output_rounding};
  }

  Step look_at(std::size_t column, std::size_t line) override {
    column_ = column;
    line_ = line;
    const std::size_t pixel = line * shown_.columns + column;
    seen_ = {shown_.object[pixel], ideal_.object[pixel], 0, 0};
    here_ = &pixels_[pixel];
    const std::uint32_t drawn = here_->part == 0 ? 0 : parts_[here_->part - 1].triangle().object;
    if (drawn != seen_.machine) return Step::other_words;
    if (drawn != 0) row_ = parts_[here_->part - 1].row(column, line, &here_->registers, exact_light(drawn));
    if (seen_.machine == seen_.exact)
      seen_.exact_coverage = seen_.exact_depth = seen_.exact;
    else
      compare_covers();
    return seen_.to_blame();
  }

  glm::dvec3 levels(StepSet exact) const override {
    const std::uint32_t object = seen_.object(exact);
    const bool rounds = !exact.has(Step::output_rounding);
    if (object == 0) return rounds ? glm::floor(background_) : background_;
    glm::dvec3 value = (object == seen_.machine ? row_ : row_of(object)).value(with_absent(exact));
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(value[c])) value[c] = 0.0;
      value[c] = std::clamp(rounds ? std::floor(value[c] + kHalfLevel) : value[c], 0.0, kFullScale);
    }
    return value;
  }

 private:
  struct Pixel {
    std::uint32_t part = 0;   // index + 1 of what is seen; 0 nothing
    std::uint32_t depth = 0;  // its word
    ColourPart::Registers registers;
  };

  void draw(const scene::Scene& scene, const scene::Pose& pose) {
    host::ResidentScene resident;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      resident.objects.push_back({&scene.objects[i].mesh, scene.objects[i].two_sided, scene::object_moves(scene, i)});
    host::SetUpWork work(resident, machine_.set_up, machine_.set_up_format(), exact_.light().surfaces(),
                         exact_.light().rules());
    const auto columns = static_cast<std::uint32_t>(shown_.columns), lines = static_cast<std::uint32_t>(shown_.lines);
    span_unit::SpanUnit unit(machine_.span_unit, columns, lines);
    span_unit::SpanUnit wide_unit(wide_, columns, lines);
    work.begin_frame(pose, scene.camera.projection == scene::ProjectionKind::perspective);
    while (work.next())
      for (const set_up::ColourTriangle& triangle : work.coloured()) draw(triangle, unit, wide_unit, work.shader());
  }

  void draw(const set_up::ColourTriangle& triangle, span_unit::SpanUnit& unit, span_unit::SpanUnit& wide_unit,
            pixel_unit::PixelShader* shader) {
    set_up::SpanFormat format = machine_.set_up_format().span;
    const span_unit::TriangleLoad load = set_up::span_load(triangle, format);
    if (load.count == 0) return;
    format.word_bits = static_cast<unsigned>(kWideWord);
    format.fraction_bits = static_cast<unsigned>(kWideFraction);
    const span_unit::TriangleLoad wide_load = set_up::span_load(triangle, format);
    const ExactPiece* piece = piece_of(triangle);
    if (piece == nullptr) return;  // its pixels are then told apart
    parts_.emplace_back(triangle, *piece, exact_.grid().grid.fraction_bits, exact_.light(), machine_.set_up.linear());
    ++first_of_object_.at(triangle.object + 1);
    if (triangle.shading != nullptr) shader->set_up(*triangle.shading);
    const std::span<const span_unit::Span> spans = unit.draw(load).spans;
    const std::span<const span_unit::Span> wide_spans = wide_unit.draw(wide_load).spans;
    for (std::size_t i = 0; i < spans.size(); ++i) {
      if (triangle.shading != nullptr && spans[i].count > 0) shader->shade(spans[i], lit_);
      draw(spans[i], wide_spans[i], triangle.shading != nullptr);
    }
  }

  void draw(const span_unit::Span& span, const span_unit::Span& wide_span, bool by_pixels) {
    for (std::uint32_t k = 0; k < span.count; ++k) {
      Pixel& pixel = pixels_[span.line * shown_.columns + span.column + k];
      const std::uint64_t depth_word = at(span, span_unit::kDepthSet, k);
      const auto bits = static_cast<unsigned>(machine_.span_unit.depth_bits + machine_.span_unit.depth_fraction_bits);
      const auto depth = static_cast<std::uint32_t>((depth_word & low_mask(bits)) >>
                                                    static_cast<unsigned>(machine_.span_unit.depth_fraction_bits));
      const std::uint64_t farthest = low_mask(static_cast<unsigned>(machine_.span_unit.depth_bits));
      if (machine_.frame_store.depth_test && !(depth < (pixel.part == 0 ? farthest : pixel.depth))) continue;
      pixel.part = static_cast<std::uint32_t>(parts_.size());
      pixel.depth = depth;
      for (std::size_t c = 0; c < span_unit::kChannels; ++c) {
        const int channel = static_cast<int>(c);
        pixel.registers.value[channel] = by_pixels ? lit_[k][channel] : level_of(at(span, c, k), machine_.span_unit);
        pixel.registers.wide[channel] = by_pixels ? lit_[k][channel] : level_of(at(wide_span, c, k), wide_);
      }
    }
  }

  // I after k steps of a pixel.
  static std::uint64_t at(const span_unit::Span& span, std::size_t set, std::uint64_t k) {
    return span.i[set] + k * span.di[set] + (k == 0 ? 0 : k * (k - 1) / 2) * span.pixel_pixel[set];
  }

  // Of the object's pieces, the one that the triangle lies in.
  const ExactPiece* piece_of(const set_up::ColourTriangle& triangle) const {
    const auto [begin, end] = exact_.indices_of(triangle.object);
    const double unit = std::ldexp(1.0 / 3.0, -triangle.fraction_bits);
    const auto& [a, b, c] = triangle.corners;
    const double x = static_cast<double>(a.x + b.x + c.x) * unit;
    const double y = static_cast<double>(a.y + b.y + c.y) * unit;
    const auto inside = [&](const ExactPiece& piece) {
      const Weights w = weights_of(piece.piece, x, y);
      return std::min({w[0], w[1], 1.0 - w[0] - w[1]});
    };
    const ExactPiece* best = nullptr;
    for (std::size_t i = begin; i < end; ++i) {
      const ExactPiece& piece = exact_.pieces()[i];
      if (best == nullptr || inside(piece) > inside(*best)) best = &piece;
    }
    return best;
  }

  // Of the object's parts: one that covers the pixel, else the nearest to doing so; null where it has none.
  const ColourPart* part_of(std::uint32_t object) const {
    const ColourPart* best = nullptr;
    for (std::size_t i = first_of_object_[object]; i < first_of_object_[object + 1]; ++i)
      if (best == nullptr || parts_[i].least_weight(column_, line_) > best->least_weight(column_, line_))
        best = &parts_[i];
    return best;
  }

  // What a machine has not makes no error.
  StepSet with_absent(StepSet exact) const {
    return shades_pixels(machine_.set_up.method) ? exact.with(Step::set_up_solver).with(Step::start_edge) : exact;
  }

  // Of another triangle than the machine shows; what it does not draw has no errors of its own.
  ColourPart::Row row_of(std::uint32_t object) const {
    const glm::dvec3 light = exact_light(object);
    if (const ColourPart* part = part_of(object)) return part->row(column_, line_, nullptr, light);
    return {light, light, light, light, light, light};
  }

  glm::dvec3 exact_light(std::uint32_t object) const {
    const ExactPiece& piece = *exact_.piece_of(object, column_, line_);
    return exact_.light().levels(piece.piece, ExactSide::weights(piece, column_, line_));
  }

  void compare_covers() {
    std::vector<Cover> by_exact, by_machine;
    for (const ExactPiece& piece : exact_.pieces())
      if (ExactSide::covers(piece, column_, line_)) by_exact.push_back(cover_of(piece, part_of(piece.piece.object)));
    for (const ColourPart& part : parts_)
      if (part.covers(column_, line_))
        by_machine.push_back(cover_of(*exact_.piece_of(part.triangle().object, column_, line_), &part));
    seen_ = seen_by(seen_.machine, seen_.exact, by_exact, by_machine);
  }

  // Without a depth test what comes last is seen.
  Cover cover_of(const ExactPiece& piece, const ColourPart* part) const {
    const set_up::WordFormat format = machine_.depth_format();
    const auto near = static_cast<double>(set_up::near_depth(format));
    const auto range = static_cast<double>(set_up::far_depth(format)) - near;
    const double exact = near + ExactSide::depth(piece, column_, line_) * range;
    const double plane = part == nullptr ? exact : std::floor(part->depth(column_, line_));
    return {piece.piece.object, exact,
            machine_.frame_store.depth_test ? plane : -static_cast<double>(piece.piece.object)};
  }

  const quadratic::Machine& machine_;
  span_unit::SpanUnitParameters wide_;
  const frame::Frame& shown_;
  const frame::ExactFrame& ideal_;
  glm::dvec3 background_;
  ExactSide exact_;
  std::vector<Pixel> pixels_;
  std::vector<ColourPart> parts_;
  std::vector<std::size_t> first_of_object_;  // index into parts_
  std::vector<glm::dvec3> lit_;               // of a span, by a pixel unit
  std::size_t column_ = 0;
  std::size_t line_ = 0;
  Seen seen_;
  const Pixel* here_ = nullptr;
  ColourPart::Row row_;  // of the triangle that the machine shows there
};

}  // namespace

std::unique_ptr<ExplainedFrame> explained_quadratic(const quadratic::Machine& machine, const scene::Scene& scene,
                                                    const scene::Pose& pose, const frame::Frame& shown,
                                                    const frame::ExactFrame& ideal) {
  return std::make_unique<QuadraticFrame>(machine, scene, pose, shown, ideal);
}

}  // namespace rastertlm::analysis
