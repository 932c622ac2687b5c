#include "modules/object_processor/prenormaliser.h"

#include <bit>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

namespace {

// A magnitude of up to 24 bits is exact in a float, and so is its product with a power of two.
constexpr unsigned kExactInFloat = 25;
constexpr unsigned kFloatFraction = 23;
constexpr std::int32_t kFloatBias = 127;

// Words of at most 25 bits: the float's exponent is the bit length and its product the shift, so that lanes of a vector
// need neither a count of leading zeros nor a shift of their own. Every step is exact.
void line_in_float(const std::uint32_t* __restrict x, const std::uint32_t* __restrict y,
                   const std::uint32_t* __restrict z, std::uint16_t* __restrict link_x,
                   std::uint16_t* __restrict link_y, std::uint16_t* __restrict link_z, std::size_t count,
                   unsigned word_bits, unsigned normal_bits) {
  const int up = static_cast<int>(32 - word_bits);
  const auto magnitude_bits = static_cast<std::int32_t>(normal_bits - 1);
  const std::int32_t at_least =
      (1 << magnitude_bits) - 1;  // so that the bit length is never below magnitude_bits, and K not below 0
  const auto sign_bit = std::int32_t{1} << (normal_bits - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t nx = static_cast<std::int32_t>(x[i] << up) >> up;
    const std::int32_t ny = static_cast<std::int32_t>(y[i] << up) >> up;
    const std::int32_t nz = static_cast<std::int32_t>(z[i] << up) >> up;
    const std::int32_t mx = nx ^ (nx >> 31);
    const std::int32_t my = ny ^ (ny >> 31);
    const std::int32_t mz = nz ^ (nz >> 31);
    const auto exponent =
        std::bit_cast<std::int32_t>(static_cast<float>(mx | my | mz | at_least)) >> kFloatFraction;  // bit length + 126
    const std::int32_t shift = exponent - (kFloatBias - 1) - magnitude_bits;
    const auto scale = std::bit_cast<float>((kFloatBias - shift) << kFloatFraction);  // 2^-K
    const auto kx = static_cast<std::int32_t>(static_cast<float>(mx) * scale);
    const auto ky = static_cast<std::int32_t>(static_cast<float>(my) * scale);
    const auto kz = static_cast<std::int32_t>(static_cast<float>(mz) * scale);
    link_x[i] = static_cast<std::uint16_t>(kx | ((nx >> 31) & sign_bit));
    link_y[i] = static_cast<std::uint16_t>(ky | ((ny >> 31) & sign_bit));
    link_z[i] = static_cast<std::uint16_t>(kz | ((nz >> 31) & sign_bit));
  }
}

std::uint32_t magnitude(std::uint32_t word, unsigned word_bits) {
  const std::int64_t value = sign_extend(word, word_bits);
  return static_cast<std::uint32_t>(value < 0 ? ~value : value);
}

}  // namespace

Prenormaliser::Prenormaliser(const ObjectProcessorParameters& parameters)
    : word_bits_(static_cast<unsigned>(parameters.word_bits)),
      normal_bits_(static_cast<unsigned>(parameters.normal_bits)),
      largest_shift_(word_bits_ > normal_bits_ ? word_bits_ - normal_bits_ : 0) {}

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
  if (word_bits_ <= kExactInFloat) {
    line_in_float(normal[0], normal[1], normal[2], link[0], link[1], link[2], count, word_bits_, normal_bits_);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const LinkNormal words = (*this)({normal[0][i], normal[1][i], normal[2][i]});
    for (std::size_t component = 0; component < 3; ++component) link[component][i] = words[component];
  }
}

}  // namespace rastertlm::object_processor
