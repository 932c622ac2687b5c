#include "src/cli/usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "src/base/errors.h"
#include "src/reference/flip.h"

namespace rastertlm::cli {
namespace {

constexpr std::uint64_t kMostFrames = 1'000'000;

// Whether all of the text is a number of that type.
template <class T>
bool reads_as(const std::string& text, T& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

// 1 and 0 where the text is not two whole numbers and what stands between them.
std::pair<std::uint64_t, std::uint64_t> two_numbers(const std::string& text, char between) {
  const std::size_t at = std::min(text.find(between), text.size());
  std::pair<std::uint64_t, std::uint64_t> numbers{1, 0};
  const bool reads =
      at < text.size() && reads_as(text.substr(0, at), numbers.first) && reads_as(text.substr(at + 1), numbers.second);
  return reads ? numbers : std::pair<std::uint64_t, std::uint64_t>{1, 0};
}

}  // namespace

std::string unknown_word(const std::string& kind, const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  if (!nearest.empty()) return fmt::format("unknown {} '{}'; did you mean '{}'?", kind, word, nearest);
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
  return fmt::format("unknown {} '{}'; known: {}", kind, word, list);
}

std::string left_over(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> options;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += '\n';
    if (word.size() > 1 && word.front() == '-')
      text += unknown_word("option", word.substr(0, word.find('=')), options);
    else
      text += fmt::format("'{}' is one argument too many", word);
  }
  return text;
}

std::string finite_and_positive(const std::string& text) {
  double number = 0.0;
  if (reads_as(text, number) && std::isfinite(number) && number > 0.0) return {};
  return fmt::format("'{}' is not a number above 0", text);
}

std::string part_of_one(const std::string& text) {
  double number = 0.0;
  if (reads_as(text, number) && number >= 0.0 && number <= 1.0) return {};  // not a number is neither
  return fmt::format("'{}' is not a number from 0 to 1", text);
}

std::string whole_up_to(const std::string& text, std::uint64_t most) {
  std::uint64_t number = 0;
  if (reads_as(text, number) && number >= 1 && number <= most) return {};
  return fmt::format("'{}' is not a whole number from 1 to {}", text, most);
}

std::string whole_from_one(const std::string& text) { return whole_up_to(text, kMostFrames); }

std::string frame_number(const std::string& text) {
  std::uint64_t number = 0;
  if (reads_as(text, number) && number < kMostFrames) return {};
  return fmt::format("'{}' is not a whole number from 0 to {}", text, kMostFrames - 1);
}

std::string field_number(const std::string& text) {
  return text == "0" || text == "1" ? "" : fmt::format("'{}' is neither 0, the even lines, nor 1, the odd ones", text);
}

std::pair<std::uint64_t, std::uint64_t> range_of(const std::string& text) { return two_numbers(text, '-'); }
std::pair<std::uint64_t, std::uint64_t> share_of(const std::string& text) { return two_numbers(text, '/'); }

std::string whole_range(const std::string& text) {
  const auto [first, last] = range_of(text);
  if (first <= last) return {};
  return fmt::format("'{}' is not FROM-TO, two whole numbers of which the first is not above the second", text);
}

std::pair<std::uint64_t, std::uint64_t> dotted_range_of(const std::string& text) {
  const std::size_t dots = text.find("..");
  const std::string last = dots == std::string::npos ? text : text.substr(dots + 2);
  std::pair<std::uint64_t, std::uint64_t> range{1, 0};
  const bool reads = reads_as(text.substr(0, dots), range.first) && reads_as(last, range.second);
  return reads ? range : std::pair<std::uint64_t, std::uint64_t>{1, 0};
}

std::string dotted_range(const std::string& text) {
  const auto [first, last] = dotted_range_of(text);
  if (first <= last) return {};
  return fmt::format("'{}' is not A..B, two whole numbers of which the first is not above the second, nor one number",
                     text);
}

std::string pixels_a_degree(const std::string& text) {
  double number = 0.0;
  if (reads_as(text, number) && number >= reference::kLeastPixelsPerDegree && number <= reference::kMostPixelsPerDegree)
    return {};
  return fmt::format("'{}' is not a number from {:.6g} to {:.6g}", text, reference::kLeastPixelsPerDegree,
                     reference::kMostPixelsPerDegree);
}

std::string not_empty(const std::string& text) { return text.empty() ? "it is empty" : ""; }

}  // namespace rastertlm::cli
