#include "src/config/nesting.h"

#include <cstddef>

namespace rastertlm::config {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  // Until `stops` says so of what stands outside of strings and comments: the line, or 0.
  template <class Stops>
  int run(const Stops& stops) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        skip_comment();
      } else if (c == '"' || c == '\'') {
        skip_string(c);
      } else {
        if (c == '.') ++dots_;
        if (stops(c, dots_)) return line_;
        if (ends_key(c)) dots_ = 0;
        if (c == '\n') ++line_;
        ++at_;
      }
    }
    return 0;
  }

 private:
  static bool ends_key(char c) {
    return c == '\n' || c == '=' || c == ',' || c == '{' || c == '}' || c == '[' || c == ']';
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  bool at_triple(char quote) const {
    return text_.size() - at_ >= 3 && text_[at_] == quote && text_[at_ + 1] == quote && text_[at_ + 2] == quote;
  }

  void skip_string(char quote) {
    const bool multi_line = at_triple(quote);
    at_ += multi_line ? 3 : 1;
    while (at_ < text_.size()) {
      if (text_[at_] == '\n') {
        if (!multi_line) return;  // not TOML: an unclosed string ends with its line
        ++line_;
      }
      if (text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
        at_ += 2;
      } else if (multi_line ? at_triple(quote) : text_[at_] == quote) {
        at_ += multi_line ? 3 : 1;
        // Up to two quotes may stand before the closing three.
        while (multi_line && at_ < text_.size() && text_[at_] == quote) ++at_;
        return;
      } else {
        ++at_;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int dots_ = 0;
};

}  // namespace

int line_of_excessive_nesting(std::string_view text) {
  return Scanner(text).run([](char, int dots) { return dots >= kMaximumKeyDepth; });
}

int line_of_foreign_character(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return Scanner(text).run([](char c, int) { return static_cast<unsigned char>(c) >= 0x80; });
}

}  // namespace rastertlm::config
