#include "src/config/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "src/config/convert.h"
#include "src/config/tree.h"
#include "src/config/unknown_key.h"
#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

using parameter::Condition;
using parameter::Kind;
using parameter::Parameter;
using parameter::Value;

constexpr std::string_view kPresetKey = ".preset";

// Where a mistake is: its place among all of them, and what the message names.
struct Site {
  std::size_t order = 0;
  std::string file;
  int line = 0;
};

// A sweep reads the same presets for every machine.
const Document& parsed(const std::string& text, const std::string& file) {
  static std::map<std::string, Document> documents;
  const std::string key = fmt::format("{}\n{}", file, text);
  const auto known = documents.find(key);
  return known != documents.end() ? known->second
                                  : documents.emplace(key, Document::from_text(text, file)).first->second;
}

class Reading {
 public:
  Reading(const Document& document, parameter::Table& table, const std::vector<Override>& overrides,
          const Presets& presets)
      : document_(document), table_(table), overrides_(overrides), presets_(presets), tree_(table) {}

  Origins run(Diagnostics& diagnostics) {
    make_lists();
    for (std::size_t i = 0; i < document_.entries().size(); ++i)
      apply(document_.entries()[i], {i, document_.file(), document_.entries()[i].line});
    for (std::size_t i = 0; i < overrides_.size(); ++i)
      apply(overrides_[i], {document_.entries().size() + i, "--set", 0});
    for (const Parameter& parameter : table_.parameters())
      if (parameter.kind == Kind::text && parameter.path.ends_with(kPresetKey)) apply_preset(parameter);
    check_conditions();
    check_required();
    std::stable_sort(mistakes_.begin(), mistakes_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [order, diagnostic] : mistakes_) diagnostics.add(std::move(diagnostic));
    return std::move(origins_);
  }

 private:
  // Lists take their final size first, so that the views of their elements stay good.
  void make_lists() {
    for (const Entry& entry : document_.entries()) {
      const auto* empty_list = std::get_if<RawList>(&entry.value.value);
      if (entry.kind == EntryKind::element) tree_.make_element(entry.path);
      if (entry.kind == EntryKind::value && empty_list != nullptr && empty_list->empty()) tree_.clear_list(entry.path);
    }
  }

  void report(const Site& site, const std::string& key, std::string message) {
    mistakes_.emplace_back(site.order, Diagnostic{site.file, site.line, printable(key), std::move(message)});
  }

  // One message for a table that is wrong as a whole, none for what is in it.
  void report_table(const Site& site, const std::string& path, std::string message) {
    report(site, path, std::move(message));
    wrong_tables_.insert(path);
  }

  bool is_in_wrong_table(const std::string& path) const {
    if (wrong_tables_.empty()) return false;
    for (std::size_t at = path.find_first_of(".["); at != std::string::npos; at = path.find_first_of(".[", at + 1))
      if (wrong_tables_.contains(path.substr(0, at))) return true;
    return false;
  }

  void assign(const Site& site, const std::string& path, const Parameter& parameter, const Raw& raw, Origin origin) {
    sites_[path] = site;
    const std::variant<Value, Mistake> result = convert(raw, parameter);
    if (const auto* mistake = std::get_if<Mistake>(&result)) {
      report(site, path, mistake->message);
      refused_.insert(path);
      return;
    }
    parameter.set(std::get<Value>(result));
    refused_.erase(path);
    origins_.set(path, std::move(origin));
  }

  void apply(const Entry& entry, const Site& site) {
    if (is_in_wrong_table(entry.path)) return;
    const Place place = tree_.locate(entry.path);
    const bool is_value = entry.kind == EntryKind::value;
    switch (place.kind) {
      case PlaceKind::parameter:
        assign(site, entry.path, *place.parameter, is_value ? entry.value : Raw{Unusable{"a table"}},
               {OriginKind::file, document_.file(), entry.line});
        if (!is_value) wrong_tables_.insert(entry.path);
        return;
      case PlaceKind::table:
        if (is_value)
          report(site, entry.path,
                 fmt::format("wrong type: '{0}' is a table, [{0}], found {1}", entry.path, found(entry.value)));
        return;
      case PlaceKind::list: {
        const auto* list = std::get_if<RawList>(&entry.value.value);
        if (!is_value || list == nullptr || !list->empty())
          report_table(site, entry.path,
                       fmt::format("wrong type: '{0}' is a list of tables, each written [[{0}]], found {1}", entry.path,
                                   is_value ? found(entry.value) : "one table"));
        return;
      }
      case PlaceKind::element:
        headers_[entry.path + '.'] = site;
        return;
      case PlaceKind::beyond:
      case PlaceKind::unknown:
        apply_unknown(entry, site, place);
        return;
    }
  }

  void apply_unknown(const Entry& entry, const Site& site, const Place& place) {
    if (entry.kind != EntryKind::element) return report_table(site, entry.path, unknown_key_message(entry.path, place));
    // "[[host]]" where [host] is one table, or one value.
    const std::string base = entry.path.substr(0, entry.path.rfind('['));
    const Place of_base = tree_.locate(base);
    if (of_base.kind == PlaceKind::table) {
      report_table(site, base, fmt::format("wrong type: '{0}' is one table, [{0}], found a list of tables", base));
    } else if (of_base.kind == PlaceKind::parameter) {
      assign(site, base, *of_base.parameter, Raw{Unusable{"a list of tables"}}, {});
      wrong_tables_.insert(base);
    } else {
      report_table(site, base, unknown_key_message(base, place));
    }
  }

