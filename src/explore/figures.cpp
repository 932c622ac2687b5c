#include "src/explore/figures.h"

#include <variant>

#include "src/config/document.h"

namespace rastertlm::explore {
namespace {

constexpr std::string_view kMachine = "machine.";

}  // namespace

std::string parameter_of(const std::string& path) {
  return path.starts_with(kMachine) ? path.substr(kMachine.size()) : "";
}

std::optional<double> figure_of(const std::string& path, const report::Figures& report,
                                const std::string& machine_toml) {
  const std::string parameter = parameter_of(path);
  if (parameter.empty()) return report.value(path);
  const config::Document machine = config::Document::from_text(machine_toml, "config.resolved.toml");
  const config::Entry* entry = machine.find(parameter);
  if (entry == nullptr) return std::nullopt;
  if (const auto* whole = std::get_if<std::int64_t>(&entry->value.value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&entry->value.value)) return *real;
  if (const auto* truth = std::get_if<bool>(&entry->value.value)) return *truth ? 1.0 : 0.0;
  return std::nullopt;
}

}  // namespace rastertlm::explore
