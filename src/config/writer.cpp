#include "src/config/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "src/base/digest.h"
#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

using parameter::List;
using parameter::Parameter;
using parameter::Table;

std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

class Writer {
 public:
  // Without origins: the canonical text.
  explicit Writer(const Origins* origins) : origins_(origins) {}

  std::string write(Table& table) {
    write_root(table);
    return std::move(text_);
  }

 private:
  void write_parameter(const Table& table, const Parameter& parameter, const std::string& key,
                       const std::string& path) {
    const bool applies = table.applies(parameter);
    if (origins_ == nullptr) {
      if (applies) text_ += fmt::format("{} = {}\n", key, to_toml(parameter.get()));
      return;
    }
    const std::string origin = printable(to_string(origins_->of(path)));
    if (applies)
      text_ += fmt::format("{} = {}  # {}\n", key, to_toml(parameter.get()), origin);
    else
      text_ += fmt::format("# {} has no meaning here: only {}\n", key, to_text(*table.unmet_condition(parameter)));
  }

  void write_root(Table& table) {
    // TOML wants the keys of the root before the first table.
    std::vector<std::string> groups{""};
    const auto add_group = [&](const std::string& path) {
      if (std::find(groups.begin(), groups.end(), parent_of(path)) == groups.end()) groups.push_back(parent_of(path));
    };
    for (const Parameter& parameter : table.parameters()) add_group(parameter.path);
    for (const List& list : table.lists())
      if (list.size() == 0) add_group(list.path);
    for (const std::string& group : groups) {
      if (!group.empty()) text_ += fmt::format("\n[{}]\n", group);
      const std::size_t start = group.empty() ? 0 : group.size() + 1;
      for (const Parameter& parameter : table.parameters())
        if (parent_of(parameter.path) == group)
          write_parameter(table, parameter, parameter.path.substr(start), parameter.path);
      for (const List& list : table.lists())
        if (list.size() == 0 && parent_of(list.path) == group) text_ += list.path.substr(start) + " = []\n";
    }
    write_lists(table, "", "");
  }

  // `header`: the path without indices, as [[...]] wants it; `prefix`: with them, as origins have it.
  void write_lists(Table& table, const std::string& header, const std::string& prefix) {
    for (const List& list : table.lists()) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        Table element = list.element(i);
        const std::string element_prefix = fmt::format("{}{}[{}].", prefix, list.path, i);
        text_ += fmt::format("\n[[{}{}]]\n", header, list.path);
        for (const Parameter& parameter : element.parameters())
          write_parameter(element, parameter, parameter.path, element_prefix + parameter.path);
        for (const List& inner : element.lists())
          if (inner.size() == 0) text_ += inner.path + " = []\n";
        write_lists(element, header + list.path + '.', element_prefix);
      }
    }
  }

  const Origins* origins_;
  std::string text_;
};

}  // namespace

std::string resolved_text(Table& table, const Origins& origins) { return Writer(&origins).write(table); }

std::string canonical_text(Table& table) { return Writer(nullptr).write(table); }

std::string digest(Table& table) { return sha256_hex(canonical_text(table)); }

}  // namespace rastertlm::config
