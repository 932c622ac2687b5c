// LDR-FLIP: how different two pictures look to who flips between them. Andersson, Nilsson, Akenine-Möller, Oskarsson,
// Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the ACM on Computer
// Graphics and Interactive Techniques 3, 2 (2020).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rastertlm::reference {

// 0.7 m from a screen 0.7 m wide with 3840 columns gives 67.02 pixels a degree, the authors' default; ours is rounded.
inline constexpr double kDefaultPixelsPerDegree = 67.0;

// Below one pixel a degree the filters hold nothing, above a thousand they are wider than pictures.
inline constexpr double kLeastPixelsPerDegree = 1.0;
inline constexpr double kMostPixelsPerDegree = 1000.0;

// The FLIP difference of each pixel, 0 (none seen) .. 1, row by row. Pictures of columns x lines pixels, red, green and
// blue of each as sRGB display levels 0..255. Beyond its edges a picture goes on with the pixels of the edge.
// std::invalid_argument where sizes or pixels_per_degree are out of range.
std::vector<double> flip_map(std::size_t columns, std::size_t lines, std::span<const double> reference,
                             std::span<const double> test, double pixels_per_degree = kDefaultPixelsPerDegree);

}  // namespace rastertlm::reference
