#include "src/report/figure_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "src/base/errors.h"
#include "src/report/json_value.h"
#include "src/report/statistics.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostNamed = 40;  // elements, in a message
constexpr const char* kOwnUnit = "as unit says";
constexpr std::array<const char*, 2> kNames{"name", "reference"};  // keys that elements are named by

enum class Fold { none, sum, mean, min, max };

struct FoldName {
  const char* name;
  Fold fold;
};
constexpr std::array<FoldName, 4> kFolds{
    {{"sum", Fold::sum}, {"mean", Fold::mean}, {"min", Fold::min}, {"max", Fold::max}}};

// "budgets[line_start]": a key, and which elements of its list.
struct Step {
  std::string key;
  bool selects = false;
  std::string selector;  // "": all
};

struct Path {
  Fold fold = Fold::none;
  std::vector<Step> steps;
};

// The end of a key or selector that begins at `begin`: brackets hold dots, and names hold brackets in pairs.
std::size_t end_of_selector(const std::string& text, std::size_t begin) {
  int depth = 0;
  for (std::size_t at = begin; at < text.size(); ++at) {
    if (text[at] == '[') ++depth;
    if (text[at] == ']' && --depth == 0) return at;
  }
  return std::string::npos;
}

// Nothing where the text is not of the form of a path.
std::optional<std::vector<Step>> steps_of(const std::string& text) {
  std::vector<Step> steps;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find_first_of(".[", at), text.size());
    Step step{text.substr(at, end - at), false, ""};
    at = end;
    if (at < text.size() && text[at] == '[') {
      const std::size_t close = end_of_selector(text, at);
      if (close == std::string::npos) return std::nullopt;
      step.selects = true;
      step.selector = text.substr(at + 1, close - at - 1);
      at = close + 1;
    }
    if (step.key.empty()) return std::nullopt;
    steps.push_back(std::move(step));
    if (at == text.size()) return steps;
    if (text[at] != '.') return std::nullopt;
    ++at;
  }
}

std::optional<Path> path_of(const std::string& text) {
  Path path;
  std::string inside = text;
  const std::size_t open = text.find('(');
  if (open != std::string::npos && open < text.find('[') && text.back() == ')') {
    const std::string name = text.substr(0, open);
    const auto* found = std::find_if(kFolds.begin(), kFolds.end(), [&](const FoldName& f) { return name == f.name; });
    if (found == kFolds.end()) return std::nullopt;
    path.fold = found->fold;
    inside = text.substr(open + 1, text.size() - open - 2);
  }
  std::optional<std::vector<Step>> steps = steps_of(inside);
  if (!steps) return std::nullopt;
  path.steps = std::move(*steps);
  return path;
}

// As the list of all figures has it: "budgets[].used".
std::string name_of(const Path& path) {
  std::string name;
  for (const Step& step : path.steps)
    name += fmt::format("{}{}{}", name.empty() ? "" : ".", step.key, step.selects ? "[]" : "");
  return name;
}

const std::vector<parameter::Statistic>& known_figures() {
  static const std::vector<parameter::Statistic> figures = statistics();
  return figures;
}

using parameter::StatisticValue;

StatisticValue type_of(const std::string& name) {
  for (const parameter::Statistic& figure : known_figures())
    if (figure.name == name) return figure.value;
  return StatisticValue::number;
}

std::optional<std::size_t> index_of(const std::string& text) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(index) : std::nullopt;
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

bool is_named(const Json& element, const std::string& name) {
  return element.is_object() && std::any_of(kNames.begin(), kNames.end(), [&](const char* key) {
           return element.contains(key) && text_of(element[key]) == name;
         });
}

std::vector<const Json*> selected(const Json& list, const std::string& selector) {
  std::vector<const Json*> elements;
  const std::optional<std::size_t> index = index_of(selector);
  if (index) return *index < list.size() ? std::vector<const Json*>{&list[*index]} : elements;
  const std::size_t equals = selector.find('=');
  for (const Json& element : list) {
    bool wanted = selector.empty() || is_named(element, selector);
    if (!wanted && equals != std::string::npos && element.is_object()) {
      const std::string key = selector.substr(0, equals);
      wanted = element.contains(key) && text_of(element[key]) == selector.substr(equals + 1);
    }
    if (wanted) elements.push_back(&element);
  }
  return elements;
}

