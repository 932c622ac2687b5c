#include "modules/object_processor/object_board.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/errors.h"

namespace rastertlm::object_processor {

namespace {

constexpr std::uint32_t kMaterialMask = 0xFF;  // the line holds a material in a byte

// False where three edges bound the same side: no triangle of a scene has such edges.
bool find_borders(const HalfPlanes& planes, Borders& borders) {
  std::size_t lefts = 0;
  std::size_t rights = 0;
  for (const HalfPlane& plane : planes.planes) {
    if (plane.a == 0) continue;  // bounds lines alone
    std::size_t& count = plane.a > 0 ? lefts : rights;
    if (count == 2) return false;
    const std::size_t border = plane.a > 0 ? count : 2 + count;
    const double inverse = 1.0 / static_cast<double>(plane.a);
    borders.slope[border] = -static_cast<double>(plane.b) * inverse;
    borders.offset[border] = (-static_cast<double>(plane.c) - 0.25) * inverse;
    ++count;
  }
  constexpr double kFarAway = 1e9;
  for (; lefts < 2; ++lefts) {
    borders.slope[lefts] = 0.0;
    borders.offset[lefts] = -kFarAway;
  }
  for (; rights < 2; ++rights) {
    borders.slope[2 + rights] = 0.0;
    borders.offset[2 + rights] = kFarAway;
  }
  return true;
}

}  // namespace

ObjectBoard::ObjectBoard(const ObjectProcessorParameters& parameters, std::uint32_t processors,
                         std::uint32_t first_processor, std::uint32_t columns, std::uint32_t lines, Visit visit,
                         VectorVariant variant)
    : parameters_(parameters),
      format_(static_cast<unsigned>(parameters.word_bits)),
      prenormaliser_(parameters, variant),
      processors_(processors),
      first_processor_(first_processor),
      columns_(columns),
      lines_(lines),
      everything_(visit == Visit::everything),
      late_carry_(parameters.carry_clock == CarryClock::clock2 && parameters.slices() > 1),
      kernels_(span_kernels(variant)),
      bands_(lines),
      winner_(std::size_t{columns} + 1, 0),
      seen_(std::size_t{kBandLines} * ((columns + 63) / 64), 0) {
  for (auto& component : normal_) component.resize(columns + frame::FragmentLine::kSpare);
  if (everything_ && processors_ > 0) {
    writable(processors_ - 1, 0);
    copy();
  }
}

ObjectBoard::Loading ObjectBoard::parked_slot(std::uint32_t slot) const {
  return {to_words(parked_triangle(format_.bits())), first_processor_ + slot + 1};
}

ObjectBoard::Loading& ObjectBoard::writable(std::uint32_t slot, std::size_t index) {
  if (slot >= processors_ || index >= kWords)
    throw ModelError("object_board", 0,
                     fmt::format("bus write to slot {} word {}: the board has {} slots of {} words", slot, index,
                                 processors_, kWords));
  if (slot >= loading_.capacity()) reserve(std::size_t{slot} + 1);
  while (loading_.size() <= slot) {
    loading_.push_back(parked_slot(static_cast<std::uint32_t>(loading_.size())));
    edges_.emplace_back();
    sources_.emplace_back();
    borders_.emplace_back();
    intervals_.emplace_back();
    careful_.push_back(0);
    changed_.push_back(0);
    load(static_cast<std::uint32_t>(loading_.size() - 1));
  }
  if (changed_[slot] == 0) {
    changed_[slot] = 1;
    changes_.push_back(slot);
  }
  return loading_[slot];
}

// By a quarter at a time: a vector of its own accord would hold up to twice what it needs.
void ObjectBoard::reserve(std::size_t slots) {
  const std::size_t room = std::min<std::size_t>(processors_, std::max(slots, loading_.size() + loading_.size() / 4));
  loading_.reserve(room);
  edges_.reserve(room);
  sources_.reserve(room);
  borders_.reserve(room);
  intervals_.reserve(room);
  careful_.reserve(room);
  changed_.reserve(room);
  changes_.reserve(room);
}

void ObjectBoard::write_words(std::uint32_t slot, std::size_t index, std::span<const std::uint32_t> values) {
  if (values.empty()) return;
  ProcessorWords& words = writable(slot, index + values.size() - 1).words;
  const std::uint32_t mask = format_.mask();
  for (std::size_t i = 0; i < values.size(); ++i) words[index + i] = values[i] & mask;
  // Eight bits at least hold the material.
  if (index + values.size() == kWords) words[kMaterialIndex] &= kMaterialMask;
}

void ObjectBoard::write(std::uint32_t slot, const TriangleWords& triangle) { write_words(slot, 0, to_words(triangle)); }

void ObjectBoard::park(std::uint32_t slot) { write(slot, parked_triangle(format_.bits())); }

void ObjectBoard::set_object(std::uint32_t slot, std::uint32_t object) { writable(slot, 0).object = object; }

TriangleWords ObjectBoard::loading(std::uint32_t slot) const {
  return to_triangle(slot < loading_.size() ? loading_[slot].words : parked_slot(slot).words);
}

// The backup RAM: edges apart from what is shown where they cover.
void ObjectBoard::load(std::uint32_t slot) {
  const TriangleWords triangle = to_triangle(loading_[slot].words);
  const auto plane = [](const LinearWords& words) { return frame::WordPlane{words.a, words.b, words.c}; };
  edges_[slot] = triangle.edges;
  sources_[slot] = {plane(triangle.depth),
                    {plane(triangle.normals[0]), plane(triangle.normals[1]), plane(triangle.normals[2])},
                    triangle.material,
                    loading_[slot].object};
}

TriangleWords ObjectBoard::backup(std::uint32_t slot) const {
  if (slot >= loading_.size()) return to_triangle(parked_slot(slot).words);
  const frame::FragmentSource& source = sources_[slot];
  const auto words = [](const frame::WordPlane& plane) { return LinearWords{plane.a, plane.b, plane.c}; };
  return {edges_[slot],
          words(source.depth),
          {words(source.normal[0]), words(source.normal[1]), words(source.normal[2])},
          source.material};
}

std::uint32_t ObjectBoard::object_of_processor(std::uint32_t slot) const {
  return slot < loading_.size() ? sources_[slot].object : first_processor_ + slot + 1;
}

Interval ObjectBoard::lines_of_processor(std::uint32_t slot) const {
  return slot < intervals_.size() ? intervals_[slot] : Interval{};
}

std::uint32_t ObjectBoard::slots_in_use() const {
  const auto empty =
      std::count_if(intervals_.begin(), intervals_.end(), [](const Interval& lines) { return lines.empty(); });
  return static_cast<std::uint32_t>(intervals_.size()) - static_cast<std::uint32_t>(empty);
}

std::uint64_t ObjectBoard::memory_bytes() const {
  const std::uint64_t a_slot = sizeof(Loading) + sizeof(Edges) + sizeof(frame::FragmentSource) + sizeof(Borders) +
                               sizeof(Interval) + 2 * sizeof(std::uint8_t);
  const std::uint64_t indices = changes_.capacity() + bands_.words();
  return loading_.capacity() * a_slot + indices * sizeof(std::uint32_t) +
         spans_.capacity() * sizeof(frame::CoveredSpan) + std::uint64_t{columns_} * 4 * sizeof(std::uint32_t);
}

Interval ObjectBoard::interval_of(const Edges& edges, const HalfPlanes& planes) const {
  const Interval all{0, static_cast<std::int32_t>(lines_)};
  // A constant negative edge never covers, whatever clocks the carry: 0 added to 0 makes none.
  if (everything_) return all;
  for (const LinearWords& edge : edges)
    if (edge.a == 0 && edge.b == 0 && (edge.c >> (format_.bits() - 1)) != 0) return {};
  return late_carry_ ? all : touched_lines(planes, format_, static_cast<std::int32_t>(columns_), all.end);
}

std::uint32_t ObjectBoard::copy() {
  for (const std::uint32_t slot : changes_) {
    load(slot);
    const HalfPlanes planes =
        half_planes(edges_[slot], format_, static_cast<std::int32_t>(columns_), static_cast<std::int32_t>(lines_));
    intervals_[slot] = interval_of(edges_[slot], planes);
    // Edges along lines are in the interval alone.
    careful_count_ -= careful_[slot];
    careful_[slot] = everything_ || planes.count < 3 || !find_borders(planes, borders_[slot]) ? 1 : 0;
    careful_count_ += careful_[slot];
    changed_[slot] = 0;
  }
  const auto copied = static_cast<std::uint32_t>(changes_.size());
  if (copied > 0) bands_.sort(intervals_);
  changes_.clear();
  ready_first_ = kNone;
  return copied;
}

void ObjectBoard::check_line(std::uint32_t line, std::size_t columns) const {
  if (line >= lines_ || columns != columns_)
    throw ModelError("object_board", 0,
                     fmt::format("line {} of {} columns asked of a board of {} lines of {} columns", line, columns,
                                 lines_, columns_));
}

ObjectBoard::LineEdges ObjectBoard::line_edges(std::uint32_t slot, std::uint32_t line) const {
  LineEdges at;
  for (std::size_t edge = 0; edge < 3; ++edge) at.edges[edge] = format_.on_line(edges_[slot][edge], line);
  const frame::WordPlane& depth = sources_[slot].depth;
  at.depth = depth.b * (line + 1) + depth.c;
  at.depth_step = depth.a;
  return at;
}

}  // namespace rastertlm::object_processor
