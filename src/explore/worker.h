// A simulation in a process of its own, for SystemC allows one a process: what it found comes back by pipe, and what
// goes wrong in it is its own affair.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "src/explore/shared_pictures.h"
#include "src/explore/store.h"
#include "src/run/simulate.h"

namespace rastertlm::explore {

// What a worker is to do. It inherits everything that this refers to.
struct Work {
  const run::Inputs& inputs;
  std::uint64_t frames = 1;
  bool reference = true;
  bool thumbnail = true;
  bool scene_toml = true;                   // send the resolved scene
  const std::vector<std::string>& figures;  // paths
  SharedPictures* exact = nullptr;          // none: nothing is shared
  bool renders = false;                     // it adds to `exact` what it renders
};

class Worker {
 public:
  // Forks. Throws OutputError where the system has no process or pipe left.
  explicit Worker(const Work& work);
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  // A worker that is still at work is ended.
  ~Worker();

  int descriptor() const { return pipe_; }
  // Takes what has come. True at its end: then result() is to be asked for.
  bool read();
  // What it found, without the key and the digests; a worker that did not come to its end is a failed point.
  PointResult result();

 private:
  std::string ending(int status) const;
  pid_t process_ = -1;
  int pipe_ = -1;
  int printed_ = -1;  // what it printed
  std::string received_;
};

}  // namespace rastertlm::explore
