// The incremental algorithms that fill the tables (004, section 5.3.5). No table of the model is filled in any other
// way.
//
// A ramp (dot-product and diffuse tables): a constant is added to an error register for each address; each overflow of
// the register increases the stored value by one, as in Bresenham's line. Register and value are one word here, as in
// the paper's 68000 version, where the overflow carries into the value by itself. A path (specular tables): moves of
// the path ROM; `right` stores and goes to the next address, `up` adds Ks to the error register.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/shading/parameters.h"
#include "modules/shading/path_rom.h"

namespace rastertlm::shading {

// The arguments of a ramp: entry i is (preset + i * increment) >> error_bits.
struct Ramp {
  std::uint64_t increment = 0;
  std::uint64_t preset = 0;  // of the register; below 2^error_bits, but for a slice of a longer ramp
  unsigned error_bits = 0;
  std::uint32_t entries = 0;
  friend bool operator==(const Ramp&, const Ramp&) = default;
};

// n * word / 2^address_bits, n = 0 .. 2^address_bits - 1. Literal: the register starts at 0. Centred: entries for n +
// 1/2, so the register starts at half an increment and has a bit more to hold it.
Ramp product_ramp(std::uint32_t light_word, unsigned address_bits, Arithmetic arithmetic);

// Levels constant * i / 2^index_bits; the constant has fraction_bits (0 if literal). Centred: entries for i + 1/2,
// rounded: preset half an increment and one half.
Ramp level_ramp(std::uint32_t constant, unsigned index_bits, unsigned fraction_bits, Arithmetic arithmetic);

// The arguments of a path. Ks: 0 .. 2^error_bits - 1, the paper's "the greater value of Ks is coded as the final
// state"; centred up to 2^error_bits, with a preset of one half.
struct PathScale {
  std::uint32_t ks = 0;
  std::uint32_t preset = 0;
  unsigned error_bits = 0;
  friend bool operator==(const PathScale&, const PathScale&) = default;
};
PathScale path_scale(std::uint32_t ks, unsigned level_bits, Arithmetic arithmetic);

// What one step does: `stores` only where a word is written.
struct FillStep {
  std::uint32_t address = 0;  // within the table
  std::uint32_t value = 0;
  bool stores = false;
};

class RampFiller {
 public:
  explicit RampFiller(const Ramp& ramp) : ramp_(ramp), word_(ramp.preset) {}
  bool done() const { return address_ == ramp_.entries; }
  FillStep step();  // !done()

 private:
  Ramp ramp_;
  std::uint64_t word_;  // the value above the error register
  std::uint32_t address_ = 0;
};

class PathFiller {
 public:
  // `moves` must outlive the filler.
  PathFiller(std::span<const Move> moves, const PathScale& scale)
      : moves_(moves), scale_(scale), error_(scale.preset) {}
  bool done() const { return position_ == moves_.size(); }
  Move next() const { return moves_[position_]; }  // !done()
  FillStep step();                                 // !done()

  // The registers before the next step, as figure 5.11 lists them.
  std::uint32_t address() const { return address_; }
  std::uint32_t error() const { return error_; }
  std::uint32_t value() const { return value_; }

 private:
  std::span<const Move> moves_;
  PathScale scale_;
  std::size_t position_ = 0;
  std::uint32_t address_ = 0;
  std::uint32_t error_;
  std::uint32_t value_ = 0;
};

// All steps at once; out.size() entries are written (ramp.entries, or the path's `right`s). The same words as stepping
// (tested).
template <class Word>
void fill(const Ramp& ramp, std::span<Word> out) {
  std::uint64_t word = ramp.preset;
  for (Word& entry : out) {
    entry = static_cast<Word>(word >> ramp.error_bits);
    word += ramp.increment;
  }
}
template <class Word>
void fill(std::span<const Move> moves, const PathScale& scale, std::span<Word> out) {
  std::uint32_t word = scale.preset;
  std::size_t address = 0;
  for (const Move move : moves) {
    if (move == Move::up) {
      word += scale.ks;
    } else {
      out[address++] = static_cast<Word>(word >> scale.error_bits);
    }
  }
}

// The part of a ramp from entry `first` on, `entries` long: its register starts with what the entries before add up to.
Ramp slice(const Ramp& ramp, std::uint32_t first, std::uint32_t entries);

}  // namespace rastertlm::shading
