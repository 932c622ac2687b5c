#include "src/explore/shared_pictures.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "src/base/digest.h"

namespace rastertlm::explore {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 30;  // of addresses, not of memory
constexpr std::size_t kPage = 4096;
constexpr std::size_t kKeyDigits = 64;
// Three levels and a depth in double, an object and a coverage count, region and edges: what is made of the levels is
// made again.
constexpr std::size_t kPixelBytes = 4 * sizeof(double) + 2 * sizeof(std::uint32_t) + 2;

template <class T>
unsigned char* put(unsigned char* at, const std::vector<T>& values) {
  std::memcpy(at, values.data(), values.size() * sizeof(T));
  return at + values.size() * sizeof(T);
}

template <class T>
const unsigned char* get(const unsigned char* at, std::vector<T>& values, std::size_t count) {
  values.resize(count);
  std::memcpy(values.data(), at, count * sizeof(T));
  return at + count * sizeof(T);
}

}  // namespace

struct SharedPictures::Slot {
  std::atomic<std::uint32_t> whole{0};
  std::size_t columns = 0;
  std::size_t lines = 0;
  char key[kKeyDigits] = {};
  unsigned char* pixels() { return reinterpret_cast<unsigned char*>(this) + kPage; }
};

SharedPictures::SharedPictures(const run::ExactNeeds& needs)
    : pixels_(needs.pixels), slot_bytes_((needs.pixels * kPixelBytes / kPage + 2) * kPage) {
  const std::size_t slots = std::min(needs.pictures, kMostBytes / slot_bytes_);
  if (slots == 0) return;
  void* const memory =
      ::mmap(nullptr, slots * slot_bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return;
  memory_ = memory;
  slots_ = slots;  // zeroes are slots that hold nothing
}

SharedPictures::~SharedPictures() {
  if (memory_ != nullptr) ::munmap(memory_, slots_ * slot_bytes_);
}

SharedPictures::Slot* SharedPictures::slot(std::size_t index) const {
  return std::launder(reinterpret_cast<Slot*>(static_cast<unsigned char*>(memory_) + index * slot_bytes_));
}

bool SharedPictures::read(const std::string& key, frame::ExactFrame& picture) const {
  const std::string digest = sha256_hex(key);
  for (std::size_t i = 0; i < slots_; ++i) {
    Slot& one = *slot(i);
    if (one.whole.load(std::memory_order_acquire) == 0) return false;
    if (std::memcmp(one.key, digest.data(), kKeyDigits) != 0) continue;
    picture.columns = one.columns;
    picture.lines = one.lines;
    const std::size_t pixels = picture.pixels();
    std::vector<double> levels;
    const unsigned char* at = get(one.pixels(), levels, 3 * pixels);
    picture.rgb.assign(std::move(levels));
    at = get(at, picture.depth, pixels);
    at = get(at, picture.object, pixels);
    at = get(at, picture.coverage, pixels);
    at = get(at, picture.region, pixels);
    get(at, picture.edges, pixels);
    return true;
  }
  return false;
}

void SharedPictures::write(const std::string& key, const frame::ExactFrame& picture) {
  if (picture.pixels() > pixels_) return;
  for (std::size_t i = 0; i < slots_; ++i) {
    Slot& one = *slot(i);
    if (one.whole.load(std::memory_order_acquire) != 0) continue;
    const std::string digest = sha256_hex(key);
    std::memcpy(one.key, digest.data(), kKeyDigits);
    one.columns = picture.columns;
    one.lines = picture.lines;
    unsigned char* at = put(one.pixels(), picture.rgb.values());
    at = put(at, picture.depth);
    at = put(at, picture.object);
    at = put(at, picture.coverage);
    at = put(at, picture.region);
    put(at, picture.edges);
    one.whole.store(1, std::memory_order_release);
    return;
  }
}

std::size_t SharedPictures::written_bytes() const {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < slots_ && slot(i)->whole.load(std::memory_order_acquire) != 0; ++i) bytes += slot_bytes_;
  return bytes;
}

frame::ExactFrame SharedExactStore::picture(const std::string& key, const std::function<frame::ExactFrame()>& render) {
  frame::ExactFrame picture;
  if (pictures_.read(key, picture)) return picture;
  picture = render();
  if (writes_) pictures_.write(key, picture);
  return picture;
}

}  // namespace rastertlm::explore
