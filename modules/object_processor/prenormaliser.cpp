#include "modules/object_processor/prenormaliser.h"

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

namespace {

std::uint32_t magnitude(std::uint32_t word, unsigned word_bits) {
  const std::int64_t value = sign_extend(word, word_bits);
  return static_cast<std::uint32_t>(value < 0 ? ~value : value);
}

}  // namespace

Prenormaliser::Prenormaliser(const ObjectProcessorParameters& parameters, VectorVariant variant)
    : word_bits_(static_cast<unsigned>(parameters.word_bits)),
      normal_bits_(static_cast<unsigned>(parameters.normal_bits)),
      largest_shift_(word_bits_ > normal_bits_ ? word_bits_ - normal_bits_ : 0),
      kernels_(&span_kernels(variant)) {}

unsigned Prenormaliser::shifters() const { return bit_length(largest_shift_); }

unsigned Prenormaliser::shift_of(const std::array<std::uint32_t, 3>& normal) const {
  // The bit length of the largest is that of all three together.
  std::uint32_t together = 0;
  for (const std::uint32_t word : normal) together |= magnitude(word, word_bits_);
  const unsigned length = bit_length(together);
  return length > normal_bits_ - 1 ? length - (normal_bits_ - 1) : 0;
}

LinkNormal Prenormaliser::operator()(const std::array<std::uint32_t, 3>& normal) const {
  const unsigned shift = shift_of(normal);
  LinkNormal link{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t sign = (normal[i] >> (word_bits_ - 1) & 1U) << (normal_bits_ - 1);
    link[i] = static_cast<std::uint16_t>(sign | (magnitude(normal[i], word_bits_) >> shift));
  }
  return link;
}

void Prenormaliser::line(std::array<const std::uint32_t*, 3> normal, std::array<std::uint16_t*, 3> link,
                         std::size_t count) const {
  constexpr std::size_t kVector = 16;  // kernels run over the end of what is no multiple of it
  const std::size_t whole = word_bits_ <= kNormalisedBits ? count - count % kVector : 0;
  kernels_->prenormalise(
      {{normal[0], normal[1], normal[2]}, {link[0], link[1], link[2]}, whole, word_bits_, normal_bits_});
  for (std::size_t i = whole; i < count; ++i) {
    const LinkNormal words = (*this)({normal[0][i], normal[1][i], normal[2][i]});
    for (std::size_t component = 0; component < 3; ++component) link[component][i] = words[component];
  }
}

}  // namespace rastertlm::object_processor
