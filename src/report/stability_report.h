// What was found on hard cases, as a reader and as a program sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rastertlm::report {

enum class BoundKind { proved, required };

// The input of all that were tried which came nearest to its bound, or went furthest beyond it.
struct Measurement {
  std::string what;
  std::string unit;
  double measured = 0.0;  // infinite where a step has no result
  double bound = 0.0;
  BoundKind kind = BoundKind::proved;
  std::int64_t inputs = 0;  // on which this bound was checked: random ones, or 1, a mesh
  bool holds() const { return measured <= bound; }
};

struct Finding {
  std::string name;      // the case's
  std::string kind;      // likewise
  std::string stresses;  // as the case says
  std::string step;      // the parameter of the machine that decides: "span_unit.start_edge"
  std::vector<Measurement> measurements;
  std::vector<std::string> notes;  // what a reader must know beside the figures: a sentence each
  std::int64_t inputs = 0;         // different ones, over all bounds
  bool random = false;             // they were drawn
  bool holds() const;
};

struct MachineFindings {
  std::string file;  // the machine's
  std::vector<Finding> findings;
};

struct StabilityReport {
  std::uint64_t seed = 1;
  std::vector<MachineFindings> machines;

  std::size_t bounds() const;
  std::int64_t inputs() const;              // of all machines and cases
  std::vector<std::string> broken() const;  // "<machine>: <case>: <step>" of each case with a bound that does not hold
};

// A table a case.
std::string findings_text(const MachineFindings& machine, std::uint64_t seed);
// How many bounds and inputs, the bound that was drawn for least often, the one that was come nearest to, and which are
// broken.
std::string verdict_text(const StabilityReport& report);
// Schema 1: {"schema", "program", "kind": "stability", "seed", "bounds", "inputs", "broken": [...], "machines":
// [{"machine", "cases": [{"case", "kind", "stresses", "step", "holds", "notes", "measurements": [{"input", "unit",
// "measured", "bound", "bound_kind", "inputs", "holds"}]}]}]}. A step without a result is null, and so is a bound that
// says nothing.
std::string stability_json(const StabilityReport& report);

}  // namespace rastertlm::report
