// A point of a sweep made into what is simulated.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/base/errors.h"
#include "src/explore/design.h"
#include "src/explore/sweep.h"
#include "src/run/input_files.h"
#include "src/run/simulate.h"

namespace rastertlm::explore {

struct Point {
  std::string key;            // of its configuration
  std::string config_digest;  // "" where the configuration is wrong
  std::string scene_digest;
  std::string error;                    // why it is wrong
  std::shared_ptr<run::Inputs> inputs;  // none where it is
  run::ExactNeeds exact;
};

class PointMaker {
 public:
  explicit PointMaker(const Sweep& sweep) : sweep_(sweep) {}
  Point make(const std::vector<std::size_t>& choices);
  // Tells sweeps apart: what varies, what counts, and the machines and scenes that it begins from.
  std::string sweep_digest();

 private:
  InputError of_sweep(const InputError& error, const std::vector<std::size_t>& choices) const;
  std::string key_of(const std::string& what) const;
  const std::string& text_of(const std::string& file);

  const Sweep& sweep_;
  run::InputFiles files_;
  std::map<std::string, std::string> texts_;  // of files, for configurations that are wrong
};

}  // namespace rastertlm::explore
