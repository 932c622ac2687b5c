#include "modules/frame_store/frame_store.h"

#include <algorithm>

namespace rastertlm::frame_store {

FrameStore::FrameStore(const FrameStoreParameters& parameters, const Format& format, VectorVariant variant)
    : parameters_(parameters),
      format_(format),
      background_(format.background[0] | std::uint32_t{format.background[1]} << 8 |
                  std::uint32_t{format.background[2]} << 16),
      kernels_(store_kernels(variant)) {
  resize(buffers_[0]);
  if (parameters.buffers == 2) resize(buffers_[1]);
}

void FrameStore::resize(Buffer& buffer) const {
  const std::size_t pixels = std::size_t{format_.columns} * format_.lines + kSparePixels;
  buffer.levels.assign(pixels, background_);
  buffer.depth.assign(pixels, format_.farthest);
  if (format_.keep == Keep::nothing) return;
  buffer.objects.assign(pixels, 0);
  buffer.materials.assign(pixels, 0);
  if (format_.keep == Keep::everything) buffer.coverage.assign(pixels, 0);
}

void FrameStore::clear() {
  Buffer& buffer = buffers_[drawn_];
  std::fill(buffer.levels.begin(), buffer.levels.end(), background_);
  std::fill(buffer.depth.begin(), buffer.depth.end(), format_.farthest);
  for (auto* plane : {&buffer.objects, &buffer.materials, &buffer.coverage})
    std::fill(plane->begin(), plane->end(), 0U);
}

std::uint32_t FrameStore::draw(const span_unit::Span& span, std::uint32_t object, std::uint32_t material,
                               std::uint64_t* won) {
  Buffer& buffer = buffers_[drawn_];
  const std::size_t at = std::size_t{span.line} * format_.columns + span.column;
  StoreRequest request;
  request.levels = span.levels;
  request.depths = span.depths;
  request.count = span.count;
  request.object = object;
  request.material = material;
  request.test = parameters_.depth_test;
  request.won = won;
  request.stored_levels = buffer.levels.data() + at;
  request.stored_depths = buffer.depth.data() + at;
  if (!buffer.objects.empty()) {
    request.ties = true;
    request.stored_objects = buffer.objects.data() + at;
    request.stored_materials = buffer.materials.data() + at;
  }
  const auto kept = static_cast<std::uint32_t>(kernels_.draw(request));
  if (!buffer.coverage.empty())
    for (std::size_t x = 0; x < span.count; ++x) ++buffer.coverage[at + x];
  counters_.fragments_in += span.count;
  counters_.fragments_kept += kept;
  counters_.fragments_hidden += span.count - kept;
  return kept;
}

void FrameStore::swap() {
  if (parameters_.buffers == 2) drawn_ = 1 - drawn_;
}

void FrameStore::scan_out(std::uint32_t line, frame::RgbLine& out) const {
  const Buffer& buffer = buffers_[parameters_.buffers == 2 ? 1 - drawn_ : drawn_];
  const std::uint32_t* __restrict levels = buffer.levels.data() + std::size_t{line} * format_.columns;
  std::uint8_t* __restrict rgb = out.levels.data();
  for (std::size_t x = 0; x < format_.columns; ++x) {
    rgb[3 * x] = static_cast<std::uint8_t>(levels[x]);
    rgb[3 * x + 1] = static_cast<std::uint8_t>(levels[x] >> 8);
    rgb[3 * x + 2] = static_cast<std::uint8_t>(levels[x] >> 16);
  }
}

void FrameStore::observe(frame::Frame& out) const {
  const Buffer& buffer = buffers_[parameters_.buffers == 2 ? 1 - drawn_ : drawn_];
  const std::size_t pixels = std::size_t{format_.columns} * format_.lines;
  const auto copy = [pixels](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) {
    if (from.empty()) return;
    to.assign(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(pixels));
  };
  copy(buffer.depth, out.depth);
  copy(buffer.objects, out.object);
  copy(buffer.materials, out.material);
  copy(buffer.coverage, out.coverage);
}

}  // namespace rastertlm::frame_store
