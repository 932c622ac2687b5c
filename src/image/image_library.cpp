// Opens the shared module with the image library at the first call: the library costs 0.3 s and 130 MB to load, which a
// run that writes no picture does not pay.
#include <dlfcn.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "src/base/errors.h"
#include "src/image/image_codec.h"
#include "src/image/image_files.h"

namespace rastertlm::image {
namespace {

namespace fs = std::filesystem;

struct Codec {
  EncodeFunction* encode = nullptr;
  DecodeFunction* decode = nullptr;
};

// Beside the executable (a build), or where an installation puts it.
void* open_module() {
  std::error_code ignored;
  const fs::path directory = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  std::string reasons;
  for (const fs::path& path : {directory / kModuleFile, directory.parent_path() / "lib" / "rastertlm" / kModuleFile}) {
    if (void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
    const char* reason = dlerror();
    reasons += "\n  ";
    reasons += reason != nullptr ? reason : path.c_str();
  }
  throw OutputError("cannot open the image library:" + reasons);
}

Codec load() {
  void* module = open_module();  // stays open until the process ends
  const auto function = [module](const char* name) {
    void* address = dlsym(module, name);
    if (address == nullptr) throw OutputError(std::string("the image library has no function ") + name);
    return address;
  };
  return {reinterpret_cast<EncodeFunction*>(function(kEncodeName)),
          reinterpret_cast<DecodeFunction*>(function(kDecodeName))};
}

const Codec& codec() {
  static const Codec loaded = load();
  return loaded;
}

// Beyond a file-size limit a write raises SIGXFSZ, which would end the process; ignored, the write fails and can be
// reported.
class FileSizeSignalIgnored {
 public:
  FileSizeSignalIgnored() {
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &ignore, &before_);
  }
  ~FileSizeSignalIgnored() { sigaction(SIGXFSZ, &before_, nullptr); }
  FileSizeSignalIgnored(const FileSizeSignalIgnored&) = delete;
  FileSizeSignalIgnored& operator=(const FileSizeSignalIgnored&) = delete;

 private:
  struct sigaction before_ = {};
};

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw OutputError(path + ": cannot be written: " + reason);
}

// What was written so far goes, unless it is something like /dev/full.
[[noreturn]] void fail_and_remove(const std::string& path, const std::string& reason) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) fs::remove(path, ignored);
  fail(path, reason);
}

void write_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  const FileSizeSignalIgnored guard;
  const auto reason = [] { return std::generic_category().message(errno); };
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(path, reason());
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
  const std::string write_reason = reason();
  errno = 0;
  const bool closed = std::fclose(file) == 0;  // a network file system reports here what it could not store
  if (!written) fail_and_remove(path, write_reason);
  if (!closed) fail_and_remove(path, reason());
}

std::vector<std::uint8_t> encode(const std::string& name, const EncodeRequest& request) {
  if (request.columns == 0 || request.lines == 0 || request.channels->empty())
    throw std::invalid_argument("an image without pixels is written");
  std::vector<std::uint8_t> bytes;
  std::string error;
  if (!codec().encode(request, bytes, error)) fail(name, error);
  return bytes;
}

std::vector<std::uint8_t> encode_png(const std::string& name, std::size_t columns, std::size_t lines,
                                     std::span<const std::uint8_t> rgb) {
  if (rgb.size() != 3 * columns * lines)
    throw std::invalid_argument("a picture's size differs from its number of levels");
  std::vector<Channel> channels;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) channels.push_back({names[c], ChannelType::u8, rgb.data() + c, 3});
  return encode(name, {"png", columns, lines, &channels});
}

}  // namespace

const ReadChannel* Image::find(const std::string& name) const {
  for (const ReadChannel& channel : channels)
    if (channel.name == name) return &channel;
  return nullptr;
}

void write_png(const std::string& path, std::size_t columns, std::size_t lines, std::span<const std::uint8_t> rgb) {
  write_file(path, encode_png(path, columns, lines, rgb));
}

std::vector<std::uint8_t> encode_png(std::size_t columns, std::size_t lines, std::span<const std::uint8_t> rgb) {
  return encode_png("a picture", columns, lines, rgb);
}

void write_exr(const std::string& path, std::size_t columns, std::size_t lines, const std::vector<Channel>& channels) {
  for (const Channel& channel : channels)
    if (channel.type == ChannelType::u8) throw std::invalid_argument("EXR has no 8-bit channels: " + channel.name);
  write_file(path, encode(path, {"exr", columns, lines, &channels}));
}

Image read_image(const std::string& path) {
  Image image;
  std::string error;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw InputError(Diagnostic{path, 0, "", "there is no such file"});
  if (!codec().decode(path, image, error))
    throw InputError(Diagnostic{path, 0, "", "cannot be read as a picture: " + error});
  return image;
}

}  // namespace rastertlm::image
