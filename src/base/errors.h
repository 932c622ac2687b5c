// How the program fails. An input error lists everything that is wrong with the input at once; a model error names the
// unit and the cycle at which a rule of the model was broken; an output error says what could not be written.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace rastertlm {

enum class ExitCode : int {
  kDone = 0,
  kRequirementMissed = 1,  // done, but a stated requirement is not met
  kBadInput = 2,           // bad input or usage
  kModelBroken = 3,        // a model rule or an internal check was broken
  kOutputFailed = 4,       // could not write the output
};

// One thing that is wrong with an input. `line` 0: no line is known; an empty `key`: the whole file.
struct Diagnostic {
  std::string file;
  int line = 0;
  std::string key;
  std::string message;
};

// "file:line: key: message", leaving out what is not known.
std::string to_string(const Diagnostic& diagnostic);

class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  explicit InputError(Diagnostic diagnostic) : InputError(std::vector<Diagnostic>{std::move(diagnostic)}) {}
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// Collects what is wrong, so that the user sees all of it in one run.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic) { list_.push_back(std::move(diagnostic)); }
  bool empty() const { return list_.empty(); }
  const std::vector<Diagnostic>& list() const { return list_; }
  void throw_if_any() const;

 private:
  std::vector<Diagnostic> list_;
};

class ModelError : public std::runtime_error {
 public:
  ModelError(const std::string& unit, std::uint64_t cycle, const std::string& message);
};

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The entry of `known` nearest to `word` by edit distance, or "" where nothing is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace rastertlm
