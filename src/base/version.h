// Of the program. A store has results of one version alone: another may model differently.
#pragma once

namespace rastertlm {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace rastertlm
