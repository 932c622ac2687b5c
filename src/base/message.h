// Numbers and texts as bytes, from a process to the one that forked it: both are one program on one machine, so that
// numbers go as they are.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace rastertlm {

template <class T>
void put(std::string& message, const T& number) {
  static_assert(std::is_trivially_copyable_v<T>);
  message.append(reinterpret_cast<const char*>(&number), sizeof number);
}
inline void put(std::string& message, const std::string& text) {
  put(message, static_cast<std::uint64_t>(text.size()));
  message += text;
}
template <class T>
void put(std::string& message, const std::vector<T>& numbers) {
  static_assert(std::is_trivially_copyable_v<T>);
  put(message, static_cast<std::uint64_t>(numbers.size()));
  message.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

// Takes in the order in which was put. Throws std::out_of_range where the message ends before.
class Unpacker {
 public:
  explicit Unpacker(const std::string& message) : message_(message) {}

  template <class T>
  T number() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::string text() {
    const auto size = number<std::uint64_t>();
    return {take(size), size};
  }
  template <class T>
  std::vector<T> numbers() {
    const auto count = number<std::uint64_t>();
    if (count > left() / sizeof(T)) throw std::out_of_range("a message between processes is short");
    std::vector<T> values(count);
    const char* const bytes = take(count * sizeof(T));
    if (count > 0) std::memcpy(values.data(), bytes, count * sizeof(T));
    return values;
  }

 private:
  std::uint64_t left() const { return message_.size() - at_; }
  const char* take(std::uint64_t size) {
    if (left() < size) throw std::out_of_range("a message between processes is short");
    at_ += size;
    return message_.data() + at_ - size;
  }

  const std::string& message_;
  std::size_t at_ = 0;
};

}  // namespace rastertlm
