// Solids from their own space to eye space, and the way from the screen back to it: templates over the number type T
// (double or geometry::Counted<double>).
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"
#include "src/geometry/solid.h"

namespace rastertlm::set_up {

struct EyeSolid {
  glm::dmat4 quadric{1.0};
  std::vector<glm::dvec4> planes;
};

// Of a matrix whose last row is 0, 0, 0, 1.
template <class T>
glm::dmat4 affine_inverse(const glm::dmat4& m) {
  const auto at = [&m](int row, int column) { return T(m[column][row]); };
  std::array<std::array<T, 3>, 3> minors;  // the cofactors, transposed
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const int r1 = (column + 1) % 3, r2 = (column + 2) % 3, c1 = (row + 1) % 3, c2 = (row + 2) % 3;
      minors[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          at(r1, c1) * at(r2, c2) - at(r1, c2) * at(r2, c1);
    }
  const T factor = T(1.0) / (at(0, 0) * minors[0][0] + at(0, 1) * minors[1][0] + at(0, 2) * minors[2][0]);
  glm::dmat4 result(1.0);
  for (int row = 0; row < 3; ++row) {
    std::array<T, 3> of_row;
    for (std::size_t k = 0; k < 3; ++k) {
      of_row[k] = minors[static_cast<std::size_t>(row)][k] * factor;
      result[static_cast<int>(k)][row] = geometry::plain(of_row[k]);
    }
    result[3][row] = geometry::plain(-(of_row[0] * at(0, 3) + of_row[1] * at(1, 3) + of_row[2] * at(2, 3)));
  }
  return result;
}

// Of any matrix that has one, by the products of its halves' determinants.
template <class T>
glm::dmat4 inverse(const glm::dmat4& m) {
  const auto at = [&m](int row, int column) { return T(m[column][row]); };
  constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  std::array<T, 6> upper, lower;  // determinants of rows 0, 1 and of rows 2, 3 in two columns
  for (std::size_t i = 0; i < 6; ++i) {
    const int a = kPairs[i][0], b = kPairs[i][1];
    upper[i] = at(0, a) * at(1, b) - at(0, b) * at(1, a);
    lower[i] = at(2, a) * at(3, b) - at(2, b) * at(3, a);
  }
  const T factor = T(1.0) / (upper[0] * lower[5] - upper[1] * lower[4] + upper[2] * lower[3] + upper[3] * lower[2] -
                             upper[4] * lower[1] + upper[5] * lower[0]);
  // Where the determinant of a pair of columns stands.
  const auto of = [](const std::array<T, 6>& pairs, int a, int b) {
    constexpr int kPlace[4][4] = {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}};
    return pairs[static_cast<std::size_t>(kPlace[a][b])];
  };
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)               // of the result: without this column
    for (int column = 0; column < 4; ++column) {  // and without this row
      int others[3];
      for (int k = 0, n = 0; k < 4; ++k)
        if (k != row) others[n++] = k;
      const auto& pairs = column < 2 ? lower : upper;
      const int beside = column ^ 1;  // the row of the same half that is left
      const T sum = at(beside, others[0]) * of(pairs, others[1], others[2]) -
                    at(beside, others[1]) * of(pairs, others[0], others[2]) +
                    at(beside, others[2]) * of(pairs, others[0], others[1]);
      const T cofactor = sum * factor;
      result[column][row] = geometry::plain((row + column) % 2 == 0 ? cofactor : -cofactor);
    }
  return result;
}

// The inverse of geometry::eye_to_screen.
template <class T>
glm::dmat4 screen_to_eye(const glm::dmat4& eye_to_clip, const geometry::Viewport& viewport) {
  const glm::dmat4 to_pixels = geometry::eye_to_screen(glm::dmat4(1.0), viewport);
  glm::dmat4 to_screen = eye_to_clip;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 2; ++row)
      to_screen[column][row] = geometry::plain(T(to_pixels[row][row]) * T(eye_to_clip[column][row]) +
                                               T(to_pixels[3][row]) * T(eye_to_clip[column][3]));
  return inverse<T>(to_screen);
}

template <class T>
EyeSolid solid_in_eye_space(const geometry::Solid& solid, const glm::dmat4& object_to_eye) {
  const glm::dmat4 back = affine_inverse<T>(object_to_eye);
  // Columns of `back`; the last row of each but the last is 0.
  const auto product = [&back](const std::array<T, 4>& row, int column) {
    T sum = row[0] * T(back[column][0]);
    for (std::size_t k = 1; k < 3; ++k) sum = sum + row[k] * T(back[column][static_cast<int>(k)]);
    return column == 3 ? sum + row[3] : sum;
  };
  EyeSolid result;
  std::array<std::array<T, 4>, 4> half;  // quadric back
  for (int row = 0; row < 4; ++row) {
    const std::array<T, 4> of_row{T(solid.quadric[0][row]), T(solid.quadric[1][row]), T(solid.quadric[2][row]),
                                  T(solid.quadric[3][row])};
    for (int column = 0; column < 4; ++column)
      half[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = product(of_row, column);
  }
  for (int column = 0; column < 4; ++column) {
    const auto c = static_cast<std::size_t>(column);
    const std::array<T, 4> of_column{half[0][c], half[1][c], half[2][c], half[3][c]};
    for (int row = 0; row <= column; ++row)
      result.quadric[column][row] = result.quadric[row][column] = geometry::plain(product(of_column, row));
  }
  for (const glm::dvec4& plane : solid.planes) {
    const std::array<T, 4> row{T(plane.x), T(plane.y), T(plane.z), T(plane.w)};
    glm::dvec4 moved;
    for (int column = 0; column < 4; ++column) moved[column] = geometry::plain(product(row, column));
    result.planes.push_back(moved);
  }
  return result;
}

}  // namespace rastertlm::set_up
