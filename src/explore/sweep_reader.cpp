// A sweep file checked against the machines and scenes that it names.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "src/base/errors.h"
#include "src/config/document.h"
#include "src/config/overrides.h"
#include "src/config/value_text.h"
#include "src/explore/ranges.h"
#include "src/explore/sweep.h"
#include "src/explore/sweep_figures.h"
#include "src/explore/sweep_file.h"
#include "src/run/input_files.h"

namespace rastertlm::explore {
namespace {

using run::Settable;

// Of random designs a span may be wide; lists are looked through by text.
constexpr std::size_t kMostNamed = 40;

std::string beside(const std::string& file, const std::string& named) {
  return (std::filesystem::path(file).parent_path() / named).lexically_normal().string();
}

class Checking {
 public:
  Checking(const SweepFile& file, const std::vector<config::Override>& overrides, Sweep& sweep,
           Diagnostics& diagnostics)
      : file_(file), overrides_(overrides), sweep_(sweep), diagnostics_(diagnostics) {}

  void run() {
    files();
    if (sweep_.machines.empty() || sweep_.scenes.empty()) return figures();
    if (!bases({}, plain_)) return figures();
    if (sets() && bases(sweep_.sets, bases_)) {
      file_axes();
      for (std::size_t i = 0; i < file_.vary.size(); ++i) axis(i);
      no_key_twice();
    }
    figures();
    if (diagnostics_.empty()) given();
    if (diagnostics_.empty()) baseline();
    if (diagnostics_.empty() && sweep_.axes.empty())
      add(0, "vary", "nothing varies: give a [[vary]], or several machines or scenes");
  }

 private:
  using Bases = std::vector<std::unique_ptr<Settable>>;

  void add(int line, const std::string& key, const std::string& message) {
    diagnostics_.add({sweep_.file, line, key, message});
  }

  void files() {
    for (const Word& word : file_.machines) sweep_.machines.push_back(beside(sweep_.file, word.text));
    for (const Word& word : file_.scenes) sweep_.scenes.push_back(beside(sweep_.file, word.text));
  }

  // Every machine, and every scene, once.
  bool bases(const std::vector<config::Override>& sets, Bases& bases) {
    const std::size_t before = diagnostics_.list().size();
    for (std::size_t i = 0; i < std::max(sweep_.machines.size(), sweep_.scenes.size()); ++i) {
      const std::string& machine = sweep_.machines[std::min(i, sweep_.machines.size() - 1)];
      const std::string& scene = sweep_.scenes[std::min(i, sweep_.scenes.size() - 1)];
      try {
        bases.push_back(std::make_unique<Settable>(inputs_, machine, scene, sets));
      } catch (const InputError& error) {
        for (const Diagnostic& diagnostic : error.diagnostics()) diagnostics_.add(diagnostic);
      }
    }
    return diagnostics_.list().size() == before;
  }

  // A value that all machines and scenes take; what is wrong is said once.
  Settable::Checked checked(const Bases& bases, const std::string& path, const config::Raw* value) {
    Settable::Checked first{};
    for (std::size_t i = 0; i < bases.size(); ++i) {
      Settable::Checked one = value == nullptr ? bases[i]->check(path) : bases[i]->check(path, *value);
      if (!one.mistake.empty()) return one;
      if (i == 0) first = std::move(one);
    }
    return first;
  }

  bool sets() {
    const std::size_t before = diagnostics_.list().size();
    for (const Setting& setting : file_.sets) {
      const Settable::Checked result = checked(plain_, setting.path, &setting.value);
      if (!result.mistake.empty()) add(setting.line, "set." + setting.path, result.mistake);
      sweep_.sets.push_back(run::override_of(setting.path, setting.value));
    }
    for (const config::Override& override : overrides_) {
      const config::Raw value = override.value ? *override.value : config::Raw{override.text};
      const Settable::Checked result = checked(plain_, override.path, &value);
      if (!result.mistake.empty()) diagnostics_.add({"--set", 0, override.path, result.mistake});
      std::erase_if(sweep_.sets, [&](const config::Override& set) { return set.path == override.path; });
      sweep_.sets.push_back(override);
      sweep_.asked.insert(override.path);
    }
    return diagnostics_.list().size() == before;
  }

