#include "src/analysis/triangle_screen.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/host/set_up_work.h"
#include "modules/object_processor/object_board.h"
#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_unit.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using geometry::SnapGrid;
using geometry::SnapGrids;
using geometry::SnappedPoint;
using set_up::ScreenTriangle;
using set_up::WordFormat;

constexpr double kHalfPlace = std::numeric_limits<double>::epsilon() / 2;

std::array<SnappedPoint, 3> snapped(const ScreenTriangle<double>& corners, int fraction_bits) {
  return {geometry::snap(corners[0], fraction_bits), geometry::snap(corners[1], fraction_bits),
          geometry::snap(corners[2], fraction_bits)};
}

class ObjectScreen : public TriangleScreen {
 public:
  ObjectScreen(const imogene::Machine& machine, const Tampering& tampering)
      : parameters_(right(machine.object_processor)),
        format_{static_cast<int>(parameters_.word_bits), static_cast<std::size_t>(machine.video.columns),
                static_cast<std::size_t>(machine.video.lines), parameters_.edges},
        grids_(imogene::snap_grids(machine)),
        tampering_(tampering),
        board_(parameters_, 1, 0, static_cast<std::uint32_t>(format_.columns),
               static_cast<std::uint32_t>(format_.lines)) {
    line_.resize(format_.columns);
  }

  int draw(const ScreenTriangle<double>& corners, const SnapGrid& grid, const Visit& visit) override {
    set_up::SetUpResult result = set_up::set_up_triangle<double>(corners, 0, true, grid, format_);
    if (result.outcome != set_up::Outcome::drawn) return 0;
    if (tampering_.object_words) tampering_.object_words(result.words);
    board_.write(0, result.words);
    board_.copy();
    const object_processor::Interval lines = board_.lines_of_processor(0);
    for (std::int64_t y = lines.begin; y < lines.end; ++y) {
      line_.clear();
      board_.evaluate_line(static_cast<std::uint32_t>(y), line_);
      for (std::size_t x = line_.begin; x < line_.end; ++x)
        if (line_.object[x] != 0) visit(static_cast<std::int64_t>(x), y, static_cast<double>(line_.depth[x]));
    }
    const auto points = snapped(corners, plane_bits(grid));
    return geometry::faces_viewer(geometry::doubled_area(points[0], points[1], points[2])) ? 1 : -1;
  }

  bool is_exact() const override { return format_.edges == set_up::EdgeForm::snapped; }
  const SnapGrids& grids() const override { return grids_; }
  const WordFormat& depth_format() const override { return format_; }
  double displacement(const ScreenTriangle<double>& corners, const SnapGrid& grid) const override {
    if (is_exact()) return TriangleScreen::displacement(corners, grid);
    const set_up::SetUpResult result = set_up::set_up_triangle<double>(corners, 0, true, grid, format_);
    const double across = static_cast<double>(format_.columns + format_.lines) - 2;  // from any sample to any other
    double most = 0.0;
    for (const auto& edge : result.words.edges)
      most = std::max(most, 0.5 * (across + 1) / std::hypot(slope_of(edge.a), slope_of(edge.b)));
    return most * (1 + 1e-9);
  }
  int plane_bits(const SnapGrid& grid) const override {
    return is_exact() ? grid.fraction_bits : set_up::kScaledFractionBits;
  }

  std::optional<std::array<object_processor::LinearWords, 3>> normal_words(const ScreenTriangle<double>& corners,
                                                                           const SnapGrid& grid) const override {
    set_up::SetUpResult result = set_up::set_up_triangle<double>(corners, 0, true, grid, format_);
    if (result.outcome != set_up::Outcome::drawn) return std::nullopt;
    if (tampering_.object_words) tampering_.object_words(result.words);
    return result.words.normals;
  }

  double plane_bound(const SnappedPlane& plane, std::int64_t x, std::int64_t y) const override {
    const auto [left, right] = std::minmax({plane.corners()[0].x, plane.corners()[1].x, plane.corners()[2].x});
    const auto [top, bottom] = std::minmax({plane.corners()[0].y, plane.corners()[1].y, plane.corners()[2].y});
    const double dx = from_middle(left, right, format_.columns, plane.fraction_bits(), x);
    const double dy = from_middle(top, bottom, format_.lines, plane.fraction_bits(), y);
    // From a corner to the middle in doubles, from there in words.
    const double width = std::ldexp(static_cast<double>(right - left), -plane.fraction_bits());
    const double height = std::ldexp(static_cast<double>(bottom - top), -plane.fraction_bits());
    return 0.5 * (dx + dy + 1) + plane.rounding(dx + width, dy + height);
  }

