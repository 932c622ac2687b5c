#include "src/report/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "src/base/errors.h"

namespace rastertlm::report {
namespace {

constexpr mode_t kFileMode = 0666;  // less the umask

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  int close() {
    const int result = ::close(number_);
    number_ = -1;
    return result;
  }

 private:
  int number_;
};

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

int open_to_write(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kFileMode);
  if (descriptor < 0) throw OutputError(output_message(path, errno));
  return descriptor;
}

void write_all(int descriptor, std::string_view text, const std::string& path) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw OutputError(output_message(path, count == 0 ? ENOSPC : errno));
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace

std::string output_message(const std::string& path, int error) {
  return fmt::format("cannot write {}: {}", path, std::strerror(error));
}

void write_text_file(const std::string& path, const std::string& text) {
  Descriptor file(open_to_write(path));
  write_all(file.number(), text, path);
  if (file.close() != 0) throw OutputError(output_message(path, errno));
}

void make_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("cannot write {}: {}", folder.string(), error.message()));
}

void write_whole_file(const std::string& path, const std::string& text) {
  struct stat status {};
  // A device or a pipe has no place beside it.
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return write_text_file(path, text);
  const std::string partial = fmt::format("{}.partial-{}", path, ::getpid());
  try {
    write_text_file(partial, text);
    if (::rename(partial.c_str(), path.c_str()) != 0) throw OutputError(output_message(path, errno));
  } catch (...) {
    ::unlink(partial.c_str());
    throw;
  }
}

TextFileWriter::TextFileWriter(const std::string& path) : path_(path), descriptor_(open_to_write(path)) {}

TextFileWriter::~TextFileWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TextFileWriter::append(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kBufferBytes) flush();
}

void TextFileWriter::flush() {
  write_all(descriptor_, buffer_, path_);
  digest_.update(buffer_);
  bytes_ += buffer_.size();
  buffer_.clear();
}

void TextFileWriter::close() {
  flush();
  const int result = ::close(descriptor_);
  descriptor_ = -1;
  if (result != 0) throw OutputError(output_message(path_, errno));
  sha256_ = digest_.hex();
}

std::optional<std::string> read_text_file(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t count = ::read(file.number(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace rastertlm::report
