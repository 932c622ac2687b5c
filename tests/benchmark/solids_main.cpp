// Times lines of quadric boards, from the copy of their words to the pixels of the decision unit, beside a plain loop
// that draws the same: see README.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "modules/object_processor/line_composer.h"
#include "modules/quadric_processor/quadric_board.h"
#include "modules/set_up/quadric_set_up.h"
#include "src/geometry/projection.h"
#include "src/geometry/quadric.h"
#include "tests/benchmark/measuring.h"
#include "tests/benchmark/plain_solids.inc"

namespace plain_solids {
namespace baseline {
std::unique_ptr<Loop> make(const Format& format);
}
namespace avx2 {
std::unique_ptr<Loop> make(const Format& format);
}
namespace avx512 {
std::unique_ptr<Loop> make(const Format& format);
}
}  // namespace plain_solids

namespace rastertlm::benchmark {
namespace {

using quadric_processor::PlaneWords;
using quadric_processor::QuadricWords;

constexpr std::size_t kColumns = 512;
constexpr std::size_t kLines = 512;
constexpr std::size_t kBoards = 8;

set_up::QuadricFormat format_of_machine() {
  set_up::QuadricFormat format;
  format.words.columns = kColumns;
  format.words.lines = kLines;
  return format;
}

// Spheres, and cylinders with both ends cut, in random places of a box that the screen shows; some leave it at its
// borders. `radius` in pixels.
std::vector<QuadricWords> random_solids(std::size_t count, double radius, bool cylinders) {
  const set_up::QuadricFormat format = format_of_machine();
  const glm::dmat4 projection = glm::orthoRH_ZO(-256.0, 256.0, -256.0, 256.0, 1.0, 513.0);
  const glm::dmat4 back = glm::inverse(geometry::eye_to_screen(projection, {kColumns, kLines}));
  std::mt19937_64 random(20261127);
  const auto real = [&random](double from, double to) {
    return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<QuadricWords> solids;
  while (solids.size() < count) {
    const bool cylinder = cylinders && solids.size() % 2 == 1;
    glm::dmat4 quadric(0.0);
    std::vector<glm::dvec4> planes;
    const glm::dvec3 centre(real(-240, 240), real(-240, 240), real(-450, -60));
    const glm::dvec3 axis = glm::normalize(glm::dvec3(real(-1, 1), real(-1, 1), real(-0.7, 0.7)));
    const double thick = cylinder ? radius / 3 : radius;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) quadric[k][i] = (i == k ? 1.0 : 0.0) - (cylinder ? axis[i] * axis[k] : 0.0);
    const glm::dvec3 linear = -(glm::dmat3(quadric) * centre);
    for (int i = 0; i < 3; ++i) quadric[3][i] = quadric[i][3] = linear[i];
    quadric[3][3] = -glm::dot(linear, centre) - thick * thick;
    if (cylinder)
      for (const double sign : {1.0, -1.0})
        planes.emplace_back(sign * axis, -sign * glm::dot(axis, centre) - 1.5 * radius);
    const auto made = set_up::set_up_quadric<double>(quadric, planes, 0, back, format);
    if (made.outcome == set_up::QuadricOutcome::drawn) solids.push_back(made.words);
  }
  return solids;
}

plain_solids::Plane plain_plane(const PlaneWords& words, unsigned bits) {
  const auto whole = [bits](std::uint64_t word) { return quadric_processor::sign_extended(word, bits); };
  return {whole(words.a), whole(words.b), whole(words.b) + whole(words.c)};
}

plain_solids::Solid plain_solid(const QuadricWords& words, const set_up::QuadricFormat& format) {
  const auto bits = static_cast<unsigned>(format.parameters.word_bits);
  const auto plane_bits = static_cast<unsigned>(format.parameters.plane_bits);
  const auto whole = [bits](std::uint64_t word) { return quadric_processor::sign_extended(word, bits); };
  const auto& d = words.discriminant;
  plain_solids::Solid solid;
  solid.value = whole(d.v0);
  solid.dy = whole(d.dy);
  solid.two_b = whole(d.two_b);
  solid.dx = whole(d.d0);
  solid.xy = whole(d.c);
  solid.two_a = whole(d.two_a);
  solid.middle = plain_plane(words.middle, plane_bits);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& e = words.normal[i];
    solid.normal[i] = plain_plane({e.a, e.b, e.c}, static_cast<unsigned>(format.words.word_bits));
    solid.factor[i] = words.normal_of_root[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (words.caps[i].keeps == quadric_processor::CapKeeps::everything) continue;
    solid.caps = static_cast<int>(i) + 1;
    solid.beyond[i] = words.caps[i].keeps == quadric_processor::CapKeeps::beyond;
    solid.cap[i] = plain_plane(words.caps[i].plane, plane_bits);
    for (std::size_t k = 0; k < 3; ++k)
      solid.cap_normal[i][k] =
          quadric_processor::sign_extended(words.caps[i].normal[k], static_cast<unsigned>(format.words.word_bits));
  }
  solid.root_shift = words.root_shift;
  return solid;
}

// Lines of all boards, as the simulation asks for them: eight at a time.
class Simulated {
 public:
  Simulated(const std::vector<QuadricWords>& solids, const set_up::QuadricFormat& format)
      : composer_(object_processor::ObjectProcessorParameters{}, kColumns, false) {
    const quadric_processor::QuadricScreen screen{
        kColumns, kLines, 24, {set_up::near_depth(format.words), set_up::far_depth(format.words)}};
    const std::size_t slots = (solids.size() + kBoards - 1) / kBoards;
    for (std::size_t k = 0; k < kBoards; ++k) {
      boards_.emplace_back(format.parameters, screen, static_cast<std::uint32_t>(slots),
                           static_cast<std::uint32_t>(k * slots));
      for (std::size_t i = k * slots; i < std::min(solids.size(), (k + 1) * slots); ++i)
        solids_.push_back({k, static_cast<std::uint32_t>(i - k * slots), solids[i]});
    }
    lines_.resize(kLines);
    for (frame::FragmentLine& line : lines_) line.resize(kColumns);
  }

