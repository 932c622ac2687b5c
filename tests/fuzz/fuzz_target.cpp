#include "tests/fuzz/fuzz_target.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace rastertlm::fuzz {

InputFolder::InputFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "rastertlm_fuzz_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) found("no folder for inputs can be made");
  path_ = name;
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string InputFolder::write(const std::string& name, std::string_view bytes) const {
  std::string file = (path_ / name).string();
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

void found(const std::string& what) {
  std::fprintf(stderr, "FOUND: %s\n", what.c_str());
  std::abort();
}

}  // namespace rastertlm::fuzz
