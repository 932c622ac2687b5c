// A hard case: an input that breaks machines, and what is known about how far a step may be off on it. The files of
// configs/hard_cases, where the derivation of each bound stands; the bounds themselves are computed from the machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/parameter/table.h"

namespace rastertlm::analysis {

// Which core is stressed: the registers of the span unit on their longest path; the same from line to line along a
// triangle's start edge; the solver of the six colours; the pixels that a mesh covers; the adders of EP1.
enum class CaseKind { forward_differences, start_edge, quadratic_solver, coverage, linear_form };
// Well shaped; with the edge from corner 1 to corner 2 level, or almost; thin.
enum class TriangleFamily { well_shaped, level, near_level, sliver };
enum class CaseMesh { sphere, fan, lattice };

struct HardCase {
  std::string name;  // the file's, without folder and ending
  std::int64_t schema = 1;
  std::string stresses;
  CaseKind kind = CaseKind::forward_differences;
  std::int64_t tries = 100;  // random inputs
  std::int64_t steps = 2048;
  std::int64_t bits_from = 8;
  std::int64_t bits_to = 24;
  double limit_levels = 1.0;
  TriangleFamily family = TriangleFamily::well_shaped;
  double size_pixels = 300.0;
  double aspect = 1.0;
  double height_pixels = 1.0;
  CaseMesh mesh = CaseMesh::sphere;
  std::int64_t slices = 12;
  std::int64_t stacks = 8;
  std::int64_t triangles = 1000;

  void declare(parameter::Table& table);
};

// Throws InputError with everything that is wrong in the file.
HardCase read_hard_case(const std::string& file);
// All cases of a folder, by name. Throws InputError where there is none, or with what is wrong in any.
std::vector<HardCase> read_hard_cases(const std::string& folder);

}  // namespace rastertlm::analysis