  void frame() {
    for (const Placed& placed : solids_) boards_[placed.board].write(placed.slot, placed.words);
    for (auto& board : boards_) board.copy();
    for (std::uint32_t first = 0; first < kLines; first += object_processor::kBandLines) {
      for (std::size_t k = 0; k < kBoards; ++k)
        boards_[k].cover_lines(first, object_processor::kBandLines, 1, covered_[k]);
      for (std::uint32_t line = 0; line < object_processor::kBandLines; ++line) {
        const frame::CoveredLine* all[kBoards];
        for (std::size_t k = 0; k < kBoards; ++k) all[k] = covered_[k][line];
        composer_.compose(all, first + line, lines_[first + line]);
      }
    }
  }

  std::uint64_t different(const plain_solids::Picture& picture) const {
    std::uint64_t count = 0;
    for (std::size_t y = 0; y < kLines; ++y)
      for (std::size_t x = 0; x < kColumns; ++x) {
        const frame::FragmentLine& line = lines_[y];
        const std::size_t pixel = y * kColumns + x;
        const std::uint32_t object = line.empty() ? 0 : line.object[x];
        const bool same_normal = object == 0 || (line.normal_x[x] == picture.normal[0][pixel] &&
                                                 line.normal_y[x] == picture.normal[1][pixel] &&
                                                 line.normal_z[x] == picture.normal[2][pixel]);
        count += object != picture.object[pixel] || !same_normal ? 1 : 0;
      }
    return count;
  }
  std::uint64_t covered() const {
    std::uint64_t pixels = 0;
    for (const auto& board : boards_) pixels += board.counters().fragments_in;
    return pixels;
  }

 private:
  struct Placed {
    std::size_t board;
    std::uint32_t slot;
    QuadricWords words;
  };
  object_processor::LineComposer composer_;
  std::vector<quadric_processor::QuadricBoard> boards_;
  std::vector<Placed> solids_;
  std::vector<frame::FragmentLine> lines_;
  const frame::CoveredLine* covered_[kBoards][object_processor::kBandLines] = {};
};

std::unique_ptr<plain_solids::Loop> plain_loop(const plain_solids::Format& format) {
  switch (vector_variant()) {
    case VectorVariant::avx512:
      return plain_solids::avx512::make(format);
    case VectorVariant::avx2:
      return plain_solids::avx2::make(format);
    default:
      return plain_solids::baseline::make(format);
  }
}

// False where the pictures differ.
bool measure(std::size_t count, double radius, bool cylinders, std::size_t pairs) {
  const set_up::QuadricFormat format = format_of_machine();
  const std::vector<QuadricWords> solids = random_solids(count, radius, cylinders);
  std::vector<plain_solids::Solid> plain;
  plain.reserve(solids.size());
  for (const QuadricWords& words : solids) plain.push_back(plain_solid(words, format));
  const auto loop =
      plain_loop({kColumns, kLines, 12, 16, 24, 12, set_up::near_depth(format.words), set_up::far_depth(format.words)});
  Simulated simulated(solids, format);
  plain_solids::Picture picture;
  std::vector<double> machine_times, plain_times;
  for (std::size_t pair = 0; pair < pairs + 2; ++pair) {
    const double start = worked();
    simulated.frame();
    const double between = worked();
    loop->frame(plain, picture);
    const double end = worked();
    if (pair < 2) continue;  // first touches memory
    machine_times.push_back(between - start);
    plain_times.push_back(end - between);
  }
  const std::uint64_t different = simulated.different(picture);
  const auto covered = static_cast<double>(picture.covered);
  const bool same_count = simulated.covered() == picture.covered * (pairs + 2);
  const double machine = median(machine_times), loop_time = median(plain_times);
  fmt::print("{:>6} {:<22} {:>8} | {:>9.3f} {:>9.3f} {:>6.3f} | {:>6.2f} {:>6.2f}\n", count,
             cylinders ? "spheres and cylinders" : "spheres", picture.covered, machine * 1e-6, loop_time * 1e-6,
             machine / loop_time, machine / covered, loop_time / covered);
  if (different != 0 || !same_count) fmt::print(stderr, "{} pixels differ\n", different);
  return different == 0 && same_count;
}

}  // namespace
}  // namespace rastertlm::benchmark

int main(int argc, char** argv) {
  using rastertlm::benchmark::measure;
  std::size_t pairs = 30;
  if (argc == 3 && std::string(argv[1]) == "--pairs") pairs = std::strtoul(argv[2], nullptr, 10);
  if (pairs == 0 || (argc != 1 && argc != 3)) {
    fmt::print(stderr, "benchmark_solids [--pairs N]: frames timed of each (30)\n");
    return 2;
  }
  fmt::print("Medians of {} interleaved pairs.\n{:>6} {:<22} {:>8} | {:>9} {:>9} {:>6} | {:>6} {:>6}\n", pairs,
             "solids", "", "covered", "boards ms", "plain ms", "ratio", "ns/cov", "plain");
  bool good = measure(8, 120.0, false, pairs);
  good = measure(64, 48.0, false, pairs) && good;
  good = measure(512, 16.0, false, pairs) && good;
  good = measure(64, 48.0, true, pairs) && good;
  good = measure(512, 16.0, true, pairs) && good;
  return good ? 0 : 1;
}
