// Mesh files through the importer. The first line is the ending of the file's name; the rest is the file, which stands
// beside itself as what it may refer to: an OBJ file's materials, a glTF file's buffer.
#include <pthread.h>

#include <algorithm>
#include <array>

#include "src/base/errors.h"
#include "src/scene/import.h"
#include "tests/fuzz/fuzz_target.h"

// Of the sanitizers, where there are any: the name is theirs.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace rastertlm::fuzz {
namespace {

constexpr std::array<std::string_view, 5> kEndings{"obj", "ply", "stl", "gltf", "glb"};

void read(const InputFolder& folder, std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view ending = text.substr(0, end);
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) return;
  const std::string_view bytes = text.substr(std::min(end + 1, text.size()));
  for (const char* other : {"mesh.mtl", "mesh.bin"}) folder.write(other, bytes);
  const std::string file = folder.write(std::string("mesh.").append(ending), bytes);
  try {
    const scene::Mesh mesh = scene::import_mesh(file).mesh;
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= mesh.positions.size() || corner >= mesh.normals.size()) found("a triangle has no such vertex");
    if (mesh.triangles.empty()) found("a mesh of no triangle");
  } catch (const InputError&) {
  }
}

// The importer's process may end as it likes: that is what it is for, and its parent says so. The fuzzer would keep its
// input as a finding of its own.
void let_children_die() {
  if (__sanitizer_set_death_callback != nullptr)
    pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
}

}  // namespace
}  // namespace rastertlm::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastertlm;
  static const fuzz::InputFolder folder;
  [[maybe_unused]] static const bool once = (fuzz::let_children_die(), true);
  fuzz::read(folder, fuzz::text_of(data, size));
  return 0;
}
