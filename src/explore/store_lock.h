// One explorer a store: a lock beside it that ends with the process, however that ends.
#pragma once

#include <string>

namespace rastertlm::explore {

class StoreLock {
 public:
  // Takes STORE.lock. Throws InputError, naming the process, where another has it; OutputError where it cannot be made.
  explicit StoreLock(const std::string& store);
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;
  ~StoreLock();

 private:
  std::string file_;
  int descriptor_ = -1;
};

}  // namespace rastertlm::explore
