// The shading methods that machines offer, by name, and what tells them apart.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rastertlm {

enum class ShadingMethod {
  gouraud,
  quadratic,
  quadratic_adaptive,
  regular_subdivision,
  highlight_subdivision,
  gouraud_phong,
  phong,
  deferred_phong,
  duff,
  taylor,
  angular,
  pseudo_phong,
};

struct ShadingMethodTraits {
  ShadingMethod method;
  std::string_view name;      // as in files
  std::string_view across;    // what is computed at a pixel inside a triangle
  std::string_view lit_at;    // where the illumination equation is evaluated
  bool highlight_test;        // triangles are told apart by a test for highlights
  bool subdivides;            // more triangles are made where there is a highlight
  std::string_view platform;  // that offers it, or several: "imogene", "quadratic", "adaptive"; "reference": no
                              // machine, a picture to compare with
  std::string_view source;    // paper
};

inline constexpr std::array<ShadingMethodTraits, 12> kShadingMethods{{
    {ShadingMethod::gouraud, "gouraud", "colour, linear", "3 vertices", false, false, "quadratic, adaptive", "000/001"},
    {ShadingMethod::quadratic, "quadratic", "colour, quadratic", "3 vertices and 3 edge midpoints", false, false,
     "quadratic", "000/001"},
    {ShadingMethod::quadratic_adaptive, "quadratic_adaptive", "colour, quadratic where a highlight is, else linear",
     "6 or 3 points", true, false, "quadratic", "000/001"},
    {ShadingMethod::regular_subdivision, "regular_subdivision", "colour, linear in each part",
     "vertices of the parts, cut regularly", true, true, "adaptive", "003, section 3.2"},
    {ShadingMethod::highlight_subdivision, "highlight_subdivision", "colour, linear in each part",
     "vertices of the parts, cut at the highlight", true, true, "adaptive", "003, section 3.1"},
    {ShadingMethod::gouraud_phong, "gouraud_phong", "normal where a highlight is, else colour, linear",
     "every pixel of triangles with a highlight, else 3 vertices", true, false, "adaptive", "003, section 3.3"},
    {ShadingMethod::phong, "phong", "normal, linear", "every pixel", false, false, "adaptive", "003"},
    {ShadingMethod::deferred_phong, "deferred_phong", "normal, linear, lit by tables after the nearest is known",
     "every pixel, once", false, false, "imogene", "004, section 5"},
    {ShadingMethod::duff, "duff", "dot products, linear over the normal's length", "every pixel", false, false,
     "adaptive", "Duff 1979"},
    {ShadingMethod::taylor, "taylor", "dot products, quadratic about the triangle's centre", "every pixel", false,
     false, "adaptive", "Bishop and Weimer 1986"},
    {ShadingMethod::angular, "angular", "angle of the normal, linear along edges and lines", "every pixel", false,
     false, "adaptive", "Kuijk and Blake 1989"},
    {ShadingMethod::pseudo_phong, "pseudo_phong", "colour, linear in each of 4^k parts",
     "corners of the parts, from edges halved k times", false, false, "quadratic, adaptive", "000/001, section 2"},
}};

constexpr const ShadingMethodTraits& traits_of(ShadingMethod method) {
  return kShadingMethods.at(static_cast<std::size_t>(method));
}

// The lighting equation is solved at every pixel of every triangle, from what is interpolated: a pixel unit's.
constexpr bool shades_pixels(ShadingMethod method) {
  return method == ShadingMethod::phong || method == ShadingMethod::duff || method == ShadingMethod::taylor ||
         method == ShadingMethod::angular;
}

// Null where no method has the name.
constexpr const ShadingMethodTraits* find_shading_method(std::string_view name) {
  for (const ShadingMethodTraits& traits : kShadingMethods)
    if (traits.name == name) return &traits;
  return nullptr;
}

}  // namespace rastertlm
