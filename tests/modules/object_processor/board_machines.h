// Boards of random triangles, some of whose words wrap, and what their processors show when each is stepped through the
// whole frame.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "modules/object_processor/elementary_processor.h"
#include "modules/object_processor/object_board.h"

namespace rastertlm::object_processor {

struct Machine {
  ObjectProcessorParameters parameters;
  std::uint32_t first_processor = 0;
  std::uint32_t columns = 1;
  std::uint32_t lines = 1;
  std::vector<TriangleWords> triangles;  // one a slot
};

struct Pixel {
  std::uint32_t depth = 0;
  std::array<std::uint32_t, 3> normal{};
  std::uint32_t material = 0;
  std::uint32_t object = 0;
  std::uint32_t coverage = 0;
};

// Every elementary processor stepped through the whole frame; every processor looked at on every pixel, in the order of
// numbers.
inline std::vector<Pixel> stepped_picture(const Machine& machine) {
  const auto bits = static_cast<unsigned>(machine.parameters.word_bits);
  const unsigned slices = machine.parameters.slices();
  std::vector<Pixel> picture(std::size_t{machine.columns} * machine.lines);
  for (Pixel& pixel : picture) pixel.depth = static_cast<std::uint32_t>(low_mask(bits));
  for (std::uint32_t slot = 0; slot < machine.triangles.size(); ++slot) {
    const ProcessorWords words = to_words(machine.triangles[slot]);
    std::vector<ElementaryProcessor> processors(kElementaryProcessors, ElementaryProcessor(machine.parameters));
    for (std::size_t index = 0; index < kCoefficients; ++index)
      processors[index / 3].write_loading(static_cast<unsigned>(index % 3), words[index]);
    for (auto& processor : processors) processor.run(frame_start_program());
    for (std::uint32_t line = 0; line < machine.lines; ++line) {
      for (auto& processor : processors) processor.run(line_start_program(slices));
      for (std::uint32_t column = 0; column < machine.columns; ++column) {
        Pixel& pixel = picture[std::size_t{line} * machine.columns + column];
        const auto negative = [&](std::size_t edge) { return (processors[edge].output() >> (bits - 1)) != 0; };
        if (!negative(0) && !negative(1) && !negative(2)) {
          ++pixel.coverage;
          const std::uint32_t depth = processors[kDepth].output();
          if (depth < pixel.depth)
            pixel = {depth,
                     {processors[4].output(), processors[5].output(), processors[6].output()},
                     machine.triangles[slot].material,
                     machine.first_processor + slot + 1,
                     pixel.coverage};
        }
        for (auto& processor : processors) processor.step(pixel_instruction(slices));
      }
    }
  }
  return picture;
}

inline ObjectBoard loaded_board(const Machine& machine, Visit visit = Visit::needed,
                                VectorVariant variant = vector_variant()) {
  ObjectBoard board(machine.parameters, static_cast<std::uint32_t>(machine.triangles.size()), machine.first_processor,
                    machine.columns, machine.lines, visit, variant);
  for (std::uint32_t slot = 0; slot < machine.triangles.size(); ++slot) board.write(slot, machine.triangles[slot]);
  board.copy();
  return board;
}

inline void compare_line(const Machine& machine, const std::vector<Pixel>& picture, std::uint32_t line,
                         const frame::FragmentLine& out) {
  const Prenormaliser prenormalise(machine.parameters);
  for (std::uint32_t column = 0; column < machine.columns; ++column) {
    const Pixel& wanted = picture[std::size_t{line} * machine.columns + column];
    if (column < out.begin || column >= out.end) {
      RC_ASSERT(wanted.coverage == 0U);
      continue;
    }
    RC_ASSERT(out.depth[column] == wanted.depth);
    RC_ASSERT(out.object[column] == wanted.object);
    RC_ASSERT(out.coverage[column] == wanted.coverage);
    if (wanted.object == 0) continue;
    const LinkNormal normal = prenormalise(wanted.normal);
    RC_ASSERT(out.normal_x[column] == normal[0]);
    RC_ASSERT(out.normal_y[column] == normal[1]);
    RC_ASSERT(out.normal_z[column] == normal[2]);
    RC_ASSERT(out.material[column] == wanted.material);
  }
}

class Source {
 public:
  explicit Source(std::uint32_t seed) : random_(seed) {}
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_()) % limit; }
  std::int64_t within(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint32_t>(high - low + 1)));
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(random_()); }

  // A triangle through three points near the screen; with `stretch` bits of scale that make its words wrap or not.
  std::array<LinearWords, 3> edges(const Machine& machine) {
    std::array<std::array<std::int64_t, 2>, 3> p{};
    for (auto& point : p)
      point = {within(-10, machine.columns + 10), within(-10, static_cast<std::int64_t>(machine.lines) + 10)};
    const std::int64_t area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    const std::int64_t scale = (area < 0 ? -1 : 1) * (std::int64_t{1} << below(12));
    std::array<LinearWords, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = p[i];
      const auto& to = p[(i + 1) % 3];
      const std::int64_t a = scale * (from[1] - to[1]);
      const std::int64_t b = scale * (to[0] - from[0]);
      result[i] = linear(a, b, -(a * from[0] + b * from[1]) - b);
    }
    return result;
  }
  static LinearWords linear(std::int64_t a, std::int64_t b, std::int64_t c) {
    return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
  }

  TriangleWords triangle(const Machine& machine) {
    const auto bits = static_cast<unsigned>(machine.parameters.word_bits);
    if (below(8) == 0) return parked_triangle(bits);
    TriangleWords result;
    result.edges = edges(machine);
    if (below(4) == 0)
      for (LinearWords& edge : result.edges)
        if (below(2) == 0) edge = {word(), word(), word()};
    // Few depths, so that ties are frequent; some planes slope and wrap.
    result.depth = {0, 0, below(4) << (bits - 3)};
    if (below(3) == 0) result.depth = {word(), word(), word()};
    if (below(9) == 0) result.depth = {0, 0, static_cast<std::uint32_t>(low_mask(bits))};
    if (below(3) == 0) result.depth.a = 1;
    for (LinearWords& normal : result.normals) normal = {word() >> below(32), word() >> below(32), word() >> below(32)};
    result.material = below(16);
    return result;
  }

  Machine machine(CarryClock clock) {
    struct Widths {
      std::int64_t word, slice, normal;
    };
    constexpr Widths kWidths[] = {{24, 12, 12}, {24, 24, 12}, {24, 8, 12}, {16, 4, 9}, {32, 16, 16}, {28, 14, 12}};
    const Widths widths = kWidths[below(6)];
    Machine machine;
    machine.parameters.word_bits = widths.word;
    machine.parameters.slice_bits = widths.slice;
    machine.parameters.normal_bits = widths.normal;
    machine.parameters.carry_clock = clock;
    machine.first_processor = below(1000);
    machine.columns = 1 + below(40);
    machine.lines = 1 + below(24);
    const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(widths.word)));
    machine.triangles.resize(1 + below(12));
    for (TriangleWords& slot : machine.triangles) {
      ProcessorWords words = to_words(triangle(machine));
      for (std::size_t index = 0; index < kCoefficients; ++index) words[index] &= mask;
      slot = to_triangle(words);
    }
    return machine;
  }

 private:
  std::mt19937 random_;
};

}  // namespace rastertlm::object_processor
