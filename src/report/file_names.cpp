#include "src/report/file_names.h"

#include <fmt/format.h>

namespace rastertlm::report {

std::string picture_name(std::uint64_t frame) { return fmt::format("frame_{:04}.png", frame); }
std::string channels_name(std::uint64_t frame) { return fmt::format("frame_{:04}.exr", frame); }
std::string error_name(std::uint64_t frame) { return fmt::format("error_{:04}.png", frame); }
std::string blame_name(std::uint64_t frame) { return fmt::format("blame_{:04}.png", frame); }

}  // namespace rastertlm::report
