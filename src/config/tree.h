// A table with its lists of tables, addressed by full paths: "object[0].animation[1].axis".
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "src/parameter/table.h"

namespace rastertlm::config {

enum class PlaceKind {
  parameter,  // of `table`
  table,      // a prefix of parameters or lists of `table`
  list,       // a list of `table`, the whole of it
  element,    // an element of a list of `table`, that exists
  beyond,     // an index past the end of a list of `table`
  unknown
};

struct Place {
  PlaceKind kind = PlaceKind::unknown;
  parameter::Table* table = nullptr;  // the innermost table that the path reaches
  std::string prefix;                 // of that table: "object[0]." or ""
  std::string rest;                   // the path within it
  const parameter::Parameter* parameter = nullptr;
  const parameter::List* list = nullptr;
};

class Tree {
 public:
  explicit Tree(parameter::Table& root) : root_(root) {}

  // Views of elements are kept from the first call on: no list may grow or shrink afterwards except by make_element and
  // clear_list.
  Place locate(const std::string& path);
  // Makes the element at the path, and those before it. The first mention of a list removes its default elements.
  void make_element(const std::string& path);
  void clear_list(const std::string& path);

  struct Node {
    parameter::Table* table;
    std::string prefix;
  };
  // The root and every element, outer ones before inner ones.
  std::vector<Node> nodes();

 private:
  parameter::Table* element(const parameter::List& list, const std::string& prefix, std::size_t index);
  void mention(const parameter::List& list, const std::string& full_path);

  parameter::Table& root_;
  std::unordered_map<std::string, std::unique_ptr<parameter::Table>> elements_;  // by prefix
  std::unordered_map<std::string, bool> mentioned_;                              // lists by full path
};

}  // namespace rastertlm::config