  void file_axes() {
    add_files("machine", Vary::What::machine, sweep_.machines, file_.machines);
    add_files("scene", Vary::What::scene, sweep_.scenes, file_.scenes);
  }
  void add_files(const char* path, Vary::What what, const std::vector<std::string>& files,
                 const std::vector<Word>& words) {
    if (files.size() < 2) return;
    Vary axis{what, path, "", {}, std::nullopt, 0, 0};
    for (std::size_t i = 0; i < files.size(); ++i) {
      const std::string name = std::filesystem::path(files[i]).stem().string();
      if (has(axis, name)) add(words[i].line, path, fmt::format("'{}' stands there twice", name));
      axis.choices.push_back({name, {}, files[i]});
    }
    sweep_.axes.push_back(std::move(axis));
  }

  static bool has(const Vary& axis, const std::string& text) {
    // Ranges have each value once.
    return std::any_of(axis.choices.begin(), axis.choices.end(), [&](const Choice& c) { return c.text == text; });
  }

  void axis(std::size_t index) {
    const VaryFile& vary = file_.vary[index];
    const std::string key = fmt::format("vary[{}]", index);
    const bool ranged = file_.gives(key + ".from") || file_.gives(key + ".to");
    const int forms =
        static_cast<int>(vary.has_values) + static_cast<int>(ranged) + static_cast<int>(!vary.variants.empty());
    if (vary.path.empty() == vary.name.empty())
      return add(vary.line, key, "give `path`, one parameter, or `name`, of a group that varies together");
    if (forms != 1)
      return add(vary.line, key,
                 forms == 0 ? "nothing to vary it over: give `values`, or `from` and `to`, or [[vary.variant]]"
                            : "`values`, `from` and `to`, and [[vary.variant]] contradict each other: give one");
    if (vary.variants.empty() != vary.name.empty())
      return add(vary.line, key, "`name` and [[vary.variant]] belong together; a `path` has `values` or a range");
    if (vary.path.empty())
      group(vary, key);
    else
      parameter(vary, key);
  }

  void group(const VaryFile& vary, const std::string& key) {
    Vary axis{Vary::What::parameter, vary.name, "", {}, std::nullopt, std::nullopt, vary.line};
    const bool curved = std::any_of(vary.variants.begin(), vary.variants.end(),
                                    [](const Variant& variant) { return !variant.curve.empty(); });
    for (std::size_t i = 0; i < vary.variants.size(); ++i) {
      const Variant& variant = vary.variants[i];
      const std::string place = fmt::format("{}.variant[{}]", key, i);
      if (variant.name.empty()) add(variant.line, place + ".name", "required key is missing: the variant's name");
      if (has(axis, variant.name)) add(variant.line, place + ".name", "another variant has the same name");
      Choice choice{variant.name, {}, "", curved ? curve_of(variant) : ""};
      bool standing = true;
      for (const Setting& setting : variant.sets) {
        const Settable::Checked result = checked(bases_, setting.path, &setting.value);
        if (!result.mistake.empty()) add(setting.line, place + ".set." + setting.path, result.mistake);
        standing = standing && result.text == result.standing;
        choice.sets.push_back(run::override_of(setting.path, setting.value));
      }
      if (standing && !axis.start) axis.start = axis.choices.size();
      axis.choices.push_back(std::move(choice));
    }
    sweep_.axes.push_back(std::move(axis));
  }

  // Where some are points of a curve, every other is one by itself.
  static std::string curve_of(const Variant& variant) { return variant.curve.empty() ? variant.name : variant.curve; }

  void parameter(const VaryFile& vary, const std::string& key) {
    const Settable::Checked known = checked(bases_, vary.path, nullptr);
    if (!known.mistake.empty()) return add(file_.line_of(key + ".path"), key + ".path", known.mistake);
    Vary axis{Vary::What::parameter, vary.path, known.unit, {}, std::nullopt, std::nullopt, vary.line};
    std::vector<config::Raw> values = vary.values;
    int line = file_.line_of(key + ".path");
    if (!vary.has_values) {
      const bool drawn = sweep_.mode == Mode::random || sweep_.mode == Mode::latin_hypercube;
      auto range = range_of(file_, vary, key + '.', known.integer, drawn);
      if (const auto* mistake = std::get_if<RangeMistake>(&range)) {
        const std::string where = mistake->key.empty() ? key : key + '.' + mistake->key;
        return add(std::max(file_.line_of(where), line), where, mistake->message);
      }
      if (const auto* span = std::get_if<Span>(&range)) axis.span = *span;
      if (const auto* listed = std::get_if<std::vector<config::Raw>>(&range)) values = *listed;
      line = file_.line_of(key + ".from");
      if (axis.span) check_ends(*axis.span, vary.path, key, line);
    }
    if (values.empty() && !axis.span) return add(line, key + ".values", "there is no value: the grid is empty");
    choices(axis, values, key, line);
    axis.start = place_of(axis, known.standing);
    sweep_.axes.push_back(std::move(axis));
  }

