#include "src/explore/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "src/config/document.h"
#include "src/config/header.h"
#include "src/config/reader.h"
#include "src/config/value_text.h"

namespace rastertlm::explore {
namespace {

using config::Entry;
using config::EntryKind;

constexpr std::int64_t kSchema = 1;
constexpr double kAny = parameter::kAnyReal;
// Keys that hold values of any parameter, or lists of text: no declaration has them.
constexpr std::array<const char*, 6> kOurs{"machine", "scene", "constraints", "given", "set", "baseline"};
constexpr std::int64_t kMostPoints = 1'000'000'000;

parameter::About about(const char* description, bool required = false) {
  return {.unit = "", .description = description, .moves = "the points of a sweep", .required = required};
}

bool is_below(const std::string& path, const std::string& table) {
  return path == table || (path.starts_with(table) && path[table.size()] == '.');
}

// "vary[3].values" is { 3, "values" }.
struct InVary {
  std::size_t index = 0;
  std::string rest;
};

std::optional<InVary> in_vary(const std::string& path) {
  constexpr std::string_view kHead = "vary[";
  if (!path.starts_with(kHead)) return std::nullopt;
  InVary found;
  const char* const end = path.data() + path.size();
  const auto [after, error] = std::from_chars(path.data() + kHead.size(), end, found.index);
  if (error != std::errc() || after + 2 > end || after[0] != ']' || after[1] != '.') return std::nullopt;
  found.rest = std::string(after + 2, end);
  return found;
}

bool is_ours(const Entry& entry) {
  const std::string& path = entry.path;
  if (path == "machine" || path == "scene" || path == "constraints" || path == "given") return true;
  if (is_below(path, "set") || is_below(path, "baseline")) return true;
  const std::optional<InVary> vary = in_vary(path);
  return vary && (vary->rest == "values" || vary->rest.starts_with("variant["));
}

std::string head_of(const std::string& path) { return path.substr(0, path.find_first_of(".[")); }

// All keys of a sweep file at its top: those of the table, and those that no declaration has.
std::vector<std::string> keys_of(const parameter::Table& table) {
  std::vector<std::string> keys;
  for (const auto& parameter : table.parameters()) keys.push_back(parameter.path);
  for (const auto& list : table.lists()) keys.push_back(list.path);
  keys.insert(keys.end(), kOurs.begin(), kOurs.end());
  return keys;
}

bool is_unknown(const std::string& path, const parameter::Table& table) {
  const std::vector<std::string> keys = keys_of(table);
  return std::find(keys.begin(), keys.end(), head_of(path)) == keys.end();
}

// Of a table that is unknown, once.
void say_unknown(const config::Document& document, const parameter::Table& table, Diagnostics& diagnostics) {
  const std::vector<std::string> keys = keys_of(table);
  std::vector<std::string> said;
  for (const Entry& entry : document.entries()) {
    const std::string head = head_of(entry.path);
    if (!is_unknown(entry.path, table) || std::find(said.begin(), said.end(), head) != said.end()) continue;
    said.push_back(head);
    std::string listed;
    for (const std::string& key : keys) listed += fmt::format("{}'{}'", listed.empty() ? "" : ", ", key);
    const std::string near = nearest_word(head, keys);
    diagnostics.add({document.file(), entry.line, config::printable(head),
                     fmt::format("unknown key '{}'; {}", config::printable(head),
                                 near.empty() ? "known here: " + listed : fmt::format("nearest known: '{}'", near))});
  }
}

// A key that had to be quoted is one path.
std::string unquoted(const std::string& path) {
  if (path.size() < 2 || path.front() != '"' || path.back() != '"') return path;
  return path.substr(1, path.size() - 2);
}

class Reading {
 public:
  Reading(const config::Document& document, SweepFile& sweep, Diagnostics& diagnostics)
      : document_(document), sweep_(sweep), diagnostics_(diagnostics) {}

