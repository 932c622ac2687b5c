// The registers of figure 6 (000/001), stepped a clock at a time: the definition of what a span unit shows. Everything
// faster must give the same words.
#pragma once

#include <cstdint>

#include "modules/span_unit/span_words.h"
#include "src/base/fixed_point.h"

namespace rastertlm::span_unit {

// One colour channel. Registers wrap at `word_bits`, never saturate.
class ColourRegisters {
 public:
  explicit ColourRegisters(unsigned word_bits) : mask_(low_mask(word_bits)) {}

  // The load signal: start edge registers take their words; figure 6 loads `I` and `dI` from them.
  void load(const ColourWords& words) {
    words_ = words;
    load_line();
  }
  // The next line's start: with the edge's whole slope, and where it carries, a pixel more with what then stands in the
  // registers. Ends with a load of `I` and `dI`.
  void step_line(bool carries) {
    words_.start = add(words_.start, words_.line_step);
    words_.pixel_step = add(words_.pixel_step, words_.line_pixel);
    words_.line_step = add(words_.line_step, words_.line_line);
    if (carries) {
      words_.start = add(words_.start, words_.pixel_step);
      words_.pixel_step = add(words_.pixel_step, words_.pixel_pixel);
      words_.line_step = add(words_.line_step, words_.line_pixel);
    }
    load_line();
  }
  void step_pixel() {
    i_ = add(i_, di_);
    di_ = add(di_, words_.pixel_pixel);
  }
  // Of the line: I and dI from values of their own (prestep).
  void set_line(std::uint64_t i, std::uint64_t di) {
    i_ = i & mask_;
    di_ = di & mask_;
  }

  std::uint64_t i() const { return i_; }
  std::uint64_t di() const { return di_; }
  std::uint64_t start() const { return words_.start; }
  std::uint64_t line_step() const { return words_.line_step; }
  std::uint64_t pixel_step() const { return words_.pixel_step; }

 private:
  void load_line() {
    i_ = words_.start & mask_;
    di_ = words_.pixel_step & mask_;
  }
  std::uint64_t add(std::uint64_t a, std::uint64_t b) const { return (a + b) & mask_; }

  std::uint64_t mask_;
  ColourWords words_;
  std::uint64_t i_ = 0;
  std::uint64_t di_ = 0;
};

// The level that leaves: the word without its fraction, clamped. 0.5 has been added to the start.
inline std::uint32_t level_of(std::uint64_t word, unsigned word_bits, unsigned fraction_bits) {
  const std::int64_t whole = sign_extend(word, word_bits) >> fraction_bits;
  return whole < 0 ? 0U : (whole > 255 ? 255U : static_cast<std::uint32_t>(whole));
}

}  // namespace rastertlm::span_unit
