// Where each value of a resolved configuration came from.
#pragma once

#include <map>
#include <string>

namespace rastertlm::config {

enum class OriginKind { default_value, preset, file, set };

struct Origin {
  OriginKind kind = OriginKind::default_value;
  std::string name;  // preset: its name; file: the file as it was named
  int line = 0;      // file
};

// "default", "preset t800_20", "machine.toml:12", "--set"
std::string to_string(const Origin& origin);

class Origins {
 public:
  // A value that nobody set has the origin default.
  Origin of(const std::string& path) const;
  void set(const std::string& path, Origin origin) { origins_[path] = std::move(origin); }
  bool contains(const std::string& path) const { return origins_.contains(path); }
  const std::map<std::string, Origin>& all() const { return origins_; }

 private:
  std::map<std::string, Origin> origins_;
};

// A file name that is a value: relative to the file that names it, or to the working directory where no file does.
std::string resolve_path(const Origin& origin, const std::string& path);

}  // namespace rastertlm::config
