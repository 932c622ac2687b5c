// Files of configs/hard_cases.
#include "src/analysis/hard_case.h"
#include "src/base/errors.h"
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rastertlm;
  static const fuzz::InputFolder folder;
  const std::string file = folder.write("case.toml", fuzz::text_of(data, size));
  try {
    analysis::read_hard_case(file);
  } catch (const InputError&) {
  }
  return 0;
}
