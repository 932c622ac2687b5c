// A hard case: an input that breaks machines, and what is known about how far a step may be off on it. The files of
// configs/hard_cases, where the derivation of each bound stands; the bounds themselves are computed from the machine.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/analysis/case_kind.h"

namespace rastertlm::analysis {

struct HardCase {
  std::string name;  // the file's, without folder and ending
  std::string stresses;
  std::string kind;
  std::shared_ptr<const CaseKind> core;  // of that kind, with what the file says
};

// Throws InputError with everything that is wrong in the file.
HardCase read_hard_case(const std::string& file);
// All cases of a folder, by name. Throws InputError where there is none, or with what is wrong in any.
std::vector<HardCase> read_hard_cases(const std::string& folder);

}  // namespace rastertlm::analysis
