#include "src/config/origins.h"

#include <fmt/format.h>

#include <filesystem>

namespace rastertlm::config {

std::string to_string(const Origin& origin) {
  switch (origin.kind) {
    case OriginKind::default_value:
      return "default";
    case OriginKind::preset:
      return "preset " + origin.name;
    case OriginKind::file:
      return fmt::format("{}:{}", origin.name, origin.line);
    case OriginKind::set:
      return "--set";
  }
  return "";
}

Origin Origins::of(const std::string& path) const {
  const auto found = origins_.find(path);
  return found == origins_.end() ? Origin{} : found->second;
}

std::string resolve_path(const Origin& origin, const std::string& path) {
  if (origin.kind != OriginKind::file || path.empty()) return path;
  return (std::filesystem::path(origin.name).parent_path() / path).lexically_normal().string();
}

}  // namespace rastertlm::config