  void run() {
    for (const Entry& entry : document_.entries()) {
      const std::string& path = entry.path;
      const bool value = entry.kind == EntryKind::value;
      if (path == "machine") words(entry, sweep_.machines);
      if (path == "scene") words(entry, sweep_.scenes);
      if (path == "constraints") words(entry, sweep_.constraints);
      if (path == "given") words(entry, sweep_.given);
      if (path == "baseline" && !value) sweep_.has_baseline = true;
      if ((path == "set" || path == "baseline") && value) refuse(entry, "is a table of parameters and their values");
      if (value && path.starts_with("set.")) sweep_.sets.push_back(setting(entry, path.substr(4)));
      if (value && path.starts_with("baseline.")) sweep_.baseline.push_back(setting(entry, path.substr(9)));
      const std::optional<InVary> vary = in_vary(path);
      if (vary && vary->index < sweep_.vary.size()) add(entry, *vary);
      if (entry.kind == EntryKind::element && path.starts_with("vary[")) {
        std::size_t index = 0;
        std::from_chars(path.data() + 5, path.data() + path.size(), index);
        if (index < sweep_.vary.size() && !vary) sweep_.vary[index].line = entry.line;
      }
    }
  }

 private:
  void refuse(const Entry& entry, const std::string& message) {
    diagnostics_.add({document_.file(), entry.line, entry.path, message});
  }
  static Setting setting(const Entry& entry, const std::string& path) {
    return {unquoted(path), entry.value, entry.line};
  }

  // One text, or a list of them.
  void words(const Entry& entry, std::vector<Word>& words) {
    const auto* one = std::get_if<std::string>(&entry.value.value);
    const auto* list = std::get_if<config::RawList>(&entry.value.value);
    if (entry.kind == EntryKind::value && one != nullptr) return words.push_back({*one, entry.line});
    const bool texts = entry.kind == EntryKind::value && list != nullptr && !list->empty() &&
                       std::all_of(list->begin(), list->end(), [](const config::Raw& raw) {
                         return std::holds_alternative<std::string>(raw.value);
                       });
    if (!texts) return refuse(entry, "wrong type: expected text, or a list of texts");
    for (const config::Raw& raw : *list) words.push_back({std::get<std::string>(raw.value), entry.line});
  }

  void add(const Entry& entry, const InVary& place) {
    VaryFile& vary = sweep_.vary[place.index];
    if (place.rest == "values") {
      const auto* list = std::get_if<config::RawList>(&entry.value.value);
      if (entry.kind != EntryKind::value || list == nullptr)
        return refuse(entry, fmt::format("wrong type: expected a list of values, found {}",
                                         entry.kind == EntryKind::value ? config::found(entry.value) : "a table"));
      vary.values = *list;
      vary.has_values = true;
      return;
    }
    if (place.rest.starts_with("variant[")) add_variant(entry, vary, place.rest);
  }

  void add_variant(const Entry& entry, VaryFile& vary, const std::string& rest) {
    const std::size_t close = rest.find(']');
    if (entry.kind == EntryKind::element && close + 1 == rest.size()) {
      vary.variants.push_back({"", {}, entry.line});
      return;
    }
    const std::string key = close + 2 <= rest.size() ? rest.substr(close + 2) : "";
    if (vary.variants.empty()) return;
    Variant& variant = vary.variants.back();
    const bool value = entry.kind == EntryKind::value;
    const auto* text = value ? std::get_if<std::string>(&entry.value.value) : nullptr;
    if (key == "name" && text != nullptr)
      variant.name = *text;
    else if (key == "curve" && text != nullptr)
      variant.curve = *text;
    else if (value && key.starts_with("set."))
      variant.sets.push_back(setting(entry, key.substr(4)));
    else if (value || !is_below(key, "set"))
      refuse(entry,
             "unknown key; a variant has a name and a curve, texts, and a table `set` of parameters and their values");
  }

