// zlib, as a store has its reports and pictures.
#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cstdint>

#include "src/base/errors.h"
#include "src/explore/store.h"
#include "src/explore/thumbnail.h"

namespace rastertlm::explore {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;  // of one text

void put_number(std::string& bytes, std::uint32_t number) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>((number >> shift) & 0xffU);
}

const Bytef* bytes_of(const std::string& text) { return reinterpret_cast<const Bytef*>(text.data()); }

// A chunk of a PNG file: length, name, contents, check sum of name and contents.
void put_chunk(std::string& png, const std::string& name, const std::string& contents) {
  put_number(png, static_cast<std::uint32_t>(contents.size()));
  const std::string checked = name + contents;
  png += checked;
  put_number(png, static_cast<std::uint32_t>(
                      ::crc32(::crc32(0, nullptr, 0), bytes_of(checked), static_cast<uInt>(checked.size()))));
}

}  // namespace

// The size stands before the bytes, so that they are had back at once.
std::string compressed(const std::string& bytes) {
  uLongf size = ::compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_of(bytes), static_cast<uLong>(bytes.size()),
                  Z_BEST_SPEED) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  std::string result;
  put_number(result, static_cast<std::uint32_t>(bytes.size()));
  return result + packed;
}

std::string expanded(const std::string& bytes, const std::string& file) {
  constexpr std::size_t kHead = 4;
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < std::min(kHead, bytes.size()); ++i)
    size = (size << 8) | static_cast<unsigned char>(bytes[i]);
  std::string text(std::min<std::size_t>(size, kMostBytes), '\0');
  uLongf made = static_cast<uLongf>(text.size());
  const bool good = bytes.size() >= kHead &&
                    ::uncompress(reinterpret_cast<Bytef*>(text.data()), &made, bytes_of(bytes) + kHead,
                                 static_cast<uLong>(bytes.size() - kHead)) == Z_OK &&
                    made == size;
  if (!good) throw InputError(Diagnostic{file, 0, "", "the store is damaged: a report in it cannot be read"});
  return text;
}

std::string png_of(const std::vector<std::uint8_t>& rgb, std::size_t columns, std::size_t lines) {
  std::string rows;
  for (std::size_t line = 0; line < lines; ++line) {
    rows += '\0';  // no filter
    rows.append(reinterpret_cast<const char*>(rgb.data()) + line * 3 * columns, 3 * columns);
  }
  uLongf size = ::compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_of(rows), static_cast<uLong>(rows.size()),
                  Z_BEST_SPEED) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  std::string head;
  put_number(head, static_cast<std::uint32_t>(columns));
  put_number(head, static_cast<std::uint32_t>(lines));
  head += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB, deflate, no filter method but 0, not interlaced
  std::string png = "\x89PNG\r\n\x1a\n";
  put_chunk(png, "IHDR", head);
  put_chunk(png, "IDAT", packed);
  put_chunk(png, "IEND", "");
  return png;
}

}  // namespace rastertlm::explore
