#include "src/report/number_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>

namespace rastertlm::report {
namespace {

constexpr double kExactIntegers = 9007199254740992.0;  // 2^53
constexpr int kStoredDigits = 9;

bool is_exact_integer(double value) { return std::abs(value) < kExactIntegers && std::floor(value) == value; }

// Four significant digits without an exponent where that is short, and all digits before the point.
std::string short_text(double value) {
  const double rounded =
      std::abs(value) >= 1000.0 && std::abs(value) < 1e9 ? std::round(value) : to_significant(value, 4);
  if (rounded != 0.0 && (std::abs(rounded) < 1e-4 || std::abs(rounded) >= 1e9)) return fmt::format("{:.3e}", value);
  if (std::abs(rounded) >= 1000.0)
    return fmt::format("{}{}", rounded < 0.0 ? "-" : "", grouped(static_cast<std::uint64_t>(std::abs(rounded))));
  return fmt::format("{:.4g}", rounded);
}

std::string scaled(double value, const std::string& unit) {
  static constexpr std::array<const char*, 4> kPrefixes{"", "k", "M", "G"};
  std::size_t prefix = 0;
  while (std::abs(value) >= 1000.0 && prefix + 1 < kPrefixes.size()) {
    value /= 1000.0;
    ++prefix;
  }
  return fmt::format("{:.4g} {}{}", value, kPrefixes[prefix], unit);
}

}  // namespace

double to_significant(double value, int digits) {
  if (!std::isfinite(value) || value == 0.0) return value;
  // fmt prints and strtod reads the nearest, whatever the locale's decimal point: there is none before the exponent.
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t exponent = text.find('e');
  std::string mantissa = text.substr(0, exponent);
  int power = std::atoi(text.c_str() + exponent + 1);
  const std::size_t point = mantissa.find('.');
  if (point != std::string::npos) {
    power -= static_cast<int>(mantissa.size() - point - 1);
    mantissa.erase(point, 1);
  }
  return std::strtod(fmt::format("{}e{}", mantissa, power).c_str(), nullptr);
}

double to_stored(double value) { return is_exact_integer(value) ? value : to_significant(value, kStoredDigits); }

std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

std::string quantity(double value) {
  if (!std::isfinite(value)) return "unlimited";
  if (is_exact_integer(value)) {
    return fmt::format("{}{}", value < 0.0 ? "-" : "", grouped(static_cast<std::uint64_t>(std::abs(value))));
  }
  return short_text(value);
}

std::string percent(double fraction) {
  if (!std::isfinite(fraction)) return "unlimited";
  const double value = 100.0 * fraction;
  if (std::abs(value) >= 1000.0) return short_text(value) + " %";
  if (std::abs(value) >= 10.0) return fmt::format("{:.0f} %", value);
  return fmt::format("{:.2g} %", value);
}

std::string rate(double hz) { return fmt::format("{:.4g}", hz); }
std::string frequency(double hz) { return scaled(hz, "Hz"); }
std::string bytes_per_second(double value) { return scaled(value, "B/s"); }

std::string bits(std::uint64_t count) {
  constexpr double kKibi = 1024.0;
  const auto value = static_cast<double>(count);
  if (value < 8.0 * kKibi) return grouped(count) + " bits";
  if (value < kKibi * kKibi) return fmt::format("{:.4g} Kibit", value / kKibi);
  return fmt::format("{:.4g} Mibit", value / (kKibi * kKibi));
}

std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural) {
  return grouped(count) + ' ' + (count == 1 ? singular : plural);
}

}  // namespace rastertlm::report
