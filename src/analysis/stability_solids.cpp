// Outline, depth and normal of solids, at pixels of quadric processors' words: beside the quadric in eye space, its
// forms in 113 bits. The bounds of the words: modules/set_up/solid_bounds.h.
//
// What the host's doubles add (set_up::HostRounding): its forms are computed once more with numbers that carry their
// error (traced.h), u = 2^-53. A coefficient that is off by e moves the form by e times its monomial, at most that at
// the screen's far corner. Words are made of the form at the anchor, its slopes there and its curvatures: sums of
// products of at most 5 rounded operations each, three more of the scale, a slope's monomials counted twice: 25 u of
// each coefficient times its monomial there. The exact coefficients are rounded to double for the pixels, and their
// sums are of at most 5 operations: 8 u more. 48 u in all.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/set_up/quadric_set_up.h"
#include "modules/set_up/screen_box.h"
#include "modules/set_up/solid_bounds.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/random_solids.h"
#include "src/analysis/traced.h"

namespace rastertlm::analysis {
namespace {

using quadric_processor::QuadricPixel;
using quadric_processor::QuadricWords;
using quadric_processor::RayPart;
using quadric_processor::Surface;
using set_up::QuadricOutcome;
using set_up::QuadricSetUp;

constexpr double kOfCoefficients = 48 * 0x1p-53;

double rounded(const Traced& value) { return to_double(value.exact()); }
double off_of(const Traced& coefficient, double monomial) {
  return (coefficient.bound() + kOfCoefficients * std::fabs(coefficient.value())) * monomial;
}

// Exact coefficients, and by how much the host's forms may be off from them on the screen.
class TracedForms {
 public:
  TracedForms(const EyeQuadric& solid, const SolidView& view, double range) {
    const auto columns = static_cast<double>(view.viewport.columns), lines = static_cast<double>(view.viewport.lines);
    const auto traced = geometry::screen_quadric<Traced>(solid.quadric, view.screen_to_eye);
    const auto linear = [](const geometry::LinearForm<Traced>& f) {
      return geometry::LinearForm<double>{rounded(f.x), rounded(f.y), rounded(f.one)};
    };
    const auto linear_off = [&](const geometry::LinearForm<Traced>& f) {
      return off_of(f.x, columns) + off_of(f.y, lines) + off_of(f.one, 1);
    };
    const auto& d = traced.discriminant;
    form.a = rounded(traced.a);
    form.middle = linear(traced.middle);
    form.discriminant = {rounded(d.xx), rounded(d.yy), rounded(d.xy), rounded(d.x), rounded(d.y), rounded(d.one)};
    host.middle = range * linear_off(traced.middle);
    host.discriminant = range * range *
                        (off_of(d.xx, columns * columns) + off_of(d.yy, lines * lines) + off_of(d.xy, columns * lines) +
                         off_of(d.x, columns) + off_of(d.y, lines) + off_of(d.one, 1));
    for (std::size_t i = 0; i < 3; ++i) {
      form.normal[i] = linear(traced.normal[i]);
      form.normal_of_root[i] = rounded(traced.normal_of_root[i]);
      // k s: in depths from near to far.
      normal = std::hypot(normal, linear_off(traced.normal[i]) + off_of(traced.normal_of_root[i], 1));
    }
    for (const glm::dvec4& plane : solid.planes) {
      const auto cut = geometry::screen_plane<Traced>(plane, view.screen_to_eye);
      planes.push_back({static_cast<geometry::ScreenPlane<double>::Keeps>(cut.keeps), linear(cut.depth)});
      host.planes.push_back(range * linear_off(cut.depth));
    }
  }

  geometry::ScreenQuadric<double> form;
  std::vector<geometry::ScreenPlane<double>> planes;
  set_up::HostRounding host;
  double normal = 0.0;  // the length by which the host's vector may be off, a root of 1
};

glm::dvec3 vector_of(const std::array<std::uint32_t, 3>& words, unsigned bits) {
  glm::dvec3 vector;
  for (int i = 0; i < 3; ++i) vector[i] = static_cast<double>(sign_extend(words[static_cast<std::size_t>(i)], bits));
  return vector;
}

class SolidBench {
 public:
  SolidBench(const imogene::Machine& machine, Trial& trial)
      : format_{machine.quadric,
                {static_cast<int>(machine.object_processor.word_bits), static_cast<std::size_t>(machine.video.columns),
                 static_cast<std::size_t>(machine.video.lines), machine.object_processor.edges}},
        bits_(static_cast<unsigned>(format_.words.word_bits)),
        near_(set_up::near_depth(format_.words)),
        far_(set_up::far_depth(format_.words)),
        logic_(format_.parameters, bits_, {near_, far_}),
        unit_(std::ldexp(1.0, format_.depth_fraction_bits())),
        trial_(trial) {}

