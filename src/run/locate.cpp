#include "src/run/locate.h"

#include <algorithm>
#include <optional>

namespace rastertlm::run {
namespace {

// The first line of anything given below `path`: that is where its table begins, or the key next to that.
std::optional<config::Origin> first_below(const config::Origins& origins, const std::string& path) {
  std::optional<config::Origin> first;
  for (const auto& [key, origin] : origins.all()) {
    const bool below = key.size() > path.size() && key.compare(0, path.size(), path) == 0 &&
                       (key[path.size()] == '.' || key[path.size()] == '[');
    if (below && origin.kind == config::OriginKind::file && (!first || origin.line < first->line)) first = origin;
  }
  return first;
}

}  // namespace

Diagnostic located(Diagnostic diagnostic, const config::Origins& origins, const std::string& file) {
  if (diagnostic.line > 0 || (!diagnostic.file.empty() && diagnostic.file != file)) return diagnostic;
  diagnostic.file = file;
  const config::Origin own = origins.of(diagnostic.key);
  if (own.kind == config::OriginKind::set) {
    diagnostic.file = "--set";
  } else if (own.kind == config::OriginKind::file) {
    diagnostic.line = own.line;
  } else {
    std::string path = diagnostic.key;
    std::optional<config::Origin> near = first_below(origins, path);
    while (!near && path.find_last_of(".[") != std::string::npos) {
      path.resize(path.find_last_of(".["));
      if (path.find('.') != std::string::npos || path.find('[') != std::string::npos) near = first_below(origins, path);
    }
    if (near) diagnostic.line = near->line;
  }
  return diagnostic;
}

}  // namespace rastertlm::run
