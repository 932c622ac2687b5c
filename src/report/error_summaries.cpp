#include "src/report/error_summaries.h"

#include <algorithm>

namespace rastertlm::report {
namespace {

std::vector<const reference::ErrorFigures*> figures_of(const run::Result& result, const std::string& reference) {
  std::vector<const reference::ErrorFigures*> figures;
  for (const run::FrameFigures& frame : result.frames)
    for (const reference::ErrorFigures& e : frame.errors)
      if (e.reference == reference) figures.push_back(&e);
  return figures;
}

}  // namespace

std::vector<std::string> references_of(const run::Result& result) {
  std::vector<std::string> names;
  for (const run::FrameFigures& frame : result.frames)
    for (const reference::ErrorFigures& e : frame.errors)
      if (std::find(names.begin(), names.end(), e.reference) == names.end()) names.push_back(e.reference);
  return names;
}

std::vector<reference::ErrorSummary> summaries_of(const run::Result& result) {
  std::vector<reference::ErrorSummary> summaries;
  for (const std::string& name : references_of(result))
    summaries.push_back(reference::summary_of(figures_of(result, name)));
  return summaries;
}

std::optional<reference::ErrorFigures> worst_of(const run::Result& result, const std::string& reference) {
  const std::vector<const reference::ErrorFigures*> figures = figures_of(result, reference);
  if (figures.empty()) return std::nullopt;
  return reference::summary_of(figures).worst;
}

}  // namespace rastertlm::report