  void check_ends(const Span& span, const std::string& path, const std::string& key, int line) {
    for (const double fraction : {0.0, 1.0}) {
      const config::Raw value = value_at(span, fraction);
      const Settable::Checked result = checked(bases_, path, &value);
      if (!result.mistake.empty()) add(line, key, result.mistake);
    }
  }

  void choices(Vary& axis, const std::vector<config::Raw>& values, const std::string& key, int line) {
    std::set<std::string> texts;
    for (const config::Raw& value : values) {
      const Settable::Checked result = checked(bases_, axis.path, &value);
      if (!result.mistake.empty()) return add(line, key, result.mistake);
      if (!texts.insert(result.text).second)
        return add(line, key, fmt::format("the value {} stands there twice", result.text));
      axis.choices.push_back({result.text, {run::override_of(axis.path, value)}, ""});
    }
  }

  static std::optional<std::size_t> place_of(const Vary& axis, const std::string& text) {
    for (std::size_t i = 0; i < axis.choices.size(); ++i)
      if (axis.choices[i].text == text) return i;
    return std::nullopt;
  }

  // A parameter that two of them give has no value.
  void no_key_twice() {
    std::set<std::string> names;
    std::vector<std::pair<std::string, std::string>> givers;
    for (const config::Override& set : sweep_.sets) givers.emplace_back(set.path, "set");
    for (const Vary& axis : sweep_.axes) {
      if (!names.insert(axis.path).second) add(0, "vary", fmt::format("two of them are '{}'", axis.path));
      std::set<std::string> own;
      for (const Choice& choice : axis.choices)
        for (const config::Override& set : choice.sets) own.insert(set.path);
      if (axis.span) own.insert(axis.path);
      for (const std::string& path : own) givers.emplace_back(path, "vary '" + axis.path + '\'');
    }
    std::sort(givers.begin(), givers.end());
    for (std::size_t i = 1; i < givers.size(); ++i)
      if (givers[i].first == givers[i - 1].first)
        add(0, givers[i].first,
            fmt::format("{} and {} contradict each other: both give it", givers[i - 1].second, givers[i].second));
  }

  void figures() {
    const auto standing = [this](const std::string& parameter) { return checked(plain_, parameter, nullptr); };
    read_figures(file_, standing, sweep_, diagnostics_);
  }

  // Axes that are not ours to choose.
  void given() {
    for (const Word& word : file_.given) {
      Vary* axis = axis_named(word.text);
      if (axis == nullptr)
        add(word.line, "given", fmt::format("'{}' does not vary{}", word.text, nearest_axis(word.text)));
      else if (axis->given)
        add(word.line, "given", fmt::format("'{}' stands there twice", word.text));
      else
        axis->given = true;
    }
    const auto chosen = [](const Vary& axis) { return !axis.given; };
    if (!file_.given.empty() && diagnostics_.empty() && std::none_of(sweep_.axes.begin(), sweep_.axes.end(), chosen))
      add(file_.given.front().line, "given", "everything that varies is given: nothing is left to compare");
  }

  std::string nearest_axis(const std::string& path) const {
    std::vector<std::string> known;
    for (const Vary& one : sweep_.axes) known.push_back(one.path);
    const std::string near = nearest_word(path, known);
    return near.empty() ? std::string() : fmt::format("; nearest: '{}'", near);
  }

  Vary* axis_named(const std::string& path) {
    for (Vary& axis : sweep_.axes)
      if (axis.path == path) return &axis;
    return nullptr;
  }