 private:
  static object_processor::ObjectProcessorParameters right(object_processor::ObjectProcessorParameters parameters) {
    parameters.carry_clock = object_processor::CarryClock::clock1;
    return parameters;
  }
  double slope_of(std::uint32_t word) const {
    return static_cast<double>(sign_extend(word, static_cast<unsigned>(format_.word_bits)));
  }
  // From the middle of what is on the screen of [low, high] to a sample.
  static double from_middle(std::int64_t low, std::int64_t high, std::size_t samples, int bits, std::int64_t sample) {
    const double last = static_cast<double>(samples) - 1;
    const auto on_screen = [&](std::int64_t steps) {
      return std::clamp(std::ldexp(static_cast<double>(steps), -bits), 0.0, last);
    };
    return std::fabs(static_cast<double>(sample) - (on_screen(low) + on_screen(high)) / 2);
  }

  object_processor::ObjectProcessorParameters parameters_;
  WordFormat format_;
  SnapGrids grids_;
  const Tampering& tampering_;
  object_processor::ObjectBoard board_;
  frame::FragmentLine line_;
};

class SpanScreen : public TriangleScreen {
 public:
  SpanScreen(const quadratic::Machine& machine, const Tampering& tampering)
      : parameters_(right(machine.span_unit)),
        format_(machine.depth_format()),
        grids_(host::span_grids(machine.viewport(), static_cast<int>(machine.set_up.snap_bits))),
        tampering_(tampering),
        unit_(parameters_, static_cast<std::uint32_t>(format_.columns), static_cast<std::uint32_t>(format_.lines)) {}

  int draw(const ScreenTriangle<double>& corners, const SnapGrid& grid, const Visit& visit) override {
    set_up::ColourTriangle triangle;
    triangle.fraction_bits = grid.fraction_bits;
    triangle.corners = snapped(corners, grid.fraction_bits);
    const auto& [a, b, c] = triangle.corners;
    const std::int64_t area = geometry::doubled_area(a, b, c);
    if (area == 0) return 0;
    triangle.depth = depth_plane(corners, grid.fraction_bits, format_).values();
    span_unit::TriangleLoad load =
        set_up::span_load(triangle, set_up::SpanFormat::of(parameters_, static_cast<std::int64_t>(format_.lines)));
    if (tampering_.span_load) tampering_.span_load(load);
    const auto bits = static_cast<unsigned>(parameters_.depth_bits + parameters_.depth_fraction_bits);
    for (const span_unit::Span& span : unit_.draw(load).spans) {
      std::uint64_t word = span.i[span_unit::kDepthSet];
      for (std::uint32_t x = 0; x < span.count; ++x) {
        visit(span.column + x, span.line,
              load.wraps ? std::numeric_limits<double>::quiet_NaN()
                         : std::ldexp(static_cast<double>(word & low_mask(bits)),
                                      -static_cast<int>(parameters_.depth_fraction_bits)));
        word += span.di[span_unit::kDepthSet];
      }
    }
    return geometry::faces_viewer(area) ? 1 : -1;
  }

  const SnapGrids& grids() const override { return grids_; }
  const WordFormat& depth_format() const override { return format_; }

  double plane_bound(const SnappedPlane& plane, std::int64_t x, std::int64_t y) const override {
    const auto [left, right] = std::minmax({plane.corners()[0].x, plane.corners()[1].x, plane.corners()[2].x});
    const auto [top, bottom] = std::minmax({plane.corners()[0].y, plane.corners()[1].y, plane.corners()[2].y});
    const int bits = plane.fraction_bits();
    const double first = std::max(0.0, std::floor(std::ldexp(static_cast<double>(top), -bits)));
    const double lines = static_cast<double>(y) - first;
    const double pixels = static_cast<double>(x) - std::floor(std::ldexp(static_cast<double>(left), -bits));
    const double width = std::ldexp(static_cast<double>(right - left), -bits) + 1;
    const double height = std::ldexp(static_cast<double>(bottom - top), -bits) + 1;
    // Lines, a carry each, and pixels.
    const auto steps = static_cast<std::uint64_t>(2 * lines + pixels);
    const double words = span_unit::linear_fraction_bound(parameters_.depth_fraction_bits, steps + 1);
    // The start, so many steps of a line as long as the triangle is wide, so many pixels.
    const double rounding = plane.rounding(2 * width + 2 * lines + pixels, height + lines);
    if (parameters_.start_edge == span_unit::StartEdge::lattice) return words + rounding;
    return words + rounding + std::ldexp(plane.steep_x(), -static_cast<int>(parameters_.prestep_bits)) +
           std::ldexp(2 + pixels, -static_cast<int>(parameters_.depth_fraction_bits));
  }

