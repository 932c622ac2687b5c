#include "src/config/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "src/base/errors.h"
#include "src/config/nesting.h"

namespace rastertlm::config {
namespace {

bool is_bare(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string key_text(std::string_view key) {
  if (is_bare(key)) return std::string(key);
  std::string text = "\"";
  for (const char c : key) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return text + '"';
}

Raw to_raw(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::integer:
      return {node.as_integer()->get()};
    case toml::node_type::floating_point:
      return {node.as_floating_point()->get()};
    case toml::node_type::boolean:
      return {node.as_boolean()->get()};
    case toml::node_type::string:
      return {node.as_string()->get()};
    case toml::node_type::array: {
      RawList list;
      list.reserve(node.as_array()->size());
      for (const toml::node& element : *node.as_array()) list.push_back(to_raw(element));
      return {std::move(list)};
    }
    case toml::node_type::table:
      return {Unusable{"a table"}};
    default:
      return {Unusable{"a date or a time"}};
  }
}

bool is_list_of_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && !array->empty() && array->is_homogeneous(toml::node_type::table);
}

struct Placed {
  Entry entry;
  toml::source_position position;
};

class Flattener {
 public:
  std::vector<Entry> flatten(const toml::table& root) {
    add_table("", root);
    // toml++ keeps keys in alphabetical order; messages go in the order of the file. Stable: parents were placed before
    // children.
    std::stable_sort(placed_.begin(), placed_.end(), [](const Placed& a, const Placed& b) {
      return std::pair(a.position.line, a.position.column) < std::pair(b.position.line, b.position.column);
    });
    std::vector<Entry> entries;
    entries.reserve(placed_.size());
    for (Placed& p : placed_) entries.push_back(std::move(p.entry));
    return entries;
  }

 private:
  void place(EntryKind kind, const std::string& path, Raw value, toml::source_position position) {
    placed_.push_back({{kind, path, std::move(value), static_cast<int>(position.line)}, position});
  }

  void add_table(const std::string& prefix, const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix + key_text(key.str());
      const toml::source_position position = key.source().begin;
      if (const toml::table* inner = node.as_table()) {
        place(EntryKind::table, path, {}, position);
        add_table(path + '.', *inner);
      } else if (is_list_of_tables(node)) {
        std::size_t index = 0;
        for (const toml::node& element : *node.as_array()) {
          const std::string element_path = fmt::format("{}[{}]", path, index++);
          place(EntryKind::element, element_path, {}, element.source().begin);
          add_table(element_path + '.', *element.as_table());
        }
      } else {
        place(EntryKind::value, path, to_raw(node), position);
      }
    }
  }

  std::vector<Placed> placed_;
};

[[noreturn]] void refuse(const std::string& file, int line, std::string message) {
  throw InputError(Diagnostic{file, line, "", std::move(message)});
}

std::string read_bytes(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse(path, 0, "no such file");
  if (status.type() == fs::file_type::directory) refuse(path, 0, "is a directory, a TOML file is expected");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, 0, "cannot be opened for reading");
  // Read in pieces, one byte past the limit at most: the size of a pipe or a device is not known beforehand.
  std::string bytes;
  std::string piece(std::size_t{1} << 16, '\0');
  try {
    stream.exceptions(std::ios::badbit);
    while (stream && bytes.size() <= Document::kMaximumBytes) {
      stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      bytes.append(piece, 0, static_cast<std::size_t>(stream.gcount()));
    }
  } catch (const std::ios::failure&) {
    refuse(path, 0, "cannot be read");
  }
  if (bytes.size() > Document::kMaximumBytes)
    refuse(path, 0, fmt::format("is larger than {} MiB", Document::kMaximumBytes >> 20));
  return bytes;
}

}  // namespace

Document Document::from_file(const std::string& path) { return from_text(read_bytes(path), path); }

Document Document::from_text(std::string_view text, std::string file) {
  Document document;
  document.file_ = std::move(file);
  if (const int line = line_of_excessive_nesting(text); line > 0)
    refuse(document.file_, line, fmt::format("keys are nested more than {} deep", kMaximumKeyDepth));
  if (const int line = line_of_foreign_character(text); line > 0)
    refuse(document.file_, line, "not valid TOML: a character beyond ASCII outside of strings and comments");
  try {
    document.entries_ = Flattener().flatten(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    refuse(document.file_, static_cast<int>(at.line),
           fmt::format("not valid TOML (column {}): {}", at.column, error.description()));
  }
  if (document.entries_.empty()) refuse(document.file_, 0, "is empty: there is no key in it");
  return document;
}

Document Document::only(const std::function<bool(const Entry&)>& keep) const {
  Document document;
  document.file_ = file_;
  std::copy_if(entries_.begin(), entries_.end(), std::back_inserter(document.entries_), keep);
  return document;
}

const Entry* Document::find(std::string_view path) const {
  for (const Entry& entry : entries_)
    if (entry.kind == EntryKind::value && entry.path == path) return &entry;
  return nullptr;
}

std::optional<Raw> parse_value(std::string_view text) {
  if (line_of_excessive_nesting(text) > 0 || line_of_foreign_character(text) > 0) return std::nullopt;
  try {
    const toml::table table = toml::parse(fmt::format("v = {}\n", text));
    if (table.size() != 1 || !table.contains("v")) return std::nullopt;
    return to_raw(*table.get("v"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace rastertlm::config
