#include "modules/frame_store/frame_store.h"

#include <algorithm>
#include <cstring>

namespace rastertlm::frame_store {

FrameStore::FrameStore(const FrameStoreParameters& parameters, const Format& format, VectorVariant variant)
    : parameters_(parameters),
      format_(format),
      background_(format.background[0] | std::uint32_t{format.background[1]} << 8 |
                  std::uint32_t{format.background[2]} << 16),
      kernels_(store_kernels(variant)),
      two_(parameters.buffers == 2 && (!parameters.clear || parameters.changes_while_shown())) {
  for (std::uint32_t x = 0; x < format.columns; ++x)
    blank_line_.insert(blank_line_.end(), format.background.begin(), format.background.end());
  resize(buffers_[0]);
  if (two_) resize(buffers_[1]);
}

void FrameStore::resize(Buffer& buffer) const {
  const std::size_t pixels = std::size_t{format_.columns} * format_.lines + kSparePixels;
  buffer.levels.resize(pixels);
  buffer.depth.resize(pixels);
  buffer.blank.assign(format_.lines, 1);
  if (format_.keep == Keep::nothing) return;
  buffer.objects.resize(pixels);
  buffer.materials.resize(pixels);
  if (format_.keep == Keep::everything) buffer.coverage.resize(pixels);
}

void FrameStore::clear() {
  Buffer& buffer = buffers_[drawn_];
  std::fill(buffer.blank.begin(), buffer.blank.end(), std::uint8_t{1});
}

void FrameStore::clear(std::uint32_t line) { buffers_[drawn_].blank[line] = 1; }

void FrameStore::begin_line(Buffer& buffer, std::size_t line) const {
  buffer.blank[line] = 0;
  const auto set = [&](std::vector<std::uint32_t>& plane, std::uint32_t value) {
    if (!plane.empty()) kernels_.fill(plane.data() + line * format_.columns, format_.columns, value);
  };
  set(buffer.levels, background_);
  set(buffer.depth, format_.farthest);
  for (auto* plane : {&buffer.objects, &buffer.materials, &buffer.coverage}) set(*plane, 0);
}

std::uint32_t FrameStore::draw(std::span<const span_unit::Span> spans, std::uint32_t object, std::uint32_t material,
                               std::uint64_t* won) {
  StoreRequest request;
  request.object = object;
  request.material = material;
  request.won = won;
  return draw(request, spans);
}

std::uint32_t FrameStore::draw_levels(std::span<const span_unit::Span> spans, std::span<const std::uint32_t> levels,
                                      std::uint32_t object, std::uint32_t material, std::uint64_t* won) {
  given_.resize(std::max(given_.size(), levels.size() + kSparePixels));
  std::copy(levels.begin(), levels.end(), given_.begin());
  StoreRequest request;
  request.given_levels = given_.data();
  request.object = object;
  request.material = material;
  request.won = won;
  return draw(request, spans);
}

std::uint32_t FrameStore::draw(StoreRequest& request, std::span<const span_unit::Span> spans) {
  Buffer& buffer = buffers_[drawn_];
  std::uint64_t pixels = 0;
  for (const span_unit::Span& span : spans) pixels += span.count;
  // Seldom is any line the first into which something is drawn.
  if (!spans.empty() && std::memchr(buffer.blank.data() + spans.front().line, 1, spans.size()) != nullptr)
    for (const span_unit::Span& span : spans)
      if (span.count > 0 && buffer.blank[span.line] != 0) begin_line(buffer, span.line);
  request.spans = spans.data();
  request.count = spans.size();
  request.pixels = format_.pixels;
  request.test = parameters_.depth_test;
  request.columns = format_.columns;
  request.levels = buffer.levels.data();
  request.depths = buffer.depth.data();
  if (!buffer.objects.empty()) {
    request.ties = format_.ties;
    request.objects = buffer.objects.data();
    request.materials = buffer.materials.data();
  }
  const std::uint64_t kept = kernels_.draw(request);
  if (!buffer.coverage.empty())
    for (const span_unit::Span& span : spans) {
      std::uint32_t* const covered = buffer.coverage.data() + std::size_t{span.line} * format_.columns + span.column;
      for (std::size_t x = 0; x < span.count; ++x) ++covered[x];
    }
  counters_.fragments_in += pixels;
  counters_.fragments_kept += kept;
  counters_.fragments_hidden += pixels - kept;
  return static_cast<std::uint32_t>(kept);
}

void FrameStore::swap() {
  if (two_) drawn_ = 1 - drawn_;
}

void FrameStore::scan_out(std::uint32_t line, frame::RgbLine& out) const {
  const Buffer& buffer = shown();
  if (buffer.blank[line] == 0) {
    kernels_.pack(buffer.levels.data() + std::size_t{line} * format_.columns, format_.columns, out.levels.data());
    return;
  }
  std::copy(blank_line_.begin(), blank_line_.end(), out.levels.begin());
}

void FrameStore::observe(frame::Frame& out) const {
  if (!parameters_.changes_while_shown()) return copy_lines(0, format_.lines, out);
  out.depth = noted_.depth;
  out.object = noted_.object;
  out.material = noted_.material;
  out.coverage = noted_.coverage;
}

void FrameStore::note_line(std::uint32_t line) { copy_lines(line, line + 1, noted_); }

void FrameStore::copy_lines(std::size_t begin, std::size_t end, frame::Frame& out) const {
  const Buffer& buffer = shown();
  const std::size_t columns = format_.columns;
  const auto copy = [&](const std::vector<std::uint32_t>& from, std::uint32_t blank, std::vector<std::uint32_t>& to) {
    if (from.empty()) return;
    to.resize(columns * format_.lines);
    for (std::size_t line = begin; line < end; ++line)
      if (buffer.blank[line] != 0)
        std::fill_n(to.data() + line * columns, columns, blank);
      else
        std::copy_n(from.data() + line * columns, columns, to.data() + line * columns);
  };
  copy(buffer.depth, format_.farthest, out.depth);
  copy(buffer.objects, 0, out.object);
  copy(buffer.materials, 0, out.material);
  copy(buffer.coverage, 0, out.coverage);
}

}  // namespace rastertlm::frame_store
