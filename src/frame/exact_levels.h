// The levels of an exact picture: in double, and split into what comparisons with displayed levels read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rastertlm::frame {

// Display values 0..255 before rounding, 3 a pixel. A picture is compared more often than it is made: with each level
// it keeps floor(level + 1/2), and the residual that is left of it, -1/2..1/2, in float, within 2^-26 of a level. Both
// can only be set together with the level.
class ExactLevels {
 public:
  // Of so many pixels from a multiple of it on, planes hold the reds, then the greens, then the blues.
  static constexpr std::size_t kGroup = 16;

  // All levels 0.
  void resize(std::size_t pixels) {
    levels_.assign(3 * pixels, 0.0);
    rounded_.assign(3 * kGroup * groups(), 0);
    residual_.assign(3 * kGroup * groups(), 0.0F);
  }
  void set(std::size_t i, double level) {
    levels_[i] = level;
    split(i, place(i));
  }
  // 3 a pixel, of as many pixels as there are.
  void assign(std::vector<double> levels) {
    levels_ = std::move(levels);
    rounded_.resize(3 * kGroup * groups());
    residual_.resize(3 * kGroup * groups());
    const std::size_t whole = levels_.size() / (3 * kGroup) * (3 * kGroup);
    for (std::size_t first = 0; first < whole; first += 3 * kGroup) split_group(first);
    for (std::size_t i = whole; i < levels_.size(); ++i) split(i, place(i));
  }
  // Of another picture of the same size, the pixels first .. first + count - 1.
  void copy(const ExactLevels& from, std::size_t first, std::size_t count) {
    const auto copy_planes = [&](const auto& source, auto& target) {
      std::copy_n(source.data() + 3 * first, 3 * count, target.data() + 3 * first);
    };
    if (first % kGroup == 0 && count % kGroup == 0) {
      copy_planes(from.levels_, levels_);
      copy_planes(from.rounded_, rounded_);
      copy_planes(from.residual_, residual_);
    } else {
      for (std::size_t i = 3 * first; i < 3 * (first + count); ++i) set(i, from[i]);
    }
  }

  std::size_t size() const { return levels_.size(); }
  const double& operator[](std::size_t i) const { return levels_[i]; }
  auto begin() const { return levels_.begin(); }
  auto end() const { return levels_.end(); }
  const std::vector<double>& values() const { return levels_; }
  std::uint8_t rounded(std::size_t i) const { return rounded_[place(i)]; }

  // In groups of kGroup pixels; the last is filled up with anything.
  const std::vector<std::uint8_t>& rounded_planes() const { return rounded_; }
  const std::vector<float>& residual_planes() const { return residual_; }

 private:
  std::size_t groups() const { return (levels_.size() / 3 + kGroup - 1) / kGroup; }
  static std::size_t place(std::size_t i) {
    const std::size_t pixel = i / 3;
    return 3 * kGroup * (pixel / kGroup) + kGroup * (i % 3) + pixel % kGroup;
  }
  // None is negative; half a level goes up.
  static std::int32_t nearest(double level) {
    const double half_more = level + 0.5;
    return static_cast<std::int32_t>(half_more);
  }
  void split(std::size_t i, std::size_t at) {
    const std::int32_t rounded = nearest(levels_[i]);
    rounded_[at] = static_cast<std::uint8_t>(rounded);
    residual_[at] = static_cast<float>(levels_[i] - rounded);
  }
  // The same of a whole group, by loops that become vectors.
  void split_group(std::size_t first) {
    const double* levels = levels_.data() + first;
    std::int32_t rounded[3 * kGroup];
    float residual[3 * kGroup];
    for (std::size_t i = 0; i < 3 * kGroup; ++i) rounded[i] = nearest(levels[i]);
    for (std::size_t i = 0; i < 3 * kGroup; ++i) residual[i] = static_cast<float>(levels[i] - rounded[i]);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t pixel = 0; pixel < kGroup; ++pixel) {
        rounded_[first + kGroup * c + pixel] = static_cast<std::uint8_t>(rounded[3 * pixel + c]);
        residual_[first + kGroup * c + pixel] = residual[3 * pixel + c];
      }
  }

  std::vector<double> levels_;
  std::vector<std::uint8_t> rounded_;
  std::vector<float> residual_;
};

}  // namespace rastertlm::frame
