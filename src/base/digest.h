// SHA-256 of what was read, so that a result names its inputs.
#pragma once

#include <string>
#include <string_view>

namespace rastertlm {

// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace rastertlm