 private:
  static span_unit::SpanUnitParameters right(span_unit::SpanUnitParameters parameters) {
    if (parameters.start_edge == span_unit::StartEdge::published) parameters.start_edge = span_unit::StartEdge::lattice;
    return parameters;
  }

  span_unit::SpanUnitParameters parameters_;
  WordFormat format_;
  SnapGrids grids_;
  const Tampering& tampering_;
  span_unit::SpanUnit unit_;
};

}  // namespace

SnappedPlane::SnappedPlane(const std::array<SnappedPoint, 3>& corners, int fraction_bits,
                           const std::array<double, 3>& values)
    : corners_(corners), fraction_bits_(fraction_bits), values_(values) {
  const auto& [a, b, c] = corners;
  const Quad one = static_cast<Quad>(std::int64_t{1} << fraction_bits);
  const Quad e1x = static_cast<Quad>(b.x - a.x) / one, e1y = static_cast<Quad>(b.y - a.y) / one;
  const Quad e2x = static_cast<Quad>(c.x - a.x) / one, e2y = static_cast<Quad>(c.y - a.y) / one;
  const Quad area = e1x * e2y - e2x * e1y;
  const Quad d1 = static_cast<Quad>(values[1]) - values[0], d2 = static_cast<Quad>(values[2]) - values[0];
  slope_x_ = static_cast<Extended>((d1 * e2y - d2 * e1y) / area);
  slope_y_ = static_cast<Extended>((d2 * e1x - d1 * e2x) / area);
  steep_x_ = to_double((absolute(d1 * e2y) + absolute(d2 * e1y)) / absolute(area));
  steep_y_ = to_double((absolute(d2 * e1x) + absolute(d1 * e2x)) / absolute(area));
  largest_ = std::max({std::fabs(values[0]), std::fabs(values[1]), std::fabs(values[2])});
}

Extended SnappedPlane::at(std::int64_t x, std::int64_t y) const {
  const std::int64_t dx = (x << fraction_bits_) - corners_[0].x, dy = (y << fraction_bits_) - corners_[0].y;
  const Extended unit = 1 / static_cast<Extended>(std::int64_t{1} << fraction_bits_);
  return values_[0] + slope_x_ * (static_cast<Extended>(dx) * unit) + slope_y_ * (static_cast<Extended>(dy) * unit);
}

double SnappedPlane::rounding(double dx, double dy) const {
  constexpr double kGamma = 11 * kHalfPlace / (1 - 11 * kHalfPlace);  // one for at()
  return kGamma * (largest_ + steep_x_ * dx + steep_y_ * dy) * (1 + 1e-9);
}

SnappedPlane depth_plane(const ScreenTriangle<double>& corners, int fraction_bits, const WordFormat& format) {
  const auto nearest = static_cast<double>(set_up::near_depth(format));
  const double range = static_cast<double>(set_up::far_depth(format)) - nearest;
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < 3; ++i) values[i] = std::clamp(corners[i].z, 0.0, 1.0) * range + nearest;
  return {snapped(corners, fraction_bits), fraction_bits, values};
}

double TriangleScreen::displacement(const ScreenTriangle<double>& /*corners*/, const SnapGrid& grid) const {
  return std::ldexp(std::sqrt(0.5), -grid.fraction_bits) * (1 + 1e-9);
}

const char* coverage_step(const run::Inputs::Content& machine) {
  return std::holds_alternative<imogene::Machine>(machine.machine) ? "object_processor.edges" : "set_up.snap_bits";
}

std::unique_ptr<TriangleScreen> TriangleScreen::of(const Trial& trial) {
  if (const imogene::Machine* machine = trial.object_machine())
    return std::make_unique<ObjectScreen>(*machine, trial.tampering);
  if (const quadratic::Machine* machine = trial.span_machine())
    return std::make_unique<SpanScreen>(*machine, trial.tampering);
  return nullptr;
}

}  // namespace rastertlm::analysis
