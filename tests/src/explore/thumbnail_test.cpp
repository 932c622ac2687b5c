// Small pictures, taken apart again as PNG (ISO/IEC 15948) says, and what a store packs.
#include "src/explore/thumbnail.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include "src/base/errors.h"
#include "src/explore/store.h"

namespace rastertlm::explore {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) number = (number << 8) | static_cast<unsigned char>(bytes.at(i));
  return number;
}

// The pixels of an 8-bit RGB file of 64 x 64 without filters; every chunk's check sum is looked at.
std::string pixels_of(const std::string& png) {
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::string packed;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = number_at(png, at);
    const std::string checked = png.substr(at + 4, size + 4);
    EXPECT_EQ(::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())),
              number_at(png, at + 8 + size));
    if (checked.starts_with("IHDR")) {
      EXPECT_EQ(number_at(checked, 4), 64U);
      EXPECT_EQ(number_at(checked, 8), 64U);
      EXPECT_EQ(checked.substr(12), std::string("\x08\x02\x00\x00\x00", 5));
    }
    if (checked.starts_with("IDAT")) packed += checked.substr(4);
    at += 12 + size;
  }
  std::string rows(64 * (1 + 3 * 64), '\0');
  uLongf made = rows.size();
  EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(rows.data()), &made, reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
            Z_OK);
  EXPECT_EQ(made, rows.size());
  std::string pixels;
  for (std::size_t row = 0; row < 64; ++row) {
    EXPECT_EQ(rows[row * 193], 0);
    pixels += rows.substr(row * 193 + 1, 192);
  }
  return pixels;
}

// 256 x 128 becomes 64 x 32 below 16 lines of black; each pixel is the mean of 4 x 4.
TEST(Thumbnail, IsTheMeanOfWhatItCovers) {
  frame::Frame frame;
  frame.resize(256, 128);
  for (std::size_t y = 0; y < 128; ++y)
    for (std::size_t x = 0; x < 256; ++x) {
      frame.rgb[3 * (y * 256 + x)] = static_cast<std::uint8_t>(x);          // mean of 4k .. 4k + 3: 4k + 1.5
      frame.rgb[3 * (y * 256 + x) + 1] = static_cast<std::uint8_t>(2 * y);  // 8k + 3
      frame.rgb[3 * (y * 256 + x) + 2] = 200;
    }
  const std::string pixels = pixels_of(thumbnail(frame));
  for (std::size_t y = 0; y < 64; ++y)
    for (std::size_t x = 0; x < 64; ++x) {
      const std::string pixel = pixels.substr(3 * (y * 64 + x), 3);
      std::string wanted(3, '\0');
      if (y >= 16 && y < 48)
        wanted = {static_cast<char>(4 * x + 2), static_cast<char>(8 * (y - 16) + 3), static_cast<char>(200)};
      ASSERT_EQ(pixel, wanted) << x << ' ' << y;
    }
}

TEST(Thumbnail, OfASmallerFrameRepeatsItsPixels) {
  frame::Frame frame;
  frame.resize(2, 2);
  frame.rgb = {10, 10, 10, 20, 20, 20, 30, 30, 30, 40, 40, 40};
  const std::string pixels = pixels_of(thumbnail(frame));
  EXPECT_EQ(pixels.front(), 10);
  EXPECT_EQ(pixels[3 * 63], 20);
  EXPECT_EQ(pixels[3 * 63 * 64], 30);
  EXPECT_EQ(pixels.back(), 40);
}

TEST(Packing, GivesBackWhatItTook) {
  for (const std::string& text : {std::string(), std::string("x"), std::string(100'000, 'a') + "end"}) {
    const std::string packed = compressed(text);
    EXPECT_TRUE(expanded(packed, "s.sqlite") == text);
    if (!text.empty()) {
      EXPECT_THROW(expanded(packed.substr(0, packed.size() - 1), "s.sqlite"), InputError);
    }
  }
  EXPECT_THROW(expanded("", "s.sqlite"), InputError);
  EXPECT_THROW(expanded("\x01\x01\x01\x01 no", "s.sqlite"), InputError);
}

}  // namespace
}  // namespace rastertlm::explore
