#include "src/report/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;

const char* text_of(BoundKind kind) { return kind == BoundKind::proved ? "proved" : "required"; }

std::string figure(double value) { return std::isinf(value) ? "none" : fmt::format("{:.4g}", value); }

// The part of the bound that is left.
std::string margin(const Measurement& m) {
  if (std::isinf(m.bound)) return "-";
  if (m.bound == 0.0 || std::isinf(m.measured)) return m.holds() ? "exact" : "-";
  return fmt::format("{:.3g} %", 100 * (1 - m.measured / m.bound));
}

std::string text_of(const Finding& finding) {
  TextTable table({{"input", Align::left},
                   {"measured", Align::right},
                   {"bound", Align::right},
                   {"unit", Align::left},
                   {"margin", Align::right},
                   {"inputs", Align::right},
                   {"verdict", Align::left}},
                  "  ");
  for (const Measurement& m : finding.measurements)
    table.row({m.what, figure(m.measured), figure(m.bound), m.unit, margin(m),
               grouped(static_cast<std::uint64_t>(m.inputs)),
               fmt::format("{}, {}", text_of(m.kind), m.holds() ? "holds" : "BROKEN")});
  std::string text = fmt::format("{} ({}): {}\n", finding.name, finding.step, finding.stresses);
  if (!finding.measurements.empty()) text += table.text();
  for (const std::string& note : finding.notes) text += fmt::format("  {}\n", note);
  return text + '\n';
}

Json stored(double value) { return std::isfinite(value) ? Json(to_stored(value)) : Json(nullptr); }

Json json_of(const Finding& finding) {
  Json measurements = Json::array();
  for (const Measurement& m : finding.measurements)
    measurements.push_back({{"input", m.what},
                            {"unit", m.unit},
                            {"measured", stored(m.measured)},
                            {"bound", stored(m.bound)},
                            {"bound_kind", text_of(m.kind)},
                            {"inputs", m.inputs},
                            {"holds", m.holds()}});
  return {{"case", finding.name},
          {"kind", finding.kind},
          {"stresses", finding.stresses},
          {"step", finding.step},
          {"holds", finding.holds()},
          {"notes", finding.notes},
          {"measurements", std::move(measurements)}};
}

// What is least and nearest of all bounds, as sentences.
std::string extremes_text(const StabilityReport& report) {
  std::int64_t fewest = 0;
  double nearest = -1.0;
  std::string where;
  for (const MachineFindings& machine : report.machines)
    for (const Finding& finding : machine.findings)
      for (const Measurement& m : finding.measurements) {
        if (finding.random && (fewest == 0 || m.inputs < fewest)) fewest = m.inputs;
        const double part = m.measured / m.bound;
        if (!(m.bound > 0.0) || !std::isfinite(part) || part <= nearest) continue;
        nearest = part;
        where = fmt::format("{}: {}: {}", machine.file, finding.name, m.what);
      }
  std::string text;
  if (fewest > 0)
    text += fmt::format("fewest random inputs of a bound: {}\n", grouped(static_cast<std::uint64_t>(fewest)));
  if (!where.empty()) text += fmt::format("nearest to its bound: {:.4g} % ({})\n", 100 * nearest, where);
  return text;
}

}  // namespace

bool Finding::holds() const {
  return std::all_of(measurements.begin(), measurements.end(), [](const Measurement& m) { return m.holds(); });
}

std::size_t StabilityReport::bounds() const {
  std::size_t count = 0;
  for (const MachineFindings& machine : machines)
    for (const Finding& finding : machine.findings) count += finding.measurements.size();
  return count;
}

std::int64_t StabilityReport::inputs() const {
  std::int64_t count = 0;
  for (const MachineFindings& machine : machines)
    for (const Finding& finding : machine.findings) count += finding.inputs;
  return count;
}

std::vector<std::string> StabilityReport::broken() const {
  std::vector<std::string> names;
  for (const MachineFindings& machine : machines)
    for (const Finding& finding : machine.findings)
      if (!finding.holds()) names.push_back(fmt::format("{}: {}: {}", machine.file, finding.name, finding.step));
  return names;
}

std::string findings_text(const MachineFindings& machine, std::uint64_t seed) {
  std::string text = fmt::format("{}, seed {}\n\n", machine.file, seed);
  for (const Finding& finding : machine.findings) text += text_of(finding);
  return text;
}

std::string verdict_text(const StabilityReport& report) {
  const std::vector<std::string> broken = report.broken();
  std::string text = extremes_text(report);
  text += fmt::format("{}, {}; cases with a broken one: {}\n", counted(report.bounds(), "bound", "bounds"),
                      counted(static_cast<std::uint64_t>(report.inputs()), "input", "inputs"), broken.size());
  for (const std::string& one : broken) text += fmt::format("broken: {}\n", one);
  return text;
}

std::string stability_json(const StabilityReport& report) {
  Json machines = Json::array();
  for (const MachineFindings& machine : report.machines) {
    Json cases = Json::array();
    for (const Finding& finding : machine.findings) cases.push_back(json_of(finding));
    machines.push_back({{"machine", machine.file}, {"cases", std::move(cases)}});
  }
  const Json json = {{"schema", 1},
                     {"program", "rastertlm"},
                     {"kind", "stability"},
                     {"seed", report.seed},
                     {"bounds", report.bounds()},
                     {"inputs", report.inputs()},
                     {"broken", report.broken()},
                     {"machines", std::move(machines)}};
  return json.dump(2) + '\n';
}

}  // namespace rastertlm::report
