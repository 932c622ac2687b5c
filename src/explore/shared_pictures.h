// Exact pictures that workers share: the first that needs one renders it into memory that all later ones inherit.
#pragma once

#include <cstddef>
#include <string>

#include "src/run/simulate.h"

namespace rastertlm::explore {

// Memory for pictures of one size, mapped before workers are forked. It takes no room until it is written.
class SharedPictures {
 public:
  // Maps less, or nothing, where there is not so much: what is not shared is rendered again.
  explicit SharedPictures(const run::ExactNeeds& needs);
  SharedPictures(const SharedPictures&) = delete;
  SharedPictures& operator=(const SharedPictures&) = delete;
  ~SharedPictures();

  // The picture of that key, if it is there as a whole.
  bool read(const std::string& key, frame::ExactFrame& picture) const;
  // Adds it, if there is room. Of all processes, one alone may.
  void write(const std::string& key, const frame::ExactFrame& picture);
  std::size_t written_bytes() const;

 private:
  struct Slot;
  Slot* slot(std::size_t index) const;

  std::size_t pixels_;
  std::size_t slot_bytes_;
  std::size_t slots_ = 0;
  void* memory_ = nullptr;
};

// A worker's view of them.
class SharedExactStore : public run::ExactStore {
 public:
  SharedExactStore(SharedPictures& pictures, bool writes) : pictures_(pictures), writes_(writes) {}
  frame::ExactFrame picture(const std::string& key, const std::function<frame::ExactFrame()>& render) override;

 private:
  SharedPictures& pictures_;
  bool writes_;
};

}  // namespace rastertlm::explore
