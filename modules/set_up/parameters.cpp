#include "modules/set_up/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rastertlm::set_up {

using parameter::About;
using parameter::Condition;

namespace {

const std::string kPicture = "the picture";
const std::string kHost = "the picture, budgets host, units[] set-up processor";
const Condition kQuadratics{"set_up.method", {"quadratic", "quadratic_adaptive"}};
const Condition kAdaptive{"set_up.method", {"quadratic_adaptive"}};
const Condition kPseudoPhong{"set_up.method", {"pseudo_phong"}};
const Condition kClassified{"set_up.method", {"regular_subdivision", "gouraud_phong"}};
const Condition kCentred{"set_up.method", {"highlight_subdivision"}};
const Condition kRegular{"set_up.method", {"regular_subdivision"}};
const Condition kDivided{"set_up.method", {"regular_subdivision", "highlight_subdivision"}};

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  names.reserve(kShadingMethods.size());
  for (const ShadingMethodTraits& traits : kShadingMethods) names.emplace_back(traits.name);
  return names;
}

}  // namespace

void SetUpParameters::declare(parameter::Table& table) {
  declare_common(table);
  table.choice("set_up.solver", solver, {"barycentric", "published", "published_swapped"},
               About{"", "Formulas of the quadratic's coefficients.", kHost, kQuadratics});
  table.choice("set_up.arithmetic", arithmetic, {"double", "float", "fixed"},
               About{"", "Numbers that coefficients are solved in.", kPicture});
  table.integer("set_up.fixed_fraction_bits", fixed_fraction_bits, {16, 48},
                About{"bits", "Fraction bits of the fixed-point numbers, of 64.", kPicture,
                      Condition{"set_up.arithmetic", {"fixed"}}});
  table.real("highlight_test.threshold_levels", test_threshold_levels, {0.0, 255.0},
             About{"levels", "A triangle is split where the quadratic is off by more; not where h1h2 decides.", kHost,
                   kAdaptive});
  table.choice("highlight_test.points", test_points, {"centroid", "points", "h1h2"},
               About{"",
                     "Where the quadratic is compared with the light: the centre, or three more points; or, h1h2, "
                     "triangles are split whose corners say that they may hold a highlight's centre.",
                     kHost, kAdaptive});
  table.integer("highlight_test.depth_limit", test_depth_limit, {0, 6},
                About{"levels", "How often a triangle may be split.", kHost, kAdaptive});
  table.choice("subdivision.coverage", child_coverage, {"parent", "snapped"},
               About{"", "Corners of children: exact midpoints, or moved to the grid, which may leave cracks.",
                     kPicture, kAdaptive});
}

void SetUpParameters::declare_common(parameter::Table& table) {
  table.choice("set_up.method", method, method_names(), About{"", "Shading method.", kHost});
  table.choice(
      "set_up.attributes", attributes, {"linear", "perspective"},
      About{"", "What lights see of a point between corners: linear on the screen, or of the surface.", kHost});
  table.boolean("set_up.clamp_knots", clamp_knots,
                About{"", "Colours at points are clamped to the levels before they are interpolated.", kPicture});
  table.integer("set_up.snap_bits", snap_bits, {0, 8},
                About{"bits", "Fraction bits of the grid that corners are moved to.", kPicture});
  table.integer("pseudo_phong.depth", halvings, {0, 6},
                About{"halvings", "Of every edge: 4^depth Gouraud triangles a triangle.", kHost, kPseudoPhong});
}

void SetUpParameters::declare_adaptive(parameter::Table& table) {
  declare_common(table);
  table.choice("set_up.vertices", vertices, {"corners", "shared"},
               About{"", "What is placed and lit once a frame: each triangle's corners, or the mesh's vertices.",
                     "budgets host, budgets software, units[] set-up processor"});
  table.integer("highlight_test.rings", rings, {0, 16},
                About{"rings", "Neighbours of triangles that may hold a highlight are treated alike, so often over.",
                      kHost, kClassified});
  table.integer("highlight_test.refinements", refinements, {0, 16},
                About{"", "How often the highlight's centre is looked for in turns of H1 and H2.", kHost, kCentred});
  table.real("subdivision.area_pixels", area_pixels, {0.25, 1e6},
             About{"pixels", "Triangles are cut in four until they are smaller on the screen.", kHost, kRegular});
  table.real(
      "subdivision.intensity_error", intensity_error, {0.001, 100.0},
      About{"", "Relative error of light in the middle of an edge above which it is cut there.", kHost, kCentred});
  table.integer("subdivision.depth_limit", depth_limit, {0, 6},
                About{"levels", "How often a triangle, or an edge, may be cut.", kHost, kDivided});
  table.boolean("subdivision.stitch", stitch,
                About{"", "Triangles get the corners that those beside them have on common edges: no step of colour.",
                      kHost, kDivided});
}

void SetUpParameters::check_method(const std::string& platform, const std::string& file,
                                   Diagnostics& diagnostics) const {
  const auto offers = [&](const ShadingMethodTraits& traits) {
    return traits.platform.find(platform) != std::string_view::npos;
  };
  const auto& traits = kShadingMethods.at(static_cast<std::size_t>(method));
  if (offers(traits)) return;
  std::vector<std::string_view> names;
  for (const ShadingMethodTraits& other : kShadingMethods)
    if (offers(other)) names.push_back(other.name);
  diagnostics.add({file, 0, "set_up.method",
                   fmt::format("this platform has no {}, which is offered by: {}; accepted: {}", traits.name,
                               traits.platform, fmt::join(names, ", "))});
}

void SetUpParameters::check(const std::string& file, Diagnostics& diagnostics) const {
  check_method("quadratic", file, diagnostics);
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