// The values that the path leads to, and the objects that they stand in.
struct Reached {
  const Json* value;
  const Json* parent;
};

// `missing`, if given, takes the first step that leads nowhere, and the value in which it does not.
struct Missing {
  const Step* step = nullptr;
  const Json* within = nullptr;
};

std::vector<Reached> reached(const Json& root, const Path& path, Missing* missing = nullptr) {
  std::vector<Reached> at{{&root, &root}};
  for (const Step& step : path.steps) {
    std::vector<Reached> next;
    Missing dead;
    for (const Reached& here : at) {
      const bool there = here.value->is_object() && here.value->contains(step.key);
      const Json* inside = there ? &(*here.value)[step.key] : nullptr;
      if (inside != nullptr && step.selects && inside->is_array()) {
        for (const Json* element : selected(*inside, step.selector)) next.push_back({element, here.value});
      } else if (inside != nullptr && !step.selects) {
        next.push_back({inside, here.value});
      }
      // A list without elements has them all, and null has every key.
      const bool empty = inside != nullptr && step.selects && step.selector.empty();
      if (!empty && !here.value->is_null()) dead = {&step, there && inside->is_array() ? inside : here.value};
    }
    if (missing != nullptr && missing->step == nullptr && next.empty()) *missing = dead;
    at = std::move(next);
  }
  return at;
}

std::optional<double> number(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  if (value.is_number()) return value.get<double>();
  return std::nullopt;
}

// JSON has no infinity, so the PSNR of pictures that do not differ is null there; where nothing was compared there is
// none.
bool is_infinite(const Reached& one, const std::string& key) {
  if (!one.value->is_null() || !key.starts_with("psnr") || !one.parent->is_object()) return false;
  double pixels = 0.0;
  for (const char* part : {"compared", "covered_missing", "covered_extra"}) {
    const bool counts = key != "psnr_db" || std::string_view(part) == "compared";
    if (counts && one.parent->contains(part)) pixels += number((*one.parent)[part]).value_or(0.0);
  }
  return pixels > 0.0;
}

std::optional<double> figure(const Reached& one, const std::string& key) {
  if (is_infinite(one, key)) return std::numeric_limits<double>::infinity();
  return number(*one.value);
}

std::optional<double> folded(Fold fold, const std::vector<Reached>& found, const std::string& key) {
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  std::size_t count = 0;
  for (const Reached& one : found) {
    const std::optional<double> value = figure(one, key);
    if (!value) {
      if (fold == Fold::sum || fold == Fold::mean) return std::nullopt;
      continue;
    }
    sum += *value;
    least = std::min(least, *value);
    most = std::max(most, *value);
    ++count;
  }
  if (count == 0) return fold == Fold::sum && found.empty() ? std::optional(0.0) : std::nullopt;
  switch (fold) {
    case Fold::sum:
      return sum;
    case Fold::mean:
      return sum / static_cast<double>(count);
    case Fold::min:
      return least;
    case Fold::max:
      return most;
    case Fold::none:
      break;
  }
  return least;
}

// What a list's elements may be asked for by, in the order in which they stand.
std::vector<std::string> names_in(const Json& list) {
  std::vector<std::string> names;
  for (const Json& element : list)
    for (const char* key : kNames)
      if (element.is_object() && element.contains(key)) names.push_back(text_of(element[key]));
  return names;
}

}  // namespace

struct Figures::Content {
  Json json;
};