  void try_solid(const SolidFamily& family) {
    Numbers& numbers = trial_.numbers;
    const SolidView view = solid_view(numbers.whole(0, 1) == 0, {format_.words.columns, format_.words.lines});
    const SolidFamily::Drawn drawn = family.draw(view, numbers);
    const EyeQuadric solid = drawn.at(family.near_wrap() ? largest_size(drawn, view) : 1.0);
    QuadricSetUp result = words_of(solid, view);
    if (result.outcome == QuadricOutcome::refused) ++refused;
    if (result.outcome == QuadricOutcome::outside) ++outside;
    if (result.outcome != QuadricOutcome::drawn) return;
    if (result.words.part == RayPart::all) return void(++rulings);
    if (trial_.tampering.quadric_words) trial_.tampering.quadric_words(result.words);
    ++solids;
    TracedForms forms(solid, view, static_cast<double>(far_ - near_));
    const double normal_off = forms.normal;
    const auto ellipse = set_up::ellipse_of(forms.form.discriminant);
    const set_up::PixelBox screen = set_up::whole_screen(format_.words.columns, format_.words.lines);
    const set_up::PixelBox box = forms.form.a > 0 && ellipse ? outline_box(*ellipse, screen) : screen;
    const set_up::SolidBounds bounds(forms.form, forms.planes, format_, result, forms.host);
    const auto normal_length = [&](Surface surface, double x, double y) {
      return glm::length(geometry::quadric_normal(forms.form,
                                                  surface == Surface::far_root
                                                      ? geometry::QuadricHit::Surface::far_root
                                                      : geometry::QuadricHit::Surface::near_root,
                                                  x, y));
    };
    const auto look = [&](std::int64_t x, std::int64_t y) {
      const QuadricPixel pixel = look_at(bounds, result.words, x, y);
      if (!pixel.covered || !real_) return;
      if (pixel.surface != Surface::near_root && pixel.surface != Surface::far_root) return;
      const auto column = static_cast<double>(x), line = static_cast<double>(y);
      look_at_normal(bounds, pixel, column, line, normal_off / normal_length(pixel.surface, column, line));
    };
    // About 4000 pixels where it may be, and as many on the whole screen: of words that wrap.
    for (const set_up::PixelBox& part : {box, screen}) scan(part, look);
  }

  Measurement missing{"", "pixels", 0.0, 0.0, BoundKind::proved};
  Measurement extra{"covered though beside the solid by more than rounding", "pixels", 0.0, 0.0, BoundKind::proved};
  Measurement elsewhere{"deeper or nearer than the solid by more than rounding", "pixels", 0.0, 0.0, BoundKind::proved};
  Measurement depth{"depth of the surface that is shown", "units", 0.0, 0.0, BoundKind::proved};
  Measurement normal{"normal of a root", "degrees", 0.0, 0.0, BoundKind::proved};
  std::int64_t solids = 0, refused = 0, outside = 0, rulings = 0, covered = 0, near_outline = 0;

 private:
  QuadricSetUp words_of(const EyeQuadric& solid, const SolidView& view) const {
    return set_up::set_up_quadric<double>(solid.quadric, solid.planes, 0, view.screen_to_eye, format_);
  }

  // The largest that is drawn at the scale of size 1, next to where a word, or the root, would not hold it.
  double largest_size(const SolidFamily::Drawn& drawn, const SolidView& view) const {
    constexpr int kHalvings = 40;
    const QuadricSetUp first = words_of(drawn.at(1.0), view);
    double same = 1.0, other = 4.0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (same + other) / 2;
      const QuadricSetUp there = words_of(drawn.at(middle), view);
      (there.outcome == first.outcome && there.scale == first.scale ? same : other) = middle;
    }
    return same;
  }

  static set_up::PixelBox outline_box(const set_up::Ellipse<double>& ellipse, const set_up::PixelBox& screen) {
    set_up::PixelBox box = ellipse.box(0.0, screen);
    if (box.empty()) return screen;
    constexpr std::int64_t kBeside = 2;
    return set_up::common_box<double>(
        {box.left - kBeside, box.right + kBeside, box.top - kBeside, box.bottom + kBeside}, screen);
  }

  template <class Look>
  void scan(const set_up::PixelBox& box, const Look& look) {
    constexpr double kPixels = 4000;
    const auto pixels = static_cast<double>(box.right - box.left + 1) * static_cast<double>(box.bottom - box.top + 1);
    const auto step = static_cast<std::int64_t>(std::ceil(std::sqrt(std::max(1.0, pixels / kPixels))));
    const std::int64_t right = trial_.numbers.whole(0, step - 1), down = trial_.numbers.whole(0, step - 1);
    for (std::int64_t y = box.top + down; y <= box.bottom; y += step)
      for (std::int64_t x = box.left + right; x <= box.right; x += step) look(x, y);
  }

