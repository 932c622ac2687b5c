// Aligned columns for a reader.
#pragma once

#include <string>
#include <vector>

namespace rastertlm::report {

enum class Align { left, right };

struct Column {
  std::string header;
  Align align = Align::left;
};

class TextTable {
 public:
  explicit TextTable(std::vector<Column> columns, std::string indent = "")
      : columns_(std::move(columns)), indent_(std::move(indent)) {}
  // As many cells as columns.
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  // The header, a rule and the rows, without blanks at the ends of lines. A width counts bytes: cells are ASCII.
  std::string text() const;
  bool empty() const { return rows_.empty(); }

 private:
  std::vector<Column> columns_;
  std::string indent_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace rastertlm::report
