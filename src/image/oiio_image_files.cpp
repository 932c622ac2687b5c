// The shared module: the only file that sees OpenImageIO. Pictures are encoded into memory, because the library's own
// writers do not report every failed write (a full disk, a file-size limit).
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>

#include "src/image/image_codec.h"

namespace rastertlm::image {
namespace {

// The EXR writer stamps the time of day unless it is told one; this is the year of the machine's paper.
constexpr const char* kDateTime = "1989:01:01 00:00:00";

constexpr std::size_t kBlockLines = 64;  // interleaved at a time

OIIO::TypeDesc native(ChannelType type) {
  switch (type) {
    case ChannelType::u8:
      return OIIO::TypeDesc::UINT8;
    case ChannelType::u32:
      return OIIO::TypeDesc::UINT32;
    case ChannelType::f32:
      return OIIO::TypeDesc::FLOAT;
  }
  return OIIO::TypeDesc::UNKNOWN;
}

OIIO::ImageSpec spec_of(const EncodeRequest& request) {
  const std::vector<Channel>& channels = *request.channels;
  const auto count = static_cast<int>(channels.size());
  OIIO::ImageSpec spec(static_cast<int>(request.columns), static_cast<int>(request.lines), count,
                       native(channels.front().type));
  spec.channelnames.clear();
  bool mixed = false;
  for (const Channel& channel : channels) {
    spec.channelnames.push_back(channel.name);
    mixed = mixed || channel.type != channels.front().type;
  }
  if (mixed)
    for (const Channel& channel : channels) spec.channelformats.push_back(native(channel.type));
  if (std::strcmp(request.format, "exr") == 0) {
    spec.attribute("DateTime", kDateTime);
    spec.attribute("compression", "zip");
  }
  return spec;
}

// Lines [begin, end) with the channels of a pixel side by side, each in its own type.
void interleave(const EncodeRequest& request, std::size_t begin, std::size_t end, std::vector<std::uint8_t>& block) {
  std::size_t pixel_bytes = 0;
  for (const Channel& channel : *request.channels) pixel_bytes += size_of(channel.type);
  block.resize((end - begin) * request.columns * pixel_bytes);
  std::size_t offset = 0;
  for (const Channel& channel : *request.channels) {
    const std::size_t bytes = size_of(channel.type);
    const std::size_t stride = channel.stride == 0 ? bytes : channel.stride;
    const auto* from = static_cast<const std::uint8_t*>(channel.data) + begin * request.columns * stride;
    std::uint8_t* to = block.data() + offset;
    for (std::size_t i = 0; i < (end - begin) * request.columns; ++i, from += stride, to += pixel_bytes)
      std::memcpy(to, from, bytes);
    offset += bytes;
  }
}

bool encode(const EncodeRequest& request, std::vector<std::uint8_t>& bytes, std::string& error) {
  // "in memory": the name only chooses the format.
  const std::string name = std::string("picture.") + request.format;
  OIIO::Filesystem::IOVecOutput memory;
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(name, &memory);
  if (!out) {
    error = OIIO::geterror();
    return false;
  }
  const OIIO::ImageSpec spec = spec_of(request);
  bool good = out->open(name, spec);
  std::vector<std::uint8_t> block;
  for (std::size_t y = 0; good && y < request.lines; y += kBlockLines) {
    const std::size_t end = std::min(y + kBlockLines, request.lines);
    interleave(request, y, end, block);
    good = out->write_scanlines(static_cast<int>(y), static_cast<int>(end), 0,
                                spec.channelformats.empty() ? spec.format : OIIO::TypeDesc(OIIO::TypeDesc::UNKNOWN),
                                block.data());
  }
  good = good && out->close();
  if (!good) {
    error = out->geterror();
    return false;
  }
  bytes = memory.buffer();
  return true;
}

bool is_kept(const OIIO::TypeDesc& type) {
  return type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT32 || type == OIIO::TypeDesc::FLOAT;
}

template <class T>
void split(const std::vector<std::uint8_t>& pixels, std::size_t offset, std::size_t pixel_bytes, std::vector<T>& out) {
  out.resize(pixels.size() / pixel_bytes);
  const std::uint8_t* from = pixels.data() + offset;
  for (std::size_t i = 0; i < out.size(); ++i, from += pixel_bytes) std::memcpy(&out[i], from, sizeof(T));
}

bool decode(const std::string& path, Image& image, std::string& error) {
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in) {
    error = OIIO::geterror();
    return false;
  }
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0) {
    error = "it holds no flat picture";
    return false;
  }
  bool as_stored = true;
  for (int c = 0; c < spec.nchannels; ++c) as_stored = as_stored && is_kept(spec.channelformat(c));
  const std::size_t pixel_bytes =
      as_stored ? spec.pixel_bytes(true) : static_cast<std::size_t>(spec.nchannels) * sizeof(float);
  image.columns = static_cast<std::size_t>(spec.width);
  image.lines = static_cast<std::size_t>(spec.height);
  std::vector<std::uint8_t> pixels(image.columns * image.lines * pixel_bytes);
  if (!in->read_image(0, 0, 0, spec.nchannels,
                      OIIO::TypeDesc(as_stored ? OIIO::TypeDesc::UNKNOWN : OIIO::TypeDesc::FLOAT), pixels.data())) {
    error = in->geterror();
    return false;
  }
  std::size_t offset = 0;
  for (int c = 0; c < spec.nchannels; ++c) {
    ReadChannel channel;
    channel.name = spec.channel_name(c);
    const OIIO::TypeDesc type = as_stored ? spec.channelformat(c) : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT);
    if (type == OIIO::TypeDesc::UINT8) {
      channel.type = ChannelType::u8;
      split(pixels, offset, pixel_bytes, channel.u8);
    } else if (type == OIIO::TypeDesc::UINT32) {
      channel.type = ChannelType::u32;
      split(pixels, offset, pixel_bytes, channel.u32);
    } else {
      split(pixels, offset, pixel_bytes, channel.f32);
    }
    offset += size_of(channel.type);
    image.channels.push_back(std::move(channel));
  }
  return true;
}

// Runs `work` and turns what it throws into a reason.
template <class Work>
bool caught(std::string& error, Work&& work) noexcept {
  try {
    OIIO::attribute("threads", 1);  // pictures are small: a pool of threads costs more to start than it saves
    if (work()) return true;
    if (error.empty()) error = "unknown reason";
  } catch (const std::exception& e) {
    error = e.what();
  } catch (...) {
    error = "unknown reason";
  }
  return false;
}

}  // namespace
}  // namespace rastertlm::image

#define RASTERTLM_EXPORT extern "C" __attribute__((visibility("default")))

RASTERTLM_EXPORT bool rastertlm_image_encode(const rastertlm::image::EncodeRequest& request,
                                             std::vector<std::uint8_t>& bytes, std::string& error) {
  return rastertlm::image::caught(error, [&] { return rastertlm::image::encode(request, bytes, error); });
}

RASTERTLM_EXPORT bool rastertlm_image_decode(const std::string& path, rastertlm::image::Image& image,
                                             std::string& error) {
  return rastertlm::image::caught(error, [&] { return rastertlm::image::decode(path, image, error); });
}
