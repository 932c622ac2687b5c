// Whole files, written so that a full disk or a file-size limit is noticed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "src/base/digest.h"

namespace rastertlm::report {

// Makes or overwrites the file. Throws OutputError with the path and the reason.
void write_text_file(const std::string& path, const std::string& text);

// The same, but the file is there as a whole or stays as it was: it is written beside its place, and put there.
void write_whole_file(const std::string& path, const std::string& text);

// Makes the folders above the file that are not there. Throws OutputError.
void make_folder_of(const std::string& path);

// A file that is written piece by piece through a buffer, with the digest of its bytes. It is whole when close() has
// returned.
class TextFileWriter {
 public:
  // Makes or overwrites the file. This, append() and close() throw OutputError with the path and the reason.
  explicit TextFileWriter(const std::string& path);
  TextFileWriter(const TextFileWriter&) = delete;
  TextFileWriter& operator=(const TextFileWriter&) = delete;
  ~TextFileWriter();
  void append(std::string_view text);
  void close();

  std::uint64_t bytes() const { return bytes_; }
  // 64 hexadecimal digits, once it is closed.
  const std::string& sha256() const { return sha256_; }

 private:
  void flush();
  std::string path_;
  int descriptor_;
  std::string buffer_;
  std::uint64_t bytes_ = 0;
  Sha256 digest_;
  std::string sha256_;
};

// The file's bytes; empty where it is missing, is no regular file or cannot be read.
std::optional<std::string> read_text_file(const std::string& path);

// "cannot write PATH: reason", for an error number.
std::string output_message(const std::string& path, int error);

}  // namespace rastertlm::report
