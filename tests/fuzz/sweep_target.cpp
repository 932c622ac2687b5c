// Sweep files, beside machines and scenes that they may name.
#include "src/base/errors.h"
#include "src/explore/sweep.h"
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastertlm;
  static const fuzz::InputFolder folder;
  static const bool written = [] {
    for (const char* platform : {"imogene", "quadratic", "adaptive"})
      folder.write(std::string(platform).append(".toml"),
                   std::string("schema = 1\nplatform = \"").append(platform).append("\"\n"));
    folder.write("scene.toml",
                 "schema = 1\n[[light]]\n[[material]]\nname = \"clay\"\n[[object]]\ntype = \"triangles\"\n"
                 "material = \"clay\"\npositions = [[0, 0, 0], [1, 0, 0], [0, 0, 1]]\n");
    return true;
  }();
  static_cast<void>(written);
  const std::string file = folder.write("sweep.toml", fuzz::text_of(data, size));
  try {
    explore::read_sweep(file);
  } catch (const InputError&) {
  }
  return 0;
}
