#include "modules/set_up/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rastertlm::set_up {

using parameter::About;
using parameter::Condition;

namespace {

const Condition kQuadratics{"set_up.method", {"quadratic", "quadratic_adaptive"}};
const Condition kAdaptive{"set_up.method", {"quadratic_adaptive"}};
const Condition kPseudoPhong{"set_up.method", {"pseudo_phong"}};

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  names.reserve(kShadingMethods.size());
  for (const ShadingMethodTraits& traits : kShadingMethods) names.emplace_back(traits.name);
  return names;
}

}  // namespace

void SetUpParameters::declare(parameter::Table& table) {
  const std::string picture = "the picture";
  const std::string host = "the picture, budgets host, units[] set-up processor";
  table.choice("set_up.method", method, method_names(), About{"", "Shading method.", host});
  table.choice("set_up.solver", solver, {"barycentric", "published", "published_swapped"},
               About{"", "Formulas of the quadratic's coefficients.", host, kQuadratics});
  table.choice("set_up.arithmetic", arithmetic, {"double", "float", "fixed"},
               About{"", "Numbers that coefficients are solved in.", picture});
  table.integer("set_up.fixed_fraction_bits", fixed_fraction_bits, {16, 48},
                About{"bits", "Fraction bits of the fixed-point numbers, of 64.", picture,
                      Condition{"set_up.arithmetic", {"fixed"}}});
  table.choice("set_up.attributes", attributes, {"linear", "perspective"},
               About{"", "What lights see of a point between corners: linear on the screen, or of the surface.", host});
  table.boolean("set_up.clamp_knots", clamp_knots,
                About{"", "Colours at points are clamped to the levels before they are interpolated.", picture});
  table.integer("set_up.snap_bits", snap_bits, {0, 8},
                About{"bits", "Fraction bits of the grid that corners are moved to.", picture});
  table.real("highlight_test.threshold_levels", test_threshold_levels, {0.0, 255.0},
             About{"levels", "A triangle is split where the quadratic is off by more.", host, kAdaptive});
  table.choice(
      "highlight_test.points", test_points, {"centroid", "points"},
      About{"", "Where the quadratic is compared with the light: the centre, or three more points.", host, kAdaptive});
  table.integer("highlight_test.depth_limit", test_depth_limit, {0, 6},
                About{"levels", "How often a triangle may be split.", host, kAdaptive});
  table.choice("subdivision.coverage", child_coverage, {"parent", "snapped"},
               About{"", "Corners of children: exact midpoints, or moved to the grid, which may leave cracks.", picture,
                     kAdaptive});
  table.integer("pseudo_phong.depth", halvings, {0, 6},
                About{"halvings", "Of every edge: 4^depth Gouraud triangles a triangle.", host, kPseudoPhong});
}

void SetUpParameters::check(const std::string& file, Diagnostics& diagnostics) const {
  const auto& traits = kShadingMethods.at(static_cast<std::size_t>(method));
  if (traits.platform.find("quadratic") == std::string_view::npos)
    diagnostics.add({file, 0, "set_up.method",
                     fmt::format("this platform has no {}, which is offered by: {}; accepted: gouraud, quadratic, "
                                 "quadratic_adaptive, pseudo_phong",
                                 traits.name, traits.platform)});
  const auto& known = fixed_formats();
  if (std::find(known.begin(), known.end(), fixed_fraction_bits) == known.end())
    diagnostics.add({file, 0, "set_up.fixed_fraction_bits", fmt::format("accepted: {}", fmt::join(known, ", "))});
}

int SetUpParameters::corner_bits() const {
  // Highlight subdivision puts corners at 64ths of an edge, light after light: as fine as products in 64 bits allow.
  constexpr std::int64_t kFinest = 16;
  switch (method) {
    case ShadingMethod::quadratic_adaptive:
      return static_cast<int>(snap_bits + test_depth_limit);
    case ShadingMethod::regular_subdivision:
      return static_cast<int>(snap_bits + depth_limit);
    case ShadingMethod::highlight_subdivision:
      return static_cast<int>(kFinest);
    case ShadingMethod::pseudo_phong:
      return static_cast<int>(snap_bits + halvings);
    default:
      return static_cast<int>(snap_bits);
  }
}

const std::vector<std::int64_t>& fixed_formats() {
  static const std::vector<std::int64_t> formats{16, 24, 32, 40, 48};
  return formats;
}

}  // namespace rastertlm::set_up
