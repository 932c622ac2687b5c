#include "src/config/unknown_key.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "src/base/errors.h"
#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

constexpr std::size_t kLongestGuess = 100;  // edit distance is quadratic; no key is as long
constexpr std::size_t kMostKeysListed = 40;

std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string leaf_of(const std::string& path) { return path.substr(path.rfind('.') + 1); }

void add_once(std::vector<std::string>& list, const std::string& word) {
  if (std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
}

// Parameters, lists and the tables that hold them, relative to the table.
std::vector<std::string> known_paths(const parameter::Table& table) {
  std::vector<std::string> paths;
  for (const auto& parameter : table.parameters()) paths.push_back(parameter.path);
  for (const auto& list : table.lists()) paths.push_back(list.path);
  const std::vector<std::string> leaves = paths;
  for (const std::string& path : leaves)
    for (std::string parent = parent_of(path); !parent.empty(); parent = parent_of(parent)) add_once(paths, parent);
  return paths;
}

// "object.0.radius" as it is written here, "object[0].radius"; "" where no key is a number.
std::string with_brackets(const std::string& path) {
  std::string text;
  bool changed = false;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('.', at), path.size());
    const std::string key = path.substr(at, end - at);
    const bool number = !key.empty() && key.find_first_not_of("0123456789") == std::string::npos;
    if (number && !text.empty()) {
      text += '[' + key + ']';
      changed = true;
    } else {
      text += (text.empty() ? "" : ".") + key;
    }
    at = end + 1;
  }
  return changed ? text : "";
}

std::string nearest_path(const std::string& path, const std::vector<std::string>& known) {
  const std::string leaf = leaf_of(path);
  std::vector<std::string> siblings;
  for (const std::string& candidate : known)
    if (parent_of(candidate) == parent_of(path)) siblings.push_back(leaf_of(candidate));
  if (const std::string near = nearest_word(leaf, siblings); !near.empty())
    return parent_of(path).empty() ? near : parent_of(path) + '.' + near;
  // The right key in the wrong table.
  for (const std::string& candidate : known)
    if (leaf_of(candidate) == leaf) return candidate;
  return nearest_word(path, known);
}

// Keys and lists called `leaf` of the elements of lists below `table`: "'object[].radius'".
void add_elements_keys(const parameter::Table& table, const std::string& prefix, const std::string& leaf,
                       std::vector<std::string>& found) {
  for (const auto& list : table.lists()) {
    const parameter::Table element = list.example();
    const std::string below = prefix + list.path + "[].";
    if (element.find(leaf) != nullptr) add_once(found, fmt::format("'{}{}'", below, leaf));
    if (element.find_list(leaf) != nullptr)
      add_once(found,
               fmt::format("'{}{}', written [[{}.{}]] behind its [[{}]]", below, leaf, list.path, leaf, list.path));
    add_elements_keys(element, below, leaf, found);
  }
}

}  // namespace

std::string unknown_key_message(const std::string& path, const Place& place) {
  std::string message = fmt::format("unknown key '{}'", printable(path));
  if (place.table == nullptr || place.rest.size() > kLongestGuess) return message;
  if (const std::string written = with_brackets(path); !written.empty())
    return message + fmt::format("; an element of a list is written '{}'", printable(written));
  const std::string rest = place.rest.substr(0, place.rest.find('['));
  std::vector<std::string> of_elements;
  if (rest.find('.') == std::string::npos) add_elements_keys(*place.table, place.prefix, rest, of_elements);
  if (!of_elements.empty())
    return message + fmt::format("; known of a list's elements: {}", fmt::join(of_elements, ", "));
  const std::vector<std::string> known = known_paths(*place.table);
  if (const std::string near = nearest_path(rest, known); !near.empty())
    return message + fmt::format("; nearest known: '{}{}'", place.prefix, near);
  std::string listed;
  std::size_t count = 0;
  for (const std::string& candidate : known)
    if (parent_of(candidate) == parent_of(rest) && count++ < kMostKeysListed)
      listed += fmt::format("{}'{}'", listed.empty() ? "" : ", ", leaf_of(candidate));
  return listed.empty() ? message : message + "; known here: " + listed;
}

}  // namespace rastertlm::config
