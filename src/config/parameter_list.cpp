#include "src/config/parameter_list.h"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

using parameter::Kind;
using parameter::List;
using parameter::Parameter;
using parameter::Table;

struct Group {
  std::string header;       // "[host]", "[[object.animation]]", "" for the keys before any table
  std::string description;  // of a list
  std::vector<const Parameter*> parameters;
  std::size_t skipped = 0;  // of a path, up to the key within the table
};

void add_groups(const Table& table, const std::string& list_header, const std::string& description,
                const std::function<void(const Group&)>& use) {
  std::vector<Group> groups;
  for (const Parameter& parameter : table.parameters()) {
    const std::size_t dot = list_header.empty() ? parameter.path.rfind('.') : std::string::npos;
    const std::size_t skipped = dot == std::string::npos ? 0 : dot + 1;
    std::string header = skipped == 0 ? "" : '[' + parameter.path.substr(0, dot) + ']';
    if (!list_header.empty()) header = "[[" + list_header + "]]";
    Group* group = nullptr;
    for (Group& known : groups)
      if (known.header == header) group = &known;
    if (group == nullptr) group = &groups.emplace_back(Group{header, description, {}, skipped});
    group->parameters.push_back(&parameter);
  }
  for (const Group& group : groups) use(group);
  for (const List& list : table.lists()) {
    const Table example = list.example();
    add_groups(example, list_header.empty() ? list.path : list_header + '.' + list.path, list.description, use);
  }
}

std::string type_text(const Parameter& parameter) {
  return parameter.kind == Kind::choice ? "one of" : to_string(parameter.kind);
}

std::string default_text(const Parameter& parameter) {
  return parameter.about.required ? "required" : to_toml(parameter.default_value);
}

std::string moves_text(const Parameter& parameter) {
  return parameter.about.exempt ? "nothing in the results" : parameter.about.moves;
}

std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

void write_plain(const Group& group, std::string& text) {
  text += text.empty() ? "" : "\n";
  if (!group.header.empty()) text += group.header + (group.description.empty() ? "" : "  " + group.description) + '\n';
  for (const Parameter* p : group.parameters) {
    std::string type = type_text(*p);
    if (const std::string range = accepted(*p); !range.empty())
      type += (p->kind == Kind::choice ? " " : ", ") + range;
    else if (!p->about.unit.empty())
      type += ", in " + p->about.unit;
    const std::string value = p->about.required ? default_text(*p) : "default " + default_text(*p);
    text += fmt::format("  {:<28} {}; {}\n", p->path.substr(group.skipped), type, value);
    text += fmt::format("      {}\n", p->about.description);
    if (!moves_text(*p).empty()) text += fmt::format("      moves: {}\n", moves_text(*p));
    if (p->about.only_when) text += fmt::format("      only {}\n", to_text(*p->about.only_when));
  }
}

void write_markdown(const Group& group, std::string& text) {
  text += fmt::format("{}### {}\n\n", text.empty() ? "" : "\n",
                      group.header.empty() ? "Top level" : '`' + group.header + '`');
  if (!group.description.empty()) text += group.description + "\n\n";
  text += "| key | type | default | unit | accepted | meaning | moves |\n|---|---|---|---|---|---|---|\n";
  for (const Parameter* p : group.parameters) {
    std::string meaning = p->about.description;
    if (p->about.only_when) meaning += " Only " + to_text(*p->about.only_when) + '.';
    const std::string type = p->kind == Kind::choice ? "choice" : to_string(p->kind);
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", p->path.substr(group.skipped), type,
                        p->about.required ? "required" : '`' + cell(default_text(*p)) + '`', cell(p->about.unit),
                        cell(accepted(*p)), cell(meaning), cell(moves_text(*p)));
  }
}

}  // namespace

std::string parameter_list_text(const Table& table) {
  std::string text;
  add_groups(table, "", "", [&](const Group& group) { write_plain(group, text); });
  return text;
}

std::string parameter_list_markdown(const Table& table) {
  std::string text;
  add_groups(table, "", "", [&](const Group& group) { write_markdown(group, text); });
  return text;
}

}  // namespace rastertlm::config
