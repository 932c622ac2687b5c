// Image files: PNG for what the display shows, EXR for everything that is known of a pixel. The library behind them is
// opened at the first call (see image_library.cpp); nothing here needs its headers. Everything throws OutputError (what
// could not be written) or InputError (what could not be read), with the path and the reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rastertlm::image {

enum class ChannelType { u8, u32, f32 };

// Bytes of a value.
constexpr std::size_t size_of(ChannelType type) { return type == ChannelType::u8 ? 1 : 4; }

// A plane to be written: values of `type`, in rows from the top left, `stride` bytes from one pixel to the next (0:
// packed). The memory belongs to the caller. EXR has u32 and f32, PNG u8; another type is refused.
struct Channel {
  std::string name;  // "R", "N.X", "object.id"
  ChannelType type = ChannelType::f32;
  const void* data = nullptr;
  std::size_t stride = 0;
};

// A plane that was read; the vector of its type holds columns * lines values.
struct ReadChannel {
  std::string name;
  ChannelType type = ChannelType::f32;
  std::vector<std::uint8_t> u8;
  std::vector<std::uint32_t> u32;
  std::vector<float> f32;
};

struct Image {
  std::size_t columns = 0;
  std::size_t lines = 0;
  std::vector<ReadChannel> channels;

  // By name, for the order in a file is not the order of writing; nullptr where there is none.
  const ReadChannel* find(const std::string& name) const;
};

// Levels, 3 a pixel. The levels are stored unchanged. Two writes of the same levels give the same bytes.
void write_png(const std::string& path, std::size_t columns, std::size_t lines, std::span<const std::uint8_t> rgb);

// The same as bytes of a file.
std::vector<std::uint8_t> encode_png(std::size_t columns, std::size_t lines, std::span<const std::uint8_t> rgb);

// Native types (integers stay exact), zip compression, a fixed date: two writes of the same values give the same bytes.
void write_exr(const std::string& path, std::size_t columns, std::size_t lines, const std::vector<Channel>& channels);

// Any format of the library. 8-bit files give u8, 32-bit integers u32, everything else f32.
Image read_image(const std::string& path);

}  // namespace rastertlm::image
