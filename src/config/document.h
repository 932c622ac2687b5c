// A TOML file as a flat list of entries in the order in which they are written, each with its line.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/config/raw.h"

namespace rastertlm::config {

// `value`: a key and its value. `table`: a table was opened, "[host]", whether or not anything is in it. `element`: so
// was an element of a list of tables, "[[light]]", whose path ends in its index.
enum class EntryKind { value, table, element };

struct Entry {
  EntryKind kind = EntryKind::value;
  std::string path;  // dotted, elements by index: "light[0].towards"; a key that is not bare stands in quotes
  Raw value;         // of a `value`
  int line = 0;      // from 1
};

class Document {
 public:
  // Larger files are refused.
  static constexpr std::size_t kMaximumBytes = std::size_t{64} << 20;

  // Throws InputError, one diagnostic: the file is missing, a directory, unreadable, too large, empty (comments apart),
  // or not TOML.
  static Document from_file(const std::string& path);
  // `file` names the text in messages. Throws InputError as above.
  static Document from_text(std::string_view text, std::string file);

  const std::string& file() const { return file_; }
  const std::vector<Entry>& entries() const { return entries_; }
  // The same file without the entries that `keep` refuses: those that another reader takes.
  Document only(const std::function<bool(const Entry&)>& keep) const;
  // The `value` entry at the path, or null.
  const Entry* find(std::string_view path) const;

 private:
  std::string file_;
  std::vector<Entry> entries_;
};

// A TOML value by itself: "3", "[1, 2]", "\"text\"". Empty where the text is not one.
std::optional<Raw> parse_value(std::string_view text);

}  // namespace rastertlm::config
