#include "modules/object_processor/line_evaluator.h"

#include <algorithm>

namespace rastertlm::object_processor {

namespace {

__extension__ using Wide = __int128;

// Lines y of [begin, end) with p y + q >= 0.
template <class Integer>
void narrow_lines(Integer p, Integer q, Interval& lines) {
  if (p == 0) {
    if (q < 0) lines.end = lines.begin;
    return;
  }
  const Integer divisor = p > 0 ? p : -p;
  const Integer value = p > 0 ? -q : q;  // p > 0: y >= value / divisor; p < 0: y <= value / divisor
  const Integer quotient = value / divisor;
  const Integer rest = value % divisor;
  if (p > 0) {
    const Integer first = quotient + (rest > 0 ? 1 : 0);
    if (first > lines.begin) lines.begin = static_cast<std::int32_t>(std::min<Integer>(first, lines.end));
  } else {
    const Integer end = quotient - (rest < 0 ? 1 : 0) + 1;
    if (end < lines.end) lines.end = static_cast<std::int32_t>(std::max<Integer>(end, lines.begin));
  }
}

// p y + q >= 0 on all of them: what most triangles' single edges say of the screen. |p| < 2^31, |q| < 2^46.
bool holds_on_all(std::int64_t p, std::int64_t q, const Interval& lines) {
  return p * lines.begin + q >= 0 && p * (lines.end - 1) + q >= 0;
}

// Eliminates x (Fourier and Motzkin) from a x + b y + c >= 0 of every half plane and 0 <= x <= last_column: what
// remains is the shadow on the axis of lines, exact over the reals.
template <class Integer>
void eliminate_columns(const std::array<HalfPlane, 3>& planes, std::size_t count, std::int64_t last_column,
                       Interval& lines) {
  for (std::size_t i = 0; i < count; ++i) {
    const HalfPlane& plane = planes[i];
    const std::int64_t best_column = plane.a > 0 ? last_column : 0;
    const std::int64_t constant = plane.a * best_column + plane.c;
    if (!holds_on_all(plane.b, constant, lines)) narrow_lines<Integer>(plane.b, constant, lines);
    for (std::size_t j = 0; j < count; ++j) {
      const HalfPlane& other = planes[j];
      if (plane.a > 0 && other.a < 0)
        narrow_lines<Integer>(Integer{plane.a} * other.b - Integer{other.a} * plane.b,
                              Integer{plane.a} * other.c - Integer{other.a} * plane.c, lines);
    }
  }
}

// Products of two words and their differences fit in 64 bits up to this width.
constexpr unsigned kWordsOfNarrowProducts = 30;

}  // namespace

HalfPlanes half_planes(const std::array<LinearWords, 3>& edges, WordFormat format, std::int32_t columns,
                       std::int32_t lines) {
  const unsigned bits = format.bits();
  const std::int64_t limit = std::int64_t{1} << (bits - 1);
  const std::int64_t last_column = columns - 1;
  const std::int64_t last_line = lines - 1;
  HalfPlanes result;
  for (const LinearWords& edge : edges) {
    const HalfPlane plane{sign_extend(edge.a, bits), sign_extend(edge.b, bits),
                          sign_extend(format.at(edge, 0, 0), bits)};
    bool inside = true;
    for (const std::int64_t corner : {plane.c + plane.a * last_column, plane.c + plane.b * last_line,
                                      plane.c + plane.a * last_column + plane.b * last_line})
      inside = inside && -limit <= corner && corner < limit;
    if (inside) result.planes[result.count++] = plane;
  }
  return result;
}

Interval touched_lines(const HalfPlanes& planes, WordFormat format, std::int32_t columns, std::int32_t lines) {
  Interval touched{0, lines};
  if (format.bits() <= kWordsOfNarrowProducts)
    eliminate_columns<std::int64_t>(planes.planes, planes.count, columns - 1, touched);
  else
    eliminate_columns<Wide>(planes.planes, planes.count, columns - 1, touched);
  return touched;
}

Interval touched_lines(const std::array<LinearWords, 3>& edges, WordFormat format, std::int32_t columns,
                       std::int32_t lines) {
  return touched_lines(half_planes(edges, format, columns, lines), format, columns, lines);
}

LateCarryLine late_carry_line(const LinearWords& words, const ObjectProcessorParameters& parameters,
                              std::uint32_t line) {
  const auto word_bits = static_cast<std::uint32_t>(parameters.word_bits);
  const auto slice_bits = static_cast<std::uint32_t>(parameters.slice_bits);
  LateCarryLine result;
  std::uint32_t second = 0;  // the word of column 1
  std::uint32_t left_over = 0;
  for (std::uint32_t position = 0; position < word_bits; position += slice_bits) {
    const std::uint32_t bits = std::min(slice_bits, word_bits - position);
    const auto mask = static_cast<std::uint32_t>(low_mask(bits));
    const std::uint32_t a = words.a >> position & mask;
    const std::uint32_t b = words.b >> position & mask;
    const std::uint32_t value = ((words.c >> position & mask) + b * (line + 1)) & mask;
    result.first |= value << position;
    second |= ((value + a + left_over) & mask) << position;
    // While the slice above adds B, this one's adder already holds its new value, and B once more.
    left_over = static_cast<std::uint32_t>((std::uint64_t{value} + b + left_over) >> bits);
  }
  result.start = (second - words.a) & static_cast<std::uint32_t>(low_mask(word_bits));
  return result;
}

}  // namespace rastertlm::object_processor
