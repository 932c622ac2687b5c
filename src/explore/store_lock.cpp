#include "src/explore/store_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "src/base/errors.h"
#include "src/report/text_file.h"

namespace rastertlm::explore {
namespace {

constexpr mode_t kMode = 0666;

// A POSIX record lock: forked workers do not inherit it, and the kernel gives it back when its process is gone.
bool take(int descriptor) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return ::fcntl(descriptor, F_SETLK, &lock) == 0;
}

// Whether the file that was locked still has its name: who held it before may have removed it.
bool is_file(int descriptor, const std::string& file) {
  struct stat ours {};
  struct stat named {};
  return ::fstat(descriptor, &ours) == 0 && ::stat(file.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
         ours.st_dev == named.st_dev;
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

}  // namespace

StoreLock::StoreLock(const std::string& store) : file_(store + ".lock") {
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode);
    if (descriptor_ < 0) throw OutputError(report::output_message(file_, errno));
    if (!take(descriptor_)) {
      const std::string holder = report::read_text_file(file_).value_or("");
      ::close(descriptor_);
      throw InputError(
          Diagnostic{store, 0, "",
                     fmt::format("another explorer is at work on this store ({}); wait for it, or name another --store",
                                 holder.empty() ? "of unknown number" : holder)});
    }
    if (is_file(descriptor_, file_)) break;
    ::close(descriptor_);
  }
  const std::string text = fmt::format("process {} on {}", ::getpid(), host_name());
  if (::ftruncate(descriptor_, 0) != 0 || ::write(descriptor_, text.data(), text.size()) < 0) {
    // Who is told of the lock is not told whose it is; the lock holds all the same.
  }
}

StoreLock::~StoreLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace rastertlm::explore
