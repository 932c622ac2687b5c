// Which of several triangles a machine's own cores show at a pixel.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "src/analysis/case_kind.h"
#include "src/analysis/triangle_screen.h"

namespace rastertlm::analysis {

// The index of the triangle that is seen.
using VisitSeen = std::function<void(std::int64_t x, std::int64_t y, std::size_t seen)>;

class OrderScreen {
 public:
  // Of the trial's machine, which must outlive it.
  static std::unique_ptr<OrderScreen> of(Trial& trial);
  virtual ~OrderScreen() = default;

  // Triangles in the order of their numbers, which decides where depths are equal; at most 8. Drawn on the grid, as
  // TriangleScreen does. Visits every pixel that is covered, once for each way in which the machine may compare.
  virtual void show(const std::vector<set_up::ScreenTriangle<double>>& triangles, const geometry::SnapGrid& grid,
                    const VisitSeen& visit) = 0;
  // Units by which depths may differ that are compared as equal, beside their own errors.
  virtual double fraction() const = 0;
};

}  // namespace rastertlm::analysis
