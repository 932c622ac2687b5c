#include "src/config/tree.h"

#include <fmt/format.h>

namespace rastertlm::config {
namespace {

using parameter::List;
using parameter::Table;

struct Index {
  std::size_t value = 0;
  std::size_t end = 0;  // past the closing bracket
};

// "[12]" at `begin`; nothing where there is no plain index, or one of more than seven digits.
std::optional<Index> parse_index(const std::string& text, std::size_t begin) {
  if (begin >= text.size() || text[begin] != '[') return std::nullopt;
  std::size_t at = begin + 1;
  std::size_t value = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9' && at - begin <= 7)
    value = value * 10 + static_cast<std::size_t>(text[at++] - '0');
  if (at == begin + 1 || at >= text.size() || text[at] != ']') return std::nullopt;
  return Index{value, at + 1};
}

bool is_table(const Table& table, const std::string& path) {
  const std::string prefix = path + '.';
  for (const auto& parameter : table.parameters())
    if (parameter.path.starts_with(prefix)) return true;
  for (const auto& list : table.lists())
    if (list.path.starts_with(prefix)) return true;
  return false;
}

}  // namespace

Table* Tree::element(const List& list, const std::string& prefix, std::size_t index) {
  std::unique_ptr<Table>& slot = elements_[prefix];
  if (!slot) slot = std::make_unique<Table>(list.element(index));
  return slot.get();
}

Place Tree::locate(const std::string& path) {
  Place place{PlaceKind::unknown, &root_, "", path, nullptr, nullptr};
  for (;;) {
    place.parameter = place.table->find(place.rest);
    if (place.parameter != nullptr) {
      place.kind = PlaceKind::parameter;
      return place;
    }
    const std::size_t bracket = place.rest.find('[');
    place.list = place.table->find_list(place.rest.substr(0, bracket));
    if (place.list == nullptr) {
      if (bracket == std::string::npos && is_table(*place.table, place.rest)) place.kind = PlaceKind::table;
      return place;
    }
    if (bracket == std::string::npos) {
      place.kind = PlaceKind::list;
      return place;
    }
    const std::optional<Index> index = parse_index(place.rest, bracket);
    if (!index) return place;
    const bool ends = index->end == place.rest.size();
    if (!ends && place.rest[index->end] != '.') return place;
    if (index->value >= place.list->size()) {
      place.kind = PlaceKind::beyond;
      return place;
    }
    if (ends) {
      place.kind = PlaceKind::element;
      return place;
    }
    place.prefix += place.rest.substr(0, index->end) + '.';
    place.table = element(*place.list, place.prefix, index->value);
    place.rest = place.rest.substr(index->end + 1);
  }
}

void Tree::mention(const List& list, const std::string& full_path) {
  bool& mentioned = mentioned_[full_path];
  if (!mentioned) list.clear();
  mentioned = true;
}

void Tree::make_element(const std::string& path) {
  elements_.clear();  // appending moves the elements that these views look at
  const Place place = locate(path);
  if (place.kind != PlaceKind::beyond && place.kind != PlaceKind::element) return;
  const std::size_t bracket = place.rest.find('[');
  mention(*place.list, place.prefix + place.rest.substr(0, bracket));
  const std::size_t index = parse_index(place.rest, bracket)->value;
  while (place.list->size() <= index) place.list->append();
  elements_.clear();
}

void Tree::clear_list(const std::string& path) {
  elements_.clear();
  const Place place = locate(path);
  if (place.kind == PlaceKind::list) mention(*place.list, path);
  elements_.clear();
}

std::vector<Tree::Node> Tree::nodes() {
  std::vector<Node> result{{&root_, ""}};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Node node = result[i];
    for (const List& list : node.table->lists()) {
      for (std::size_t k = 0; k < list.size(); ++k) {
        const std::string prefix = fmt::format("{}{}[{}].", node.prefix, list.path, k);
        result.push_back({element(list, prefix, k), prefix});
      }
    }
  }
  return result;
}

}  // namespace rastertlm::config
