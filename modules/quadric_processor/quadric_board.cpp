#include "modules/quadric_processor/quadric_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "src/base/errors.h"

namespace rastertlm::quadric_processor {

static_assert(kRayCaps == kMostCaps && kNearPlaneFace + 1 == frame::kMostFaces);
static_assert(static_cast<int>(RayCapKeeps::side) == static_cast<int>(CapKeeps::side));
static_assert(static_cast<int>(RayKind::all) == static_cast<int>(RayPart::all));

namespace {

// Room for what is written of columns.
std::size_t words_of(const Interval& columns) {
  return static_cast<std::size_t>(columns.end - columns.begin) + kRaySpare;
}

}  // namespace

QuadricBoard::QuadricBoard(const QuadricParameters& parameters, const QuadricScreen& screen, std::uint32_t processors,
                           std::uint32_t first_processor, Visit visit, VectorVariant variant)
    : parameters_(parameters),
      screen_(screen),
      root_(parameters.root()),
      processors_(processors),
      first_processor_(first_processor),
      everything_(visit == Visit::everything),
      kernel_(ray_kernel(variant)),
      bands_(screen.lines),
      seen_(screen.columns / 64 + 2, 0) {
  if (everything_ && processors_ > 0) {
    writable(processors_ - 1, 0);
    copy();
  }
}

QuadricBoard::Slot& QuadricBoard::writable(std::uint32_t slot, std::size_t index) {
  if (slot >= processors_ || index >= words_a_slot())
    throw ModelError("quadric_board", 0,
                     fmt::format("bus write to slot {} word {}: the board has {} slots of {} words", slot, index,
                                 processors_, words_a_slot()));
  while (slots_.size() <= slot) {
    const auto number = static_cast<std::uint32_t>(slots_.size());
    Slot& added = slots_.emplace_back();
    added.loading = to_image(parked_quadric(static_cast<unsigned>(parameters_.word_bits)));
    added.object = first_processor_ + number + 1;
    load(added);
    intervals_.emplace_back();
    if (everything_) {
      added.changed = true;
      changes_.push_back(number);
    }
  }
  if (!slots_[slot].changed) {
    slots_[slot].changed = true;
    changes_.push_back(slot);
  }
  return slots_[slot];
}

void QuadricBoard::write_words(std::uint32_t slot, std::size_t index, std::span<const std::uint32_t> values) {
  if (values.empty()) return;
  Slot& target = writable(slot, index + values.size() - 1);
  std::copy(values.begin(), values.end(), target.loading.begin() + static_cast<std::ptrdiff_t>(index));
}

void QuadricBoard::write(std::uint32_t slot, const QuadricWords& words) {
  const QuadricImage image = to_image(words);
  write_words(slot, 0, std::span(image).first(words_a_slot()));
}

void QuadricBoard::set_object(std::uint32_t slot, std::uint32_t object) { writable(slot, 0).object = object; }

// A register holds as many bits as it has.
void QuadricBoard::keep_widths(QuadricWords& words) const {
  const std::uint64_t word = low_mask(static_cast<unsigned>(parameters_.word_bits));
  for (std::uint64_t* value : {&words.discriminant.v0, &words.discriminant.dy, &words.discriminant.two_b,
                               &words.discriminant.d0, &words.discriminant.c, &words.discriminant.two_a})
    *value &= word;
  const std::uint64_t plane = low_mask(static_cast<unsigned>(parameters_.plane_bits));
  const auto narrow = [plane](PlaneWords& planes) { planes = {planes.a & plane, planes.b & plane, planes.c & plane}; };
  narrow(words.middle);
  const auto normal = static_cast<std::uint32_t>(low_mask(screen_.depth_bits));
  for (LinearWords& words_of : words.normal) words_of = {words_of.a & normal, words_of.b & normal, words_of.c & normal};
  for (std::int32_t& factor : words.normal_of_root)
    factor = static_cast<std::int32_t>(sign_extended(static_cast<std::uint64_t>(std::int64_t{factor}),
                                                     static_cast<unsigned>(parameters_.multiplier_bits)));
  for (std::size_t i = 0; i < kMostCaps; ++i) {
    if (i >= static_cast<std::size_t>(parameters_.caps)) words.caps[i] = {};
    narrow(words.caps[i].plane);
    for (std::uint32_t& component : words.caps[i].normal) component &= normal;
  }
}

void QuadricBoard::load(Slot& slot) const {
  slot.words = to_quadric(std::span<const std::uint32_t, kMostWords>(slot.loading));
  keep_widths(slot.words);
  const QuadricWords& words = slot.words;
  const auto word_bits = static_cast<unsigned>(parameters_.word_bits);
  const SecondOrderWords& d = words.discriminant;
  slot.parked =
      words.part != RayPart::outside && (d.dy | d.two_b | d.d0 | d.c | d.two_a) == 0 && (d.v0 >> (word_bits - 1)) != 0;
  frame::SolidSource& source = slot.source;
  source = {};
  for (std::size_t i = 0; i < 3; ++i) {
    source.middle.normal[i] = {words.normal[i].a, words.normal[i].b, words.normal[i].c};
    source.normal_of_root[i] = words.normal_of_root[i];
    for (std::size_t cap = 0; cap < kMostCaps; ++cap) source.face_normal[cap][i] = words.caps[cap].normal[i];
  }
  source.face_normal[kNearPlaneFace][2] = 1U << (screen_.depth_bits - 2);
  source.fraction_bits = static_cast<std::uint32_t>(parameters_.multiplier_bits) - kMultiplierInteger;
  source.middle.material = words.material;
  source.middle.object = slot.object;
}

std::uint32_t QuadricBoard::copy() {
  const Interval all{0, static_cast<std::int32_t>(screen_.lines)};
  for (const std::uint32_t number : changes_) {
    Slot& slot = slots_[number];
    load(slot);
    slot.changed = false;
    intervals_[number] = {};
    if (!slot.parked) {
      slot.region = SolidRegion(slot.words, parameters_, screen_.range, static_cast<std::int32_t>(screen_.columns),
                                static_cast<std::int32_t>(screen_.lines));
      intervals_[number] = slot.region.lines();
    }
    if (everything_) intervals_[number] = all;
  }
  const auto copied = static_cast<std::uint32_t>(changes_.size());
  if (copied > 0) bands_.sort(intervals_);
  changes_.clear();
  band_ = kNoBand;
  return copied;
}

QuadricWords QuadricBoard::backup(std::uint32_t slot) const {
  return slot < slots_.size() ? slots_[slot].words : parked_quadric(static_cast<unsigned>(parameters_.word_bits));
}

Interval QuadricBoard::lines_of_processor(std::uint32_t slot) const {
  return slot < intervals_.size() ? intervals_[slot] : Interval{};
}

std::uint32_t QuadricBoard::slots_in_use() const {
  return static_cast<std::uint32_t>(
      std::count_if(intervals_.begin(), intervals_.end(), [](const Interval& lines) { return !lines.empty(); }));
}

std::uint64_t QuadricBoard::memory_bytes() const {
  std::uint64_t bytes = slots_.size() * (sizeof(Slot) + sizeof(Interval)) + bands_.words() * sizeof(std::uint32_t);
  for (const Slot& slot : slots_) bytes += slot.region.memory_bytes();
  for (const LineRoom& room : rooms_)
    bytes += room.spans.capacity() * sizeof(frame::SolidSpan) +
             room.depth.capacity() * (2 * sizeof(std::uint32_t) + sizeof(std::uint8_t));
  return bytes;
}

void QuadricBoard::check_line(std::uint32_t line) const {
  if (line >= screen_.lines)
    throw ModelError("quadric_board", 0, fmt::format("line {} asked of a board of {} lines", line, screen_.lines));
}

void QuadricBoard::cover_lines(std::uint32_t line, std::size_t count, std::uint32_t step,
                               const frame::CoveredLine** covered) {
  for (std::size_t k = 0; k < count; ++k, line += step) {
    check_line(line);
    LineRoom& lines_room = room(line);
    const std::uint32_t touched = bands_.touched_by(line);
    counters_.lines_evaluated += touched > 0 ? 1 : 0;
    counters_.processors_visited += touched;
    counters_.fragments_in += lines_room.fragments;
    counters_.fragments_kept += lines_room.covered.seen_pixels;
    counters_.fragments_hidden += lines_room.fragments - lines_room.covered.seen_pixels;
    covered[k] = &lines_room.covered;
  }
}

QuadricBoard::LineRoom& QuadricBoard::room(std::uint32_t line) {
  if (line / kBandLines != band_) {
    band_ = line / kBandLines;
    for (LineRoom& one : rooms_) one.made = false;
  }
  LineRoom& found = rooms_[line % kBandLines];
  if (!found.made) cover(line, found);
  return found;
}

// Returns how many words they need.
std::size_t QuadricBoard::find_pieces(std::uint32_t line) {
  pieces_.clear();
  for (const std::uint32_t number : bands_.active(line)) {
    const Slot& slot = slots_[number];
    if (slot.parked || !intervals_[number].holds(static_cast<std::int32_t>(line))) continue;
    const LinePieces found = slot.region.columns(static_cast<std::int32_t>(line));
    for (std::size_t i = 0; i < found.count; ++i) {
      // From a multiple of eight on: there is where a byte of bits begins. What lies before it may be of the slot's
      // other piece: no column is covered twice.
      const Interval columns{found.piece[i].begin & ~7, found.piece[i].end};
      if (i > 0 && columns.begin < pieces_.back().columns.end)
        pieces_.back().columns.end = columns.end;
      else
        pieces_.push_back({&slot, columns});
    }
  }
  std::size_t words = 0;
  for (const Piece& piece : pieces_) words += words_of(piece.columns);
  return words;
}

// First what columns the line's solids may cover, so that their words have a place that stays.
void QuadricBoard::cover(std::uint32_t line, LineRoom& room) {
  room.made = true;
  room.spans.clear();
  room.fragments = 0;
  room.covered = {};
  if (bands_.touched_by(line) == 0) return;
  if (const std::size_t words = find_pieces(line); room.depth.size() < words) {
    room.depth.resize(words);
    room.root.resize(words);
    room.surface.resize(words);
  }
  std::fill(seen_.begin(), seen_.end(), 0U);
  std::size_t at = 0;
  for (const Piece& piece : pieces_) {
    cover_slot(*piece.slot, line, piece.columns, at, room);
    at += words_of(piece.columns);
  }
  room.covered.solids = room.spans.data();
  room.covered.solid_count = room.spans.size();
  for (const std::uint64_t bits : seen_) room.covered.seen_pixels += static_cast<std::uint64_t>(std::popcount(bits));
}

void QuadricBoard::cover_slot(const Slot& slot, std::uint32_t line, const Interval& columns, std::size_t at,
                              LineRoom& room) {
  const auto begin = static_cast<std::uint32_t>(columns.begin);
  const auto end = static_cast<std::uint32_t>(columns.end);
  RayRequest request = request_for(slot, line, begin);
  request.count = end - begin;
  request.depth = room.depth.data() + at;
  request.root = room.root.data() + at;
  request.surface = room.surface.data() + at;
  request.seen = reinterpret_cast<std::uint8_t*>(seen_.data()) + begin / 8;  // the lowest byte of a word comes first
  const std::uint64_t covered = kernel_(request);
  if (covered == 0) return;
  room.fragments += covered;
  room.spans.push_back({begin, end, &slot.source, request.depth, request.root, request.surface});
}

// The words of the line at a column, at the top of 64 bits.
RayRequest QuadricBoard::request_for(const Slot& slot, std::uint32_t line, std::uint32_t column) const {
  const QuadricWords& words = slot.words;
  const SecondOrderWords& d = words.discriminant;
  const auto word_bits = static_cast<unsigned>(parameters_.word_bits);
  const auto plane_bits = static_cast<unsigned>(parameters_.plane_bits);
  const std::uint64_t x = column;
  const std::uint64_t y = line;
  RayRequest request;
  const unsigned up = 64 - word_bits;
  request.value = object_processor::second_order_value(d, x, y, word_bits) << up;
  request.difference = (d.d0 + d.c * y + d.two_a * x) << up;
  request.second_difference = d.two_a << up;
  request.word_bits = word_bits;
  request.largest = std::min(root_.largest_word(), low_mask(word_bits - 1));
  const unsigned wanted = 2 * root_.guard_bits;
  request.radicand_down = root_.fraction_bits > wanted ? root_.fraction_bits - wanted : 0;
  request.radicand_up = wanted > root_.fraction_bits ? wanted - root_.fraction_bits : 0;
  request.half_unit = root_.reading == RootReading::half_unit;
  request.root_shift = words.root_shift;
  request.plane_bits = plane_bits;
  const auto plane = [&](const PlaneWords& of) {
    return RayPlane{(of.a * x + of.b * (y + 1) + of.c) << (64 - plane_bits), of.a << (64 - plane_bits)};
  };
  request.middle = plane(words.middle);
  request.caps = static_cast<std::size_t>(parameters_.caps);
  while (request.caps > 0 && words.caps[request.caps - 1].keeps == CapKeeps::everything) --request.caps;
  for (std::size_t i = 0; i < request.caps; ++i) {
    request.cap[i] = plane(words.caps[i].plane);
    request.keeps[i] = static_cast<RayCapKeeps>(words.caps[i].keeps);
  }
  request.kind = static_cast<RayKind>(words.part);
  request.near = screen_.range.near;
  request.far = screen_.range.far;
  request.nothing = static_cast<std::uint32_t>(low_mask(screen_.depth_bits));
  return request;
}

}  // namespace rastertlm::quadric_processor
