// What the shared module offers to image_library.cpp: encoding and decoding, nothing that touches a file that is
// written. Both sides are built together, by one compiler; no exception crosses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "src/image/image_files.h"

namespace rastertlm::image {

struct EncodeRequest {
  const char* format = "";  // "png", "exr"
  std::size_t columns = 0;
  std::size_t lines = 0;
  const std::vector<Channel>* channels = nullptr;
};

// False and a reason in `error` where it failed. They are found by name in the module, as "rastertlm_image_encode" and
// "rastertlm_image_decode".
using EncodeFunction = bool(const EncodeRequest& request, std::vector<std::uint8_t>& bytes, std::string& error);
using DecodeFunction = bool(const std::string& path, Image& image, std::string& error);

inline constexpr const char* kModuleFile = "librastertlm_image.so";
inline constexpr const char* kEncodeName = "rastertlm_image_encode";
inline constexpr const char* kDecodeName = "rastertlm_image_decode";

}  // namespace rastertlm::image
