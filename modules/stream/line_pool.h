// Scan lines that are used again and again: no allocation in the line loop.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "src/frame/scan_line.h"

namespace rastertlm::stream {

class LinePool {
 public:
  // Gives the line back to its pool; the pool outlives its lines.
  struct Return {
    LinePool* pool = nullptr;
    void operator()(frame::FragmentLine* line) const { pool->free_.push_back(line); }
  };
  using Handle = std::unique_ptr<frame::FragmentLine, Return>;

  explicit LinePool(std::size_t columns) : columns_(columns) {}
  LinePool(const LinePool&) = delete;
  LinePool& operator=(const LinePool&) = delete;

  // A cleared line of `columns` pixels.
  Handle acquire() {
    if (free_.empty()) {
      lines_.push_back(std::make_unique<frame::FragmentLine>());
      lines_.back()->resize(columns_);
      free_.push_back(lines_.back().get());
    }
    frame::FragmentLine* line = free_.back();
    free_.pop_back();
    line->clear();
    return Handle(line, Return{this});
  }

 private:
  std::size_t columns_;
  std::vector<std::unique_ptr<frame::FragmentLine>> lines_;
  std::vector<frame::FragmentLine*> free_;
};

}  // namespace rastertlm::stream
