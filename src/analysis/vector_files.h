// The files of a frame's vectors: each is written as it comes, and listed with its digest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/report/output_directory.h"
#include "src/report/text_file.h"
#include "src/report/vectors_manifest.h"

namespace rastertlm::analysis {

class VectorFiles {
 public:
  // The directory outlives it.
  explicit VectorFiles(const report::OutputDirectory& directory) : directory_(directory) {}

  // Throw OutputError. `fill` appends to the writer that it is given.
  void write(const std::string& name, const std::string& text) {
    stream(name, [&](report::TextFileWriter& file) { file.append(text); });
  }
  template <class Fill>
  void stream(const std::string& name, const Fill& fill) {
    report::TextFileWriter file(directory_.path(name));
    fill(file);
    file.close();
    list_.push_back({name, file.bytes(), file.sha256()});
  }

  const std::vector<report::VectorsFile>& list() const { return list_; }

 private:
  const report::OutputDirectory& directory_;
  std::vector<report::VectorsFile> list_;
};

// A word of `bits` as $readmemh takes it: hexadecimal, with leading zeros.
std::string hex_word(std::uint32_t word, unsigned bits);

// One word a line, in address order.
template <class Words>
std::string hex_text(const Words& words, unsigned bits) {
  std::string text;
  for (const auto word : words) (text += hex_word(static_cast<std::uint32_t>(word), bits)) += '\n';
  return text;
}

}  // namespace rastertlm::analysis
