#include "src/explore/axis_order.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace rastertlm::explore {

std::optional<double> number_of(const std::string& value) {
  std::string digits = value;
  std::erase(digits, '_');
  if (digits.starts_with('+')) digits.erase(0, 1);
  double number = 0.0;
  const char* const end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, number);
  if (error != std::errc{} || rest != end || !std::isfinite(number)) return {};
  return number;
}

std::optional<std::vector<double>> numbers_of(const Axis& axis) {
  std::vector<double> numbers;
  numbers.reserve(axis.values.size());
  for (const std::string& value : axis.values) {
    const std::optional<double> number = number_of(value);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<std::size_t> one_step_from(const Axis& axis, std::size_t value) {
  std::vector<std::size_t> steps;
  const auto numbers = numbers_of(axis);
  if (!numbers) {
    for (std::size_t other = 0; other < axis.values.size(); ++other)
      if (other != value) steps.push_back(other);
    return steps;
  }
  std::optional<std::size_t> below;
  std::optional<std::size_t> above;
  const double own = numbers->at(value);
  for (std::size_t other = 0; other < numbers->size(); ++other) {
    const double number = (*numbers)[other];
    if (number < own && (!below || number > (*numbers)[*below])) below = other;
    if (number > own && (!above || number < (*numbers)[*above])) above = other;
  }
  if (below) steps.push_back(*below);
  if (above) steps.push_back(*above);
  return steps;
}

}  // namespace rastertlm::explore
