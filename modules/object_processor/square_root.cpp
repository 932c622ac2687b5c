#include "modules/object_processor/square_root.h"

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

namespace {

std::uint64_t read(std::uint64_t root, RootReading reading) {
  return reading == RootReading::half_unit ? 2 * root + 1 : root;
}

}  // namespace

std::uint64_t RootFormat::radicand(std::uint64_t word) const {
  const unsigned wanted = 2 * guard_bits;
  const std::uint64_t aligned =
      fraction_bits >= wanted ? word >> (fraction_bits - wanted) : word << (wanted - fraction_bits);
  return aligned & low_mask(2 * result_bits());
}

std::uint64_t RootFormat::largest_word() const {
  const std::uint64_t largest = low_mask(2 * result_bits());
  const unsigned wanted = 2 * guard_bits;
  if (fraction_bits <= wanted) return largest >> (wanted - fraction_bits);
  const unsigned dropped = fraction_bits - wanted;
  return 2 * result_bits() + dropped >= 64 ? ~std::uint64_t{0} : (largest << dropped) | low_mask(dropped);
}

RootStage next_root_bit(const RootStage& stage, unsigned result_bits) {
  const unsigned top = 2 * result_bits - 2;
  const std::uint64_t remainder = stage.remainder << 2 | stage.radicand >> top;
  const std::uint64_t trial = stage.root << 2 | 1;
  const bool fits = remainder >= trial;
  return {(stage.radicand << 2) & low_mask(2 * result_bits), fits ? remainder - trial : remainder,
          stage.root << 1 | (fits ? 1U : 0U)};
}

std::uint64_t square_root(std::uint64_t word, const RootFormat& format) {
  RootStage stage{format.radicand(word), 0, 0};
  for (unsigned bit = 0; bit < format.result_bits(); ++bit) stage = next_root_bit(stage, format.result_bits());
  return read(stage.root, format.reading);
}

RootPipeline::RootPipeline(const RootFormat& format) : format_(format), stages_(format.stages()) {}

std::uint64_t RootPipeline::clock(std::uint64_t word) {
  for (std::size_t i = stages_.size() - 1; i > 0; --i)
    stages_[i] = next_root_bit(stages_[i - 1], format_.result_bits());
  stages_[0] = next_root_bit({format_.radicand(word), 0, 0}, format_.result_bits());
  return read(stages_.back().root, format_.reading);
}

// After k stages: 2 (result_bits - k) bits of the radicand, k of the root, and a remainder of at most twice the root.
std::uint64_t RootPipeline::register_bits() const {
  std::uint64_t bits = 0;
  for (unsigned k = 1; k <= format_.stages(); ++k) bits += 2 * (format_.result_bits() - k) + k + (k + 1);
  return bits;
}

}  // namespace rastertlm::object_processor