  QuadricPixel look_at(const set_up::SolidBounds& bounds, const QuadricWords& words, std::int64_t column,
                       std::int64_t line) {
    const auto x = static_cast<double>(column), y = static_cast<double>(line);
    const QuadricPixel pixel =
        logic_(words, quadric_processor::pixel_words(words, static_cast<std::uint32_t>(column),
                                                     static_cast<std::uint32_t>(line), format_.parameters, bits_));
    const auto grown = bounds.first(x, y, 1.0), shrunk = bounds.first(x, y, -1.0);
    real_ = bounds.first(x, y, 0.0);
    near_outline += grown.has_value() != shrunk.has_value() ? 1 : 0;
    missing.measured += shrunk && !pixel.covered ? 1 : 0;
    extra.measured += pixel.covered && !grown ? 1 : 0;
    if (!pixel.covered || !grown) return pixel;
    ++covered;
    // A depth that is read is a whole word: one more on either side.
    const auto shown = static_cast<double>(pixel.depth);
    elsewhere.measured += shown < *grown - 1 || (shrunk && shown > *shrunk + 1) ? 1 : 0;
    const auto exact = bounds.surface_depth(pixel, x, y);
    keep_worst(depth, std::fabs(shown - exact.depth) / unit_, exact.error / unit_);
    return pixel;
  }

  // `host`: what its doubles are off, of the normal's length.
  void look_at_normal(const set_up::SolidBounds& bounds, const QuadricPixel& pixel, double x, double y, double host) {
    const glm::dvec3 shown = vector_of(pixel.normal, bits_);
    const double length = glm::length(shown), off = bounds.normal_error(x, y);
    // |exact| is at most |shown| and what is off, in the words' unit.
    const double all = off + host * (length + off);
    if (!(all < length)) return;  // any direction
    const glm::dvec3 exact = bounds.normal(pixel.surface, x, y);
    const double apart = std::atan2(glm::length(glm::cross(shown, exact)), glm::dot(shown, exact));
    constexpr double kDegrees = 180 / std::numbers::pi;
    // What a cross product of doubles leaves of parallel vectors: 2^-50.
    keep_worst(normal, apart * kDegrees, (std::asin(all / length) + 0x1p-50) * kDegrees);
  }

  set_up::QuadricFormat format_;
  unsigned bits_;
  std::int64_t near_, far_;
  quadric_processor::QuadricPixelLogic logic_;
  double unit_;  // depth words
  Trial& trial_;
  std::optional<double> real_;  // the depth of the solid itself, at the pixel that was looked at
};

// Also of a machine that has none: the words are those of one with its parameters.
bool can_have_quadrics(const imogene::Machine& machine) {
  quadric_processor::QuadricParameters one = machine.quadric;
  one.per_unit = 1;
  Diagnostics diagnostics;
  one.check(machine.object_processor, diagnostics, "");
  return diagnostics.empty();
}

class SolidsCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random solids.", "the catalogue's figures"});
    family_.declare(table);
  }
  std::string step(const run::Inputs::Content& /*machine*/) const override { return "quadric_processor.word_bits"; }
  double try_us(const run::Inputs::Content& /*machine*/) const override { return 5000.0; }
  Measured measure(Trial& trial) const override {
    const imogene::Machine* machine = trial.object_machine();
    if (machine == nullptr || !can_have_quadrics(*machine)) return {};
    const std::int64_t tries = trial.tries_or(tries_);
    SolidBench bench(*machine, trial);
    for (std::int64_t round = 0; round < tries; ++round) bench.try_solid(family_);
    Measured found;
    if (bench.solids > 0) {
      bench.missing.what = fmt::format("not covered though within {} solids by more than rounding", bench.solids);
      found.measurements = {bench.missing, bench.extra, bench.elsewhere};
      if (bench.covered > 0) found.measurements.push_back(bench.depth);
      if (bench.normal.bound > 0.0) found.measurements.push_back(bench.normal);
      for (Measurement& m : found.measurements) m.inputs = bench.solids;
    }
    found.notes.push_back(fmt::format(
        "Of {} solids {} are drawn, {} not on the screen, {} refused, {} along their rulings; {} pixels covered, {} "
        "so near to an outline that they may be or not.",
        tries, bench.solids, bench.outside, bench.refused, bench.rulings, bench.covered, bench.near_outline));
    if (machine->quadric.per_unit == 0)
      found.notes.emplace_back("The machine has no quadric processor; this is one of its parameters.");
    return found;
  }

 private:
  std::int64_t tries_ = 200;
  SolidFamily family_;
};

}  // namespace

std::unique_ptr<CaseKind> solids_case() { return std::make_unique<SolidsCase>(); }

}  // namespace rastertlm::analysis
