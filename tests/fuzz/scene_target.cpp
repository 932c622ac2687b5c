// Scene files, and that what is taken is the same scene once it was written down as it was understood.
#include "src/run/input_files.h"
#include "tests/fuzz/fuzz_target.h"

namespace rastertlm::fuzz {
namespace {

run::Inputs read(const InputFolder& folder, const std::string& scene) {
  static const std::string machine = folder.write("machine.toml", "schema = 1\nplatform = \"quadratic\"\n");
  return run::InputFiles().read(machine, scene, {});
}

void read_again(const InputFolder& folder, const run::Inputs& inputs) {
  try {
    const std::string file = folder.write("resolved.toml", run::resolved_scene_toml(inputs));
    if (run::scene_digest(read(folder, file)) != run::scene_digest(inputs)) found("a resolved scene is another one");
  } catch (const InputError& error) {
    found(std::string("a resolved scene is refused: ") + error.what());
  }
}

}  // namespace
}  // namespace rastertlm::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastertlm;
  static const fuzz::InputFolder folder;
  // A mesh that scenes may name.
  static const std::string mesh = folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const std::string file = folder.write("scene.toml", fuzz::text_of(data, size));
  try {
    fuzz::read_again(folder, fuzz::read(folder, file));
  } catch (const InputError&) {
  }
  return 0;
}