std::string figure_mistake(const std::string& text) {
  const std::optional<Path> path = path_of(text);
  std::vector<std::string> known;
  for (const parameter::Statistic& figure : known_figures())
    if (!figure.name.starts_with("host.")) known.push_back(figure.name);
  const std::string name = path ? name_of(*path) : text;
  if (!path || std::find(known.begin(), known.end(), name) == known.end()) {
    const std::string near = nearest_word(name, known);
    return fmt::format("unknown figure '{}'; {}", text,
                       near.empty() ? "`describe statistics` lists them all" : fmt::format("nearest: '{}'", near));
  }
  if (type_of(name) == StatisticValue::text || type_of(name) == StatisticValue::table)
    return fmt::format("'{}' is {}, no number: it cannot be compared", text,
                       type_of(name) == StatisticValue::text ? "text" : "a table");
  const bool all = std::any_of(path->steps.begin(), path->steps.end(), [](const Step& step) {
    return step.selects && (step.selector.empty() || step.selector.find('=') != std::string::npos);
  });
  if (all && path->fold == Fold::none)
    return fmt::format(
        "'{0}' is one figure for each element: name one, or write sum({0}), mean({0}), min({0}) or "
        "max({0})",
        text);
  return {};
}

bool is_truth_figure(const std::string& text) {
  const std::optional<Path> path = path_of(text);
  return path && path->fold == Fold::none && type_of(name_of(*path)) == StatisticValue::truth;
}

bool is_error_figure(const std::string& text) {
  const std::optional<Path> path = path_of(text);
  if (!path) return false;
  const std::string name = name_of(*path);
  return name.starts_with("images[].error") || name.starts_with("errors[]");
}

std::string figure_unit(const std::string& text) {
  const std::optional<Path> path = path_of(text);
  const std::string name = path ? name_of(*path) : "";
  for (const parameter::Statistic& figure : known_figures())
    if (figure.name == name) return figure.unit == kOwnUnit ? "" : figure.unit;
  return {};
}

Figures::Figures(const std::string& json, const std::string& file) : content_(std::make_unique<Content>()) {
  content_->json = Json::parse(json, nullptr, false);
  if (!content_->json.is_object()) throw InputError(Diagnostic{file, 0, "", "is not a report.json of rastertlm"});
}
Figures::Figures(const Contents& contents) : content_(std::make_unique<Content>()) {
  content_->json = json_value(contents);
}
std::string Figures::json() const { return text_of_json(content_->json); }
Figures::Figures(Figures&&) noexcept = default;
Figures::~Figures() = default;

std::optional<double> Figures::value(const std::string& text) const {
  const std::optional<Path> path = path_of(text);
  if (!path) return std::nullopt;
  const std::vector<Reached> found = reached(content_->json, *path);
  const std::string& key = path->steps.back().key;
  if (path->fold != Fold::none) return folded(path->fold, found, key);
  return found.empty() ? std::nullopt : figure(found.front(), key);
}

std::string Figures::unit(const std::string& text) const {
  const std::optional<Path> path = path_of(text);
  if (!path) return {};
  const std::vector<Reached> found = reached(content_->json, *path);
  std::string fixed = figure_unit(text);
  if (!fixed.empty() || found.empty()) return fixed;
  // "used" and "count" stand in the element whose unit it is.
  const std::string& key = path->steps.back().key;
  const bool own = key == "used" || key == "available" || key == "count";
  const Json& parent = *found.front().parent;
  return own && parent.is_object() && parent.contains("unit") ? text_of(parent["unit"]) : "";
}

std::string Figures::absent(const std::string& text) const {
  const std::optional<Path> path = path_of(text);
  if (!path) return figure_mistake(text);
  Missing missing;
  const std::vector<Reached> found = reached(content_->json, *path, &missing);
  if (missing.step != nullptr) {
    if (!missing.within->is_array() || !missing.step->selects)
      return fmt::format("the machine's report has no '{}' where '{}' wants it", missing.step->key, text);
    const std::vector<std::string> names = names_in(*missing.within);
    const std::string near = nearest_word(missing.step->selector, names);
    std::string known;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
      known += fmt::format("{}'{}'", known.empty() ? "; known: " : ", ", names[i]);
    return fmt::format("the machine's report has no {}[{}]{}{}", missing.step->key, missing.step->selector, known,
                       near.empty() ? "" : fmt::format("; nearest: '{}'", near));
  }
  for (const Reached& one : found)
    if (!number(*one.value) && !one.value->is_null()) return fmt::format("'{}' is no number", text);
  return {};
}

}  // namespace rastertlm::report
