#include "src/report/text_table.h"

#include <algorithm>
#include <cstddef>

namespace rastertlm::report {
namespace {

void add_line(std::string& text, const std::string& indent, const std::vector<Column>& columns,
              const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
  std::string line = indent;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) line += "  ";
    const std::string fill(widths[i] - cells[i].size(), ' ');
    line += columns[i].align == Align::right ? fill + cells[i] : cells[i] + fill;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  text += line + '\n';
}

}  // namespace

std::string TextTable::text() const {
  std::vector<std::string> header;
  for (const Column& column : columns_) header.push_back(column.header);
  std::vector<std::size_t> widths(columns_.size(), 0);
  const auto widen = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], cells.at(i).size());
  };
  widen(header);
  for (const auto& cells : rows_) widen(cells);
  std::vector<std::string> rule;
  rule.reserve(widths.size());
  for (const std::size_t width : widths) rule.emplace_back(width, '-');

  std::string text;
  add_line(text, indent_, columns_, header, widths);
  add_line(text, indent_, columns_, rule, widths);
  for (const auto& cells : rows_) add_line(text, indent_, columns_, cells, widths);
  return text;
}

}  // namespace rastertlm::report
