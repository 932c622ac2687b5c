// From a solid in eye space to the words of a quadric processor: what the modelled host computes for every solid and
// frame. T is double, or geometry::Counted<double> to count the operations; the words are the same.
//
// Units. The discriminant is in square units of depth, times 4^scale: 2^depth_fraction_bits depth words are a unit. Its
// root, times 2^-scale, is in units of depth.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>

#include "modules/quadric_processor/parameters.h"
#include "modules/quadric_processor/quadric_words.h"
#include "modules/set_up/anchored_words.h"
#include "modules/set_up/word_format.h"

namespace rastertlm::set_up {

struct QuadricFormat {
  quadric_processor::QuadricParameters parameters;
  WordFormat words;  // of the triangles: depth and normal words, the screen

  int depth_fraction_bits() const {
    return quadric_processor::depth_fraction_bits(words.word_bits, words.columns, words.lines);
  }
};

enum class QuadricOutcome {
  drawn,
  outside,  // nothing of it is on the screen between near and far; its processor is parked
  refused,  // the machine's words cannot show it; its processor is parked
};

struct QuadricProblem {
  std::string key;         // of the parameter that is too small; empty: none would help
  std::string message;     // one sentence
  std::int64_t width = 0;  // that would do; 0: there is none
};

struct QuadricSetUp {
  QuadricOutcome outcome = QuadricOutcome::outside;
  quadric_processor::QuadricWords words;  // parked unless drawn
  QuadricProblem problem;                 // of a refusal
  int scale = 0;
  Anchor anchor;  // rounding acts over the distance from it (anchored_words.h)
};

// `quadric` is symmetric, in eye space, as `planes`, of which dot(plane, (x, y, z, 1)) <= 0 remains; `screen_to_eye`
// the inverse of geometry::eye_to_screen. `material` 0..255.
//
// What is near to zero. a is the quadric at the point that every ray passes (at infinity in parallel projection), and
// rays go along rulings where it is 0. The matrix has come through products whose rounding errors are some 2^-52 of
// what they add; a counts as 0 below 2^-44 of the largest that the products can have on the screen, and so does L.
// Rays along rulings with a = 0 and L = 0 (a cylinder's axis in parallel projection; the tip of a cone at the eye) show
// the solid as its silhouette; with a = 0 alone there is no root to take, and it is refused.
template <class T>
QuadricSetUp set_up_quadric(const glm::dmat4& quadric, std::span<const glm::dvec4> planes, std::uint32_t material,
                            const glm::dmat4& screen_to_eye, const QuadricFormat& format);

}  // namespace rastertlm::set_up