  // Designs but the grid may begin from a value that is not among the others.
  void start_at(Vary& axis, const Setting& setting) {
    const auto* name = std::get_if<std::string>(&setting.value.value);
    const bool named = axis.what != Vary::What::parameter || !is_single(axis);
    std::string text = name == nullptr ? config::found(setting.value) : *name;
    if (!named) {
      const Settable::Checked result = checked(bases_, axis.path, &setting.value);
      if (!result.mistake.empty()) return add(setting.line, "baseline." + setting.path, result.mistake);
      text = result.text;
    }
    axis.start = place_of(axis, text);
    if (axis.start) return;
    if (!named && sweep_.mode != Mode::grid) return add_start(axis, text, setting.value);
    std::string values;
    for (std::size_t i = 0; i < std::min(axis.choices.size(), kMostNamed); ++i)
      values += (values.empty() ? "" : ", ") + axis.choices[i].text;
    add(setting.line, "baseline." + setting.path,
        fmt::format("{} is not among the values that vary: {}", text, values));
  }
  static bool is_single(const Vary& axis) {
    return axis.span || (axis.choices.front().sets.size() == 1 && axis.choices.front().sets.front().path == axis.path);
  }
  static void add_start(Vary& axis, const std::string& text, const config::Raw& value) {
    axis.choices.insert(axis.choices.begin(), {text, {run::override_of(axis.path, value)}, ""});
    axis.start = 0;
  }

  void baseline() {
    std::set<std::string> given;  // what is wrong with them has been said
    for (const Setting& setting : file_.baseline) {
      Vary* axis = axis_named(setting.path);
      if (axis != nullptr) {
        given.insert(axis->path);
        start_at(*axis, setting);
        continue;
      }
      add(setting.line, "baseline." + setting.path, "does not vary" + nearest_axis(setting.path));
    }
    const bool wanted = sweep_.mode == Mode::one_at_a_time || file_.has_baseline;
    bool whole = true;
    for (Vary& axis : sweep_.axes) {
      if (axis.start) continue;
      whole = false;
      if (given.contains(axis.path)) continue;
      if (wanted) whole = standing_start(axis);
      if (wanted && !whole)
        add(0, "baseline",
            fmt::format("has no value for '{}', and the machine's own is not among those that vary", axis.path));
    }
    const bool drawn = sweep_.mode == Mode::random || sweep_.mode == Mode::latin_hypercube;
    sweep_.baseline = wanted || (whole && !drawn);
  }

  // The value that the machine's file gives.
  bool standing_start(Vary& axis) {
    if (sweep_.mode == Mode::grid || axis.what != Vary::What::parameter) return false;
    if (!axis.span && !is_single(axis)) return false;
    const std::string standing = checked(bases_, axis.path, nullptr).standing;
    config::Raw value{standing};
    if (const std::optional<config::Raw> parsed = config::parse_value(standing)) value = *parsed;
    add_start(axis, standing, value);
    return true;
  }

  const SweepFile& file_;
  const std::vector<config::Override>& overrides_;
  Sweep& sweep_;
  Diagnostics& diagnostics_;
  run::InputFiles inputs_;
  Bases plain_;
  Bases bases_;
};

}  // namespace

Sweep read_sweep(const std::string& file, const std::vector<std::string>& sets) {
  Diagnostics diagnostics;
  const std::vector<config::Override> overrides = config::parse_overrides(sets, diagnostics);
  const SweepFile written = read_sweep_file(file, diagnostics);
  Sweep sweep;
  sweep.file = file;
  sweep.name = written.name.empty() ? std::filesystem::path(file).stem().string() : written.name;
  sweep.question = written.question;
  sweep.mode = written.mode;
  sweep.points = static_cast<std::uint64_t>(written.points);
  sweep.seed = static_cast<std::uint64_t>(written.seed);
  sweep.frames = static_cast<std::uint64_t>(written.frames);
  sweep.reference = written.reference;
  sweep.thumbnails = written.thumbnails;
  Checking(written, overrides, sweep, diagnostics).run();
  const bool drawn = sweep.mode == Mode::random || sweep.mode == Mode::latin_hypercube;
  if (drawn && sweep.points == 0)
    diagnostics.add({file, 0, "points", "required key is missing: how many points are drawn"});
  diagnostics.throw_if_any();
  return sweep;
}

}  // namespace rastertlm::explore
