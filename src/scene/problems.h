// What is wrong with a scene, said with the file and the path of the key.
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "src/base/errors.h"

namespace rastertlm::scene {

class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}
  void add(const std::string& key, const std::string& message) { diagnostics_.add({file_, 0, key, message}); }
  std::size_t count() const { return diagnostics_.list().size(); }
  // Whether anything was said of a key that begins so.
  bool mentions(const std::string& prefix) const {
    const auto& list = diagnostics_.list();
    return std::any_of(list.begin(), list.end(), [&](const Diagnostic& d) { return d.key.rfind(prefix, 0) == 0; });
  }
  void throw_if_any() const { diagnostics_.throw_if_any(); }

 private:
  std::string file_;
  Diagnostics diagnostics_;
};

}  // namespace rastertlm::scene
