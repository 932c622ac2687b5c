// The frame store: a depth-buffered picture that is drawn into, and one that is shown.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/frame_store/parameters.h"
#include "modules/frame_store/store_kernels.h"
#include "modules/span_unit/span.h"
#include "src/base/vector_variant.h"
#include "src/frame/frame.h"
#include "src/frame/scan_line.h"

namespace rastertlm::frame_store {

// fragments_in = fragments_kept + fragments_hidden, always. Kept: won the depth test when they came; later ones may
// cover them.
struct StoreCounters {
  std::uint64_t fragments_in = 0;
  std::uint64_t fragments_kept = 0;
  std::uint64_t fragments_hidden = 0;
};

class FrameStore {
 public:
  // Which pictures the store keeps beside levels and depth: none, the triangle's number (for ties), or everything that
  // observers want to know of a pixel.
  enum class Keep { nothing, numbers, everything };

  struct Format {
    std::uint32_t columns = 512;
    std::uint32_t lines = 512;
    std::uint32_t farthest = 0xFFFFFF;                // depth of nothing
    std::array<std::uint8_t, 3> background{0, 0, 0};  // levels of nothing
    span_unit::PixelFormat pixels{};                  // of the spans that are drawn
    Keep keep = Keep::everything;
    bool ties = false;  // the store has the triangles' numbers, and compares them where depths are equal
  };

  FrameStore(const FrameStoreParameters& parameters, const Format& format, VectorVariant variant = vector_variant());

  // Of the picture that is drawn: nothing everywhere, or on a line.
  void clear();
  void clear(std::uint32_t line);
  // Spans of a triangle, on the screen, on one line after the other. Strictly smaller depth wins; equal depth keeps the
  // lower object where the store compares numbers, else the first. Without a depth test what comes last stays. Returns
  // how many pixels won; `won`, where given and of a single span, a bit a pixel which: from the lowest on, in as many
  // words as hold them.
  std::uint32_t draw(std::span<const span_unit::Span> spans, std::uint32_t object, std::uint32_t material,
                     std::uint64_t* won = nullptr);
  // The same with levels that are given, of the spans' pixels one after the other: red, green, blue from the low byte
  // on. Depth is the registers'.
  std::uint32_t draw_levels(std::span<const span_unit::Span> spans, std::span<const std::uint32_t> levels,
                            std::uint32_t object, std::uint32_t material, std::uint64_t* won = nullptr);
  // What was drawn is shown; where there are two buffers, the other one is drawn.
  void swap();

  // Levels of a line that is shown; until clear() or draw() begins the next picture, where a picture is cleared.
  void scan_out(std::uint32_t line, frame::RgbLine& out) const;
  // What is shown, with what was kept. Likewise; where pictures change while they are shown, of each line that which
  // was there when it was last noted.
  void observe(frame::Frame& out) const;
  // What is kept of a line that is being read, for observers.
  void note_line(std::uint32_t line);

  const StoreCounters& counters() const { return counters_; }

 private:
  struct Buffer {
    std::vector<std::uint32_t> levels;
    std::vector<std::uint32_t> objects;
    std::vector<std::uint32_t> materials;
    std::vector<std::uint32_t> coverage;
    std::vector<std::uint32_t> depth;
    // Of lines into which nothing has been drawn since the last clear: their words are set when something is.
    std::vector<std::uint8_t> blank;
  };
  void resize(Buffer& buffer) const;
  std::uint32_t draw(StoreRequest& request, std::span<const span_unit::Span> spans);
  void begin_line(Buffer& buffer, std::size_t line) const;
  void copy_lines(std::size_t begin, std::size_t end, frame::Frame& out) const;
  const Buffer& shown() const { return buffers_[two_ ? 1 - drawn_ : drawn_]; }

  FrameStoreParameters parameters_;
  Format format_;
  std::uint32_t background_;
  std::vector<std::uint8_t> blank_line_;  // as it is shown
  const StoreKernels& kernels_;
  // A picture that is cleared before it is drawn leaves no trace of the last but one: then one buffer does for two, if
  // the screen looks between the swap and the clear.
  bool two_;
  std::array<Buffer, 2> buffers_;
  std::size_t drawn_ = 0;  // the other, or the same where there is one, is shown
  frame::Frame noted_;     // line by line
  StoreCounters counters_;
  std::vector<std::uint32_t> given_;  // levels, with room behind them
};

}  // namespace rastertlm::frame_store
