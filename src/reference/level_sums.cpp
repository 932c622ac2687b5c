#include "src/reference/level_sums.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "src/reference/level_kernels.h"

namespace rastertlm::reference {
namespace {

using frame::kRegions;

constexpr std::uint32_t kCompared = kInShown | kInExact;
static_assert(kLevelGroup == frame::ExactLevels::kGroup);
static_assert(sizeof(frame::Region) == 1 && kRegions == kInShown, "a pixel's kind holds its region in two bits");

// Takes what the kernels sum into `regions`.
class Sums {
 public:
  void add(const LevelPlanes& planes) {
    std::array<KindSums, kPixelKinds> sums{};
    kernels_.add(planes, sums.data());
    for (std::uint32_t kind = 0; kind < kPixelKinds; ++kind) take(kind, sums[kind], regions[kind % kRegions]);
  }

  std::array<LevelSums, kRegions> regions;

 private:
  static void take(std::uint32_t kind, const KindSums& from, LevelSums& sums) {
    if ((kind & kCompared) == 0) return;
    const std::uint64_t squares = std::accumulate(std::begin(from.squares), std::end(from.squares), std::uint64_t{0});
    if ((kind & kCompared) != kCompared) {
      ((kind & kInShown) != 0 ? sums.extra : sums.missing) += from.pixels;
      sums.outline_squares += squares;
      return;
    }
    const float largest_square = *std::max_element(std::begin(from.largest_square), std::end(from.largest_square));
    const int largest = static_cast<int>(std::sqrt(largest_square));  // exact of squares
    sums.compared += from.pixels;
    sums.squares += squares;
    sums.over_one += from.over_one;
    sums.over_two += from.over_two;
    sums.largest = std::max(sums.largest, largest);
    for (const double one : from.unrounded_squares) sums.unrounded_squares += one;
    if ((kind & kSameObject) != 0)
      sums.largest_same_object = std::max(sums.largest_same_object, largest);
    else
      sums.wrong_object += from.pixels;
  }

  const LevelKernels& kernels_ = level_kernels(vector_variant());
};

// The pixels behind the last whole group: as a group whose others nothing covers.
void add_rest(const frame::Frame& shown, const frame::ExactFrame& exact, Sums& sums) {
  const std::size_t count = exact.pixels() % kLevelGroup;
  if (count == 0) return;
  const std::size_t first = exact.pixels() - count;
  std::array<std::uint32_t, kLevelGroup> shown_object{}, exact_object{};
  std::array<std::uint8_t, kLevelGroup> region{};
  std::array<std::uint8_t, 3 * kLevelGroup> levels{};
  std::copy_n(shown.object.data() + first, count, shown_object.data());
  std::copy_n(exact.object.data() + first, count, exact_object.data());
  std::transform(exact.region.data() + first, exact.region.data() + exact.pixels(), region.data(),
                 [](frame::Region one) { return static_cast<std::uint8_t>(one); });
  std::copy_n(shown.rgb.data() + 3 * first, 3 * count, levels.data());
  sums.add({1, shown_object.data(), exact_object.data(), region.data(), levels.data(),
            exact.rgb.rounded_planes().data() + 3 * first, exact.rgb.residual_planes().data() + 3 * first});
}

}  // namespace

LevelSums& LevelSums::operator+=(const LevelSums& other) {
  compared += other.compared;
  missing += other.missing;
  extra += other.extra;
  wrong_object += other.wrong_object;
  squares += other.squares;
  outline_squares += other.outline_squares;
  unrounded_squares += other.unrounded_squares;
  over_one += other.over_one;
  over_two += other.over_two;
  largest = std::max(largest, other.largest);
  largest_same_object = std::max(largest_same_object, other.largest_same_object);
  return *this;
}

LevelComparison compare_frames(const frame::Frame& shown, const frame::ExactFrame& exact) {
  if (shown.columns != exact.columns || shown.lines != exact.lines)
    throw std::invalid_argument("pictures of different sizes are compared");
  Sums sums;
  const std::size_t groups = exact.pixels() / kLevelGroup;
  for (std::size_t group = 0; group < groups; group += kMostGroups) {
    const std::size_t pixel = group * kLevelGroup;
    sums.add({std::min(kMostGroups, groups - group), shown.object.data() + pixel, exact.object.data() + pixel,
              reinterpret_cast<const std::uint8_t*>(exact.region.data() + pixel), shown.rgb.data() + 3 * pixel,
              exact.rgb.rounded_planes().data() + 3 * pixel, exact.rgb.residual_planes().data() + 3 * pixel});
  }
  add_rest(shown, exact, sums);
  return {sums.regions};
}

std::vector<std::size_t> wrong_objects(const frame::Frame& shown, const frame::ExactFrame& exact) {
  std::vector<std::size_t> pixels;
  for (std::size_t pixel = 0; pixel < exact.pixels(); ++pixel) {
    const std::uint32_t object = shown.object[pixel];
    if (object != exact.object[pixel] && object != 0 && exact.object[pixel] != 0) pixels.push_back(pixel);
  }
  return pixels;
}

}  // namespace rastertlm::reference
