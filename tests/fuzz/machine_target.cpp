// Machine files, and that what is taken is the same machine once it was written down as it was understood.
#include "src/run/input_files.h"
#include "tests/fuzz/fuzz_target.h"

namespace rastertlm::fuzz {
namespace {

void read_again(const InputFolder& folder, const run::Inputs& inputs) {
  try {
    const std::string file = folder.write("resolved.toml", run::resolved_machine_toml(inputs));
    if (run::config_digest(run::InputFiles().read_machine_alone(file, {})) != run::config_digest(inputs))
      found("a resolved machine is another one");
  } catch (const InputError& error) {
    found(std::string("a resolved machine is refused: ") + error.what());
  }
}

}  // namespace
}  // namespace rastertlm::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastertlm;
  static const fuzz::InputFolder folder;
  const std::string file = folder.write("machine.toml", fuzz::text_of(data, size));
  try {
    fuzz::read_again(folder, run::InputFiles().read_machine_alone(file, {}));
  } catch (const InputError&) {
  }
  return 0;
}