  void apply(const Override& given, const Site& site) {
    const Place place = tree_.locate(given.path);
    switch (place.kind) {
      case PlaceKind::parameter: {
        const bool is_text = place.parameter->kind == Kind::text || place.parameter->kind == Kind::choice;
        // Text needs no quotes on the command line: 12 and true are good names.
        const bool as_is = given.value && (!is_text || std::holds_alternative<std::string>(given.value->value));
        assign(site, given.path, *place.parameter, as_is ? *given.value : Raw{given.text}, {OriginKind::set, "", 0});
        return;
      }
      case PlaceKind::table:
        report(site, given.path, "is a table: name a key of it, as in " + given.path + ".key=value");
        return;
      case PlaceKind::list:
        report(site, given.path,
               "is a list of tables: name an element and a key, as in " + given.path + "[0].key=value");
        return;
      case PlaceKind::element:
        report(site, given.path, "is an element of a list: name a key of it, as in " + given.path + ".key=value");
        return;
      case PlaceKind::beyond:
        report(site, given.path,
               fmt::format("there is no such element: '{}{}' has {}, counted from 0", place.prefix, place.list->path,
                           place.list->size()));
        return;
      case PlaceKind::unknown:
        report(site, given.path, unknown_key_message(given.path, place));
        return;
    }
  }

  void apply_preset(const Parameter& chosen) {
    const std::string name = std::get<std::string>(chosen.get());
    if (name.empty() || refused_.contains(chosen.path) || !table_.applies(chosen)) return;
    const std::string table = chosen.path.substr(0, chosen.path.size() - kPresetKey.size());
    const std::string* text = presets_.find(table, name);
    if (text == nullptr) return report_unknown_preset(chosen.path, table, name);
    const std::string file = fmt::format("preset {}/{}", table, name);
    const std::size_t order = document_.entries().size() + overrides_.size();
    try {
      const Document& preset = parsed(*text, file);
      for (const Entry& entry : preset.entries())
        if (entry.kind != EntryKind::table)
          apply_preset_entry(table + '.' + entry.path, entry, {order, file, entry.line}, name);
    } catch (const InputError& error) {
      for (const Diagnostic& diagnostic : error.diagnostics()) mistakes_.emplace_back(order, diagnostic);
    }
  }

  void apply_preset_entry(const std::string& path, const Entry& entry, const Site& site, const std::string& name) {
    const Place place = tree_.locate(path);
    // A preset may serve several machines, and say more than one of them has.
    if (place.kind == PlaceKind::unknown) return;
    if (place.kind != PlaceKind::parameter) return report(site, path, unknown_key_message(path, place));
    if (!sites_.contains(path)) {
      assign(site, path, *place.parameter, entry.value, {OriginKind::preset, name, 0});
      sites_.erase(path);  // nobody asked for it: it may well not apply
    }
  }

  void report_unknown_preset(const std::string& path, const std::string& table, const std::string& name) {
    std::string known;
    for (const std::string& one : presets_.names(table)) known += fmt::format("{}'{}'", known.empty() ? "" : ", ", one);
    std::string message = fmt::format("unknown preset '{}'; known presets of '{}': {}", printable(name), table,
                                      known.empty() ? "none" : known);
    if (const std::string near = nearest_word(name, presets_.names(table)); !near.empty())
      message += fmt::format("; nearest: '{}'", near);
    const auto site = sites_.find(path);
    report(site == sites_.end() ? Site{0, document_.file(), 0} : site->second, path, std::move(message));
  }

  void check_conditions() {
    for (const auto& [path, site] : sites_) {
      const Place place = tree_.locate(path);
      if (place.kind != PlaceKind::parameter) continue;
      const Condition* unmet = place.table->unmet_condition(*place.parameter);
      if (unmet == nullptr || refused_.contains(place.prefix + unmet->path)) continue;
      const Value actual = place.table->find(unmet->path)->get();
      const auto* text = std::get_if<std::string>(&actual);
      report(site, path,
             fmt::format("does not apply: it belongs only {}, and here it is {}", to_text(*unmet),
                         text == nullptr ? to_toml(actual) : fmt::format("'{}'", *text)));
    }
  }

  void check_required() {
    for (const Tree::Node& node : tree_.nodes()) {
      const auto header = headers_.find(node.prefix);
      // Default elements are complete by construction.
      if (!node.prefix.empty() && header == headers_.end()) continue;
      const Site site =
          node.prefix.empty() ? Site{std::numeric_limits<std::size_t>::max(), document_.file(), 0} : header->second;
      for (const Parameter& parameter : node.table->parameters()) {
        const std::string path = node.prefix + parameter.path;
        if (!parameter.about.required || origins_.contains(path) || refused_.contains(path)) continue;
        if (node.table->applies(parameter))
          report(site, path, fmt::format("required key is missing: {}", parameter.about.description));
      }
    }
  }

  const Document& document_;
  parameter::Table& table_;
  const std::vector<Override>& overrides_;
  const Presets& presets_;
  Tree tree_;
  Origins origins_;
  std::map<std::string, Site> sites_;              // of the keys that the document or an override gives
  std::unordered_map<std::string, Site> headers_;  // of elements, by prefix
  std::unordered_set<std::string> refused_;        // keys whose value was refused
  std::unordered_set<std::string> wrong_tables_;   // tables and lists that were refused as a whole
  std::vector<std::pair<std::size_t, Diagnostic>> mistakes_;
};

}  // namespace

Origins read(const Document& document, parameter::Table& table, const std::vector<Override>& overrides,
             Diagnostics& diagnostics, const Presets& presets) {
  return Reading(document, table, overrides, presets).run(diagnostics);
}

}  // namespace rastertlm::config
