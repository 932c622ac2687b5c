// Are spans and line intervals in closed form what a look at every pixel gives?
#include "modules/object_processor/line_evaluator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rastertlm::object_processor {
namespace {

bool sign_clear(const LinearWords& words, std::uint32_t column, std::uint32_t line, unsigned bits) {
  const std::uint64_t sum = std::uint64_t{words.a} * column + std::uint64_t{words.b} * (line + 1) + words.c;
  return (sum >> (bits - 1) & 1U) == 0;
}

LinearWords of_integers(std::int64_t a, std::int64_t b, std::int64_t c, unsigned bits) {
  return {static_cast<std::uint32_t>(wrap_unsigned(a, bits)), static_cast<std::uint32_t>(wrap_unsigned(b, bits)),
          static_cast<std::uint32_t>(wrap_unsigned(c, bits))};
}

// Words of all sizes: an exponent first, so that small ones, which do not wrap, are as frequent as large ones.
LinearWords random_words(std::mt19937& random, unsigned bits) {
  const auto word = [&] {
    const auto size = 1 + random() % bits;
    return sign_extend(random(), static_cast<unsigned>(size));
  };
  const std::int64_t a = word();
  const std::int64_t b = word();
  return of_integers(a, b, word(), bits);
}

TEST(LineEvaluator, NarrowedSpanIsWhereTheSignBitIsClear) {
  std::mt19937 random(11);
  int wrapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const unsigned bits = 8 + static_cast<unsigned>(random() % 25);
    const std::int32_t columns = 1 + static_cast<std::int32_t>(random() % 60);
    const auto line = static_cast<std::uint32_t>(random() % 512);
    const LinearWords words = random_words(random, bits);
    const LineWord word = WordFormat(bits).on_line(words, line);
    if (!stays_inside(word, columns - 1)) {
      ++wrapping;
      continue;
    }
    Interval span{0, columns};
    narrow(word, span);
    for (std::int32_t column = 0; column < columns; ++column)
      ASSERT_EQ(span.holds(column), sign_clear(words, static_cast<std::uint32_t>(column), line, bits))
          << bits << " bits, A " << words.a << " B " << words.b << " C " << words.c << " at " << column << ", " << line;
  }
  EXPECT_GT(wrapping, 1000);
  EXPECT_LT(wrapping, 19000);
}

TEST(LineEvaluator, WordsStayInsideExactlyWhenNoColumnWraps) {
  std::mt19937 random(12);
  for (int i = 0; i < 20000; ++i) {
    const unsigned bits = 8 + static_cast<unsigned>(random() % 25);
    const std::int32_t columns = 1 + static_cast<std::int32_t>(random() % 40);
    const LinearWords words = random_words(random, bits);
    const std::int64_t start = sign_extend(std::uint64_t{words.b} + words.c, bits);
    const std::int64_t step = sign_extend(words.a, bits);
    bool inside = true;
    for (std::int64_t column = 0; column < columns; ++column) {
      const std::int64_t value = start + step * column;
      inside = inside && wrap_signed(value, bits) == value;
    }
    ASSERT_EQ(stays_inside(WordFormat(bits).on_line(words, 0), columns - 1), inside);
  }
}

TEST(LineEvaluator, NoCoveredPixelLiesOutsideTheTouchedLines) {
  std::mt19937 random(13);
  int covered = 0;
  for (int i = 0; i < 4000; ++i) {
    const unsigned bits = 8 + static_cast<unsigned>(random() % 25);
    const std::int32_t columns = 1 + static_cast<std::int32_t>(random() % 40);
    const std::int32_t lines = 1 + static_cast<std::int32_t>(random() % 40);
    const std::array<LinearWords, 3> edges{random_words(random, bits), random_words(random, bits),
                                           random_words(random, bits)};
    const Interval touched = touched_lines(edges, WordFormat(bits), columns, lines);
    ASSERT_GE(touched.begin, 0);
    ASSERT_LE(touched.end, lines);
    for (std::int32_t line = 0; line < lines; ++line)
      for (std::int32_t column = 0; column < columns; ++column) {
        const bool inside = std::all_of(edges.begin(), edges.end(), [&](const LinearWords& edge) {
          return sign_clear(edge, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(line), bits);
        });
        covered += inside ? 1 : 0;
        ASSERT_TRUE(!inside || touched.holds(line));
      }
  }
  EXPECT_GT(covered, 1000);
}

// Quarters of a pixel.
struct Point {
  std::int64_t x, y;
};

// >= 0 on the left of the way from p to q with y down; in sixteenths.
LinearWords edge_through(Point p, Point q, std::int64_t sign, unsigned bits) {
  const std::int64_t a = sign * (p.y - q.y);
  const std::int64_t b = sign * (q.x - p.x);
  const std::int64_t c = -(a * p.x + b * p.y);
  return of_integers(4 * a, 4 * b, c - 4 * b, bits);
}

// The interval is that of the triangle's corners, cut by the screen.
TEST(LineEvaluator, TouchedLinesOfATriangleAreThoseOfItsCorners) {
  std::mt19937 random(14);
  constexpr std::int64_t kSide = 200;
  for (int i = 0; i < 20000; ++i) {
    std::array<Point, 3> corner{};
    for (Point& point : corner)
      point = {static_cast<std::int64_t>(random() % (4 * kSide - 3)), static_cast<std::int64_t>(random() % 1600) - 400};
    if (i % 4 == 0) corner[1].y = corner[2].y = corner[0].y + static_cast<std::int64_t>(random() % 5) - 2;
    const std::int64_t area = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                              (corner[2].x - corner[0].x) * (corner[1].y - corner[0].y);
    if (area == 0) continue;
    const std::int64_t top = std::min({corner[0].y, corner[1].y, corner[2].y});
    const std::int64_t bottom = std::max({corner[0].y, corner[1].y, corner[2].y});
    const std::int64_t first = std::max<std::int64_t>(ceil_div(top, 4), 0);
    const std::int64_t end = std::min<std::int64_t>(floor_div(bottom, 4) + 1, kSide);
    // 32-bit words have products of more than 64 bits.
    for (const unsigned bits : {24U, 32U}) {
      std::array<LinearWords, 3> edges{};
      for (std::size_t edge = 0; edge < 3; ++edge)
        edges[edge] = edge_through(corner[edge], corner[(edge + 1) % 3], area > 0 ? 1 : -1, bits);
      const Interval touched = touched_lines(edges, WordFormat(bits), kSide, kSide);
      if (first >= end) {
        ASSERT_TRUE(touched.empty());
      } else {
        ASSERT_EQ(touched.begin, first);
        ASSERT_EQ(touched.end, end);
      }
    }
  }
}

}  // namespace
}  // namespace rastertlm::object_processor
