// SHA-256 of what was read or written, so that a result names its inputs and its files.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace rastertlm {

// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

// The same of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;
  ~Sha256();
  void update(std::string_view bytes);
  // Of everything so far. Afterwards there is nothing to update any more.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rastertlm
