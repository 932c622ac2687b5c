// Whole files, written so that a full disk or a file-size limit is noticed.
#pragma once

#include <optional>
#include <string>

namespace rastertlm::report {

// Makes or overwrites the file. Throws OutputError with the path and the reason.
void write_text_file(const std::string& path, const std::string& text);

// The file's bytes; empty where it is missing, is no regular file or cannot be read.
std::optional<std::string> read_text_file(const std::string& path);

// "cannot write PATH: reason", for an error number.
std::string output_message(const std::string& path, int error);

}  // namespace rastertlm::report
