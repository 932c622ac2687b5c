// SystemC allows one simulation a process: what simulates runs in a forked child, and what it found comes back by pipe.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <functional>
#include <stdexcept>
#include <string>

#include "src/base/errors.h"

namespace rastertlm::test {

namespace forked {

enum class Ending : char { done = 'd', input_error = 'i', model_error = 'm', failed = 'f' };

inline void write_all(int descriptor, const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    written += static_cast<std::size_t>(count);
  }
}

inline std::string read_all(int descriptor) {
  constexpr std::size_t kBuffer = 1U << 16;
  std::string bytes;
  std::array<char, kBuffer> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

inline std::string marked(Ending ending, const std::string& text) { return static_cast<char>(ending) + text; }

inline std::string outcome_of(const std::function<std::string()>& work) {
  try {
    return marked(Ending::done, work());
  } catch (const InputError& error) {
    return marked(Ending::input_error, error.what());
  } catch (const ModelError& error) {
    return marked(Ending::model_error, error.what());
  } catch (const std::exception& error) {
    return marked(Ending::failed, error.what());
  }
}

}  // namespace forked

// What `work` returned in a child of this process. Throws InputError with the text of the child's; what else the child
// threw, and a child that did not come to its end, is a std::runtime_error.
inline std::string in_child(const std::function<std::string()>& work) {
  using forked::Ending;
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    ::close(ends[0]);
    forked::write_all(ends[1], forked::outcome_of(work));
    ::_exit(0);
  }
  ::close(ends[1]);
  const std::string bytes = forked::read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (status != 0 || bytes.empty()) throw std::runtime_error("the simulating child ended early");
  std::string text = bytes.substr(1);
  switch (static_cast<Ending>(bytes[0])) {
    case Ending::done:
      return text;
    case Ending::input_error:
      throw InputError(Diagnostic{"", 0, "", text});
    case Ending::model_error:
      throw std::runtime_error("model error: " + text);
    default:
      throw std::runtime_error(text);
  }
}

}  // namespace rastertlm::test
