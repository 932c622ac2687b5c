// A fuzz target reads bytes exactly as the program reads a file, and takes a documented refusal for an answer. Whatever
// else comes of it is a finding: it ends the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

// libFuzzer's name for it; 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace rastertlm::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// A folder of this process, in which the bytes stand as the file that the program is given. It goes with the process.
class InputFolder {
 public:
  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  std::string write(const std::string& name, std::string_view bytes) const;  // the file's path
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Says what must not be, and ends the process.
[[noreturn]] void found(const std::string& what);

}  // namespace rastertlm::fuzz