  const config::Document& document_;
  SweepFile& sweep_;
  Diagnostics& diagnostics_;
};

}  // namespace

void VaryFile::declare(parameter::Table& table) {
  table.text("path", path, about("The parameter that varies, as --set names it."));
  table.text("name", name, about("The name of a group of parameters that vary together, each way a [[vary.variant]]."));
  table.real("from", from, {-kAny, kAny}, about("The first value of a range."));
  table.real("to", to, {-kAny, kAny}, about("The last value of a range, itself included."));
  table.real("step", step, {0.0, kAny, true}, about("From a value of a range to the next."));
  table.real("factor", factor, {1.0, kAny, true}, about("A value of a range over the one before it: log steps."));
  table.integer("count", count, {2, 1'000'000}, about("Values of a range, spread evenly."));
  table.choice("spacing", spacing, {"linear", "log"},
               about("How `count` values are spread, and how a range without steps is drawn from."));
}

void ObjectiveFile::declare(parameter::Table& table) {
  table.text("path", path,
             about("A figure of report.json, or a number of the machine: machine.host.computation_units.", true));
  table.text("name", name, about("That a reader knows it by; empty: made from the path."));
  table.choice("sense", sense, {"minimise", "maximise"}, about("Which way is better.", true));
  table.choice("scale", scale, {"linear", "log"}, about("How it is drawn on the page."));
  table.boolean("optional", optional, about("Whether machines of the sweep may have no such figure."));
}

void ColumnFile::declare(parameter::Table& table) {
  table.text("path", path,
             about("A figure, as an objective's, that is shown beside them and counts for nothing.", true));
  table.text("name", name, about("That a reader knows it by; empty: made from the path."));
  table.boolean("optional", optional, about("Whether machines of the sweep may have no such figure."));
}

void SweepFile::declare(parameter::Table& table) {
  table.integer("schema", schema, {1, kSchema}, about("Version of the sweep file's form."));
  table.text("name", name, about("Of the sweep; empty: the file's."));
  table.text("question", question, about("That the sweep answers."));
  table.choice("mode", mode, {"grid", "one_at_a_time", "random", "latin_hypercube"},
               about("Which points: all combinations, one parameter away from the baseline, or drawn."));
  table.integer("points", points, {1, kMostPoints},
                {.unit = "",
                 .description = "How many are drawn.",
                 .moves = "the points of a sweep",
                 .only_when = parameter::Condition{"mode", {"random", "latin_hypercube"}}});
  table.integer("seed", seed, {0, std::numeric_limits<std::int64_t>::max()},
                {.unit = "",
                 .description = "Of the draws: the same seed draws the same points.",
                 .moves = "the points of a sweep",
                 .only_when = parameter::Condition{"mode", {"random", "latin_hypercube"}}});
  table.integer("frames", frames, {1, 1'000'000}, about("Displayed frames of every point."));
  table.boolean("reference", reference, about("Whether the error against the exact pictures is measured."));
  table.boolean("thumbnails", thumbnails, about("Whether a small picture of each point is kept."));
  table.list("vary", vary, "What varies: a parameter with values or a range, or a group with variants.");
  table.list("objective", objectives, "What counts.");
  table.list("column", columns, "What is shown beside it.");
}

SweepFile read_sweep_file(const std::string& file, Diagnostics& diagnostics) {
  const config::Document document = config::Document::from_file(file);
  SweepFile sweep;
  if (!config::check_schema(document, kSchema, diagnostics)) diagnostics.throw_if_any();
  parameter::Table table = parameter::view(sweep);
  say_unknown(document, table, diagnostics);
  const config::Document declared =
      document.only([&](const Entry& entry) { return !is_ours(entry) && !is_unknown(entry.path, table); });
  sweep.origins = config::read(declared, table, {}, diagnostics);
  Reading(document, sweep, diagnostics).run();
  if (sweep.machines.empty() && document.find("machine") == nullptr)
    diagnostics.add({file, 0, "machine", "required key is missing: the machine file, or a list of them"});
  if (sweep.scenes.empty() && document.find("scene") == nullptr)
    diagnostics.add({file, 0, "scene", "required key is missing: the scene file, or a list of them"});
  return sweep;
}

}  // namespace rastertlm::explore
