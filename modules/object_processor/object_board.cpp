#include "modules/object_processor/object_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "src/base/errors.h"

namespace rastertlm::object_processor {

namespace {

constexpr std::uint32_t kMaterialMask = 0xFF;  // the line holds a material in a byte

// The depth comparator along a span. Word: as what words are compared; narrower ones than 32 bits are not negative, and
// vector units without unsigned comparisons do those faster as signed.
template <class Word>
void compare_depth(std::uint32_t depth, std::uint32_t step, std::uint32_t mask, std::uint32_t mark,
                   std::uint32_t* __restrict nearest, std::uint32_t* __restrict winner, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t word = depth & mask;
    const bool wins = static_cast<Word>(word) < static_cast<Word>(nearest[i]);
    nearest[i] = wins ? word : nearest[i];
    winner[i] = wins ? mark : winner[i];
    depth += step;
  }
}

}  // namespace

ObjectBoard::ObjectBoard(const ObjectProcessorParameters& parameters, std::uint32_t processors,
                         std::uint32_t first_processor, std::uint32_t columns, std::uint32_t lines, Visit visit)
    : parameters_(parameters),
      format_(static_cast<unsigned>(parameters.word_bits)),
      prenormaliser_(parameters),
      processors_(processors),
      first_processor_(first_processor),
      columns_(columns),
      lines_(lines),
      everything_(visit == Visit::everything),
      late_carry_(parameters.carry_clock == CarryClock::clock2 && parameters.slices() > 1),
      bucket_begin_(std::size_t{lines} + 1, 0),
      winner_(std::size_t{columns} + 1, 0) {
  for (auto& component : normal_) component.resize(columns);
  if (everything_ && processors_ > 0) {
    writable(processors_ - 1, 0);
    copy();
  }
}

ObjectBoard::Slot ObjectBoard::parked_slot(std::uint32_t slot) const {
  const ProcessorWords words = to_words(parked_triangle(format_.bits()));
  const std::uint32_t object = first_processor_ + slot + 1;
  return {words, words, object, object};
}

ObjectBoard::Slot& ObjectBoard::writable(std::uint32_t slot, std::size_t index) {
  if (slot >= processors_ || index >= kWords)
    throw ModelError("object_board", 0,
                     fmt::format("bus write to slot {} word {}: the board has {} slots of {} words", slot, index,
                                 processors_, kWords));
  while (slots_.size() <= slot) {
    slots_.push_back(parked_slot(static_cast<std::uint32_t>(slots_.size())));
    changed_.push_back(0);
    intervals_.emplace_back();
  }
  if (changed_[slot] == 0) {
    changed_[slot] = 1;
    changes_.push_back(slot);
  }
  return slots_[slot];
}

void ObjectBoard::write_word(std::uint32_t slot, std::size_t index, std::uint32_t value) {
  writable(slot, index).loading[index] = value & (index == kMaterialIndex ? kMaterialMask : format_.mask());
}

void ObjectBoard::write(std::uint32_t slot, const TriangleWords& triangle) {
  const ProcessorWords words = to_words(triangle);
  for (std::size_t index = 0; index < kWords; ++index) write_word(slot, index, words[index]);
}

void ObjectBoard::park(std::uint32_t slot) { write(slot, parked_triangle(format_.bits())); }

void ObjectBoard::set_object(std::uint32_t slot, std::uint32_t object) { writable(slot, 0).loading_object = object; }

TriangleWords ObjectBoard::loading(std::uint32_t slot) const {
  return to_triangle(slot < slots_.size() ? slots_[slot].loading : parked_slot(slot).loading);
}

TriangleWords ObjectBoard::backup(std::uint32_t slot) const {
  return to_triangle(slot < slots_.size() ? slots_[slot].backup : parked_slot(slot).backup);
}

std::uint32_t ObjectBoard::object_of_processor(std::uint32_t slot) const {
  return slot < slots_.size() ? slots_[slot].object : first_processor_ + slot + 1;
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
  const std::uint64_t a_slot = sizeof(Slot) + sizeof(std::uint8_t) + sizeof(Interval);
  const std::uint64_t indices = changes_.capacity() + bucket_begin_.capacity() + bucket_slots_.capacity() +
                                active_.capacity() + merged_.capacity() + newcomers_.capacity();
  return slots_.capacity() * a_slot + indices * sizeof(std::uint32_t) +
         std::uint64_t{columns_} * 4 * sizeof(std::uint32_t);
}

Interval ObjectBoard::interval_of(const ProcessorWords& words) const {
  const Interval all{0, static_cast<std::int32_t>(lines_)};
  const std::array<LinearWords, 3> edges = to_triangle(words).edges;
  // A constant negative edge never covers, whatever clocks the carry: 0 added to 0 makes none.
  if (everything_) return all;
  for (const LinearWords& edge : edges)
    if (edge.a == 0 && edge.b == 0 && (edge.c >> (format_.bits() - 1)) != 0) return {};
  return late_carry_ ? all : touched_lines(edges, format_, static_cast<std::int32_t>(columns_), all.end);
}

std::uint32_t ObjectBoard::copy() {
  for (const std::uint32_t slot : changes_) {
    slots_[slot].backup = slots_[slot].loading;
    slots_[slot].object = slots_[slot].loading_object;
    intervals_[slot] = interval_of(slots_[slot].backup);
    changed_[slot] = 0;
  }
  const auto copied = static_cast<std::uint32_t>(changes_.size());
  if (copied > 0) rebuild_buckets();
  changes_.clear();
  current_line_ = kNoLine;
  return copied;
}

void ObjectBoard::rebuild_buckets() {
  // A counting sort by first line, which keeps the order of numbers.
  std::fill(bucket_begin_.begin(), bucket_begin_.end(), 0U);
  std::uint32_t in_use = 0;
  for (const Interval& lines : intervals_) {
    if (lines.empty()) continue;
    ++bucket_begin_[static_cast<std::size_t>(lines.begin) + 1];
    ++in_use;
  }
  for (std::size_t line = 0; line < lines_; ++line) bucket_begin_[line + 1] += bucket_begin_[line];
  bucket_slots_.resize(in_use);
  active_.reserve(in_use);
  merged_.reserve(in_use);
  std::vector<std::uint32_t> next(bucket_begin_.begin(), bucket_begin_.end() - 1);
  for (std::uint32_t slot = 0; slot < intervals_.size(); ++slot)
    if (!intervals_[slot].empty()) bucket_slots_[next[static_cast<std::size_t>(intervals_[slot].begin)]++] = slot;
}

void ObjectBoard::select_processors(std::uint32_t line) {
  if (line == current_line_) return;
  const auto position = static_cast<std::int32_t>(line);
  merged_.clear();
  if (current_line_ != kNoLine && line > current_line_) {
    // What was active and lasts, merged with what began since and lasts.
    newcomers_.clear();
    for (std::uint32_t next = bucket_begin_[current_line_ + 1]; next < bucket_begin_[line + 1]; ++next)
      if (intervals_[bucket_slots_[next]].end > position) newcomers_.push_back(bucket_slots_[next]);
    if (line > current_line_ + 1) std::sort(newcomers_.begin(), newcomers_.end());  // those of one line are in order
    std::erase_if(active_, [&](std::uint32_t slot) { return intervals_[slot].end <= position; });
    std::merge(active_.begin(), active_.end(), newcomers_.begin(), newcomers_.end(), std::back_inserter(merged_));
  } else {
    for (std::uint32_t slot = 0; slot < intervals_.size(); ++slot)
      if (intervals_[slot].holds(position)) merged_.push_back(slot);
  }
  active_.swap(merged_);
  current_line_ = line;
}

void ObjectBoard::evaluate_line(std::uint32_t line, frame::FragmentLine& out) {
  if (line >= lines_ || out.columns() != columns_)
    throw ModelError("object_board", 0,
                     fmt::format("line {} of {} columns asked of a board of {} lines of {} columns", line,
                                 out.columns(), lines_, columns_));
  select_processors(line);
  if (active_.empty()) return;
  ++counters_.lines_evaluated;
  counters_.processors_visited += active_.size();
  touched_ = {static_cast<std::int32_t>(columns_), 0};
  for (const std::uint32_t slot : active_) evaluate_processor(slot, line, out);
  if (!touched_.empty()) resolve_winners(line, out);
}

void ObjectBoard::evaluate_processor(std::uint32_t slot, std::uint32_t line, frame::FragmentLine& out) {
  const ProcessorWords& words = slots_[slot].backup;
  if (late_carry_) {
    evaluate_late_carry(slot, words, line, out);
    return;
  }
  LineEdges at;
  for (std::size_t edge = 0; edge < 3; ++edge)
    at.edges[edge] =
        format_.on_line(words[word_index(edge, 0)], words[word_index(edge, 1)], words[word_index(edge, 2)], line);
  at.depth = words[word_index(kDepth, 1)] * (line + 1) + words[word_index(kDepth, 2)];
  at.depth_step = words[word_index(kDepth, 0)];
  draw(slot, at, {0, static_cast<std::int32_t>(columns_)}, out);
}

// The line in two pieces: column 0, and the rest, which is linear.
void ObjectBoard::evaluate_late_carry(std::uint32_t slot, const ProcessorWords& words, std::uint32_t line,
                                      frame::FragmentLine& out) {
  const TriangleWords triangle = to_triangle(words);
  LineEdges first{};
  LineEdges rest{};
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const LateCarryLine late = late_carry_line(triangle.edges[edge], parameters_, line);
    first.edges[edge] = format_.on_line(0, 0, late.first, line);
    rest.edges[edge] = format_.on_line(triangle.edges[edge].a, 0, late.start, line);
  }
  const LateCarryLine depth = late_carry_line(triangle.depth, parameters_, line);
  first.depth = depth.first;
  rest.depth = depth.start;
  rest.depth_step = triangle.depth.a;
  draw(slot, first, {0, 1}, out);
  draw(slot, rest, {1, static_cast<std::int32_t>(columns_)}, out);
}

void ObjectBoard::draw(std::uint32_t slot, const LineEdges& at, Interval span, frame::FragmentLine& out) {
  const auto last_column = static_cast<std::int32_t>(columns_) - 1;
  std::uint32_t wrapping = 0;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    if (stays_inside(at.edges[edge], last_column))
      narrow(at.edges[edge], span);
    else
      wrapping |= 1U << edge;
  }
  if (span.empty()) return;
  if (wrapping == 0)
    draw_span(slot, at, span, out);
  else
    draw_stepped(slot, at, wrapping, span, out);
}

// Edges that could wrap are looked at pixel by pixel; runs of inside pixels are drawn as spans.
void ObjectBoard::draw_stepped(std::uint32_t slot, const LineEdges& at, std::uint32_t wrapping, Interval span,
                               frame::FragmentLine& out) {
  counters_.pixels_stepped += static_cast<std::uint64_t>(span.end - span.begin);
  std::int32_t run = span.begin;
  for (std::int32_t column = span.begin; column <= span.end; ++column) {
    bool inside = column < span.end;
    for (std::size_t edge = 0; inside && edge < 3; ++edge) {
      if ((wrapping >> edge & 1U) == 0) continue;
      const std::uint32_t word = static_cast<std::uint32_t>(at.edges[edge].start) +
                                 static_cast<std::uint32_t>(at.edges[edge].step) * static_cast<std::uint32_t>(column);
      inside = (word >> 31) == 0;
    }
    if (inside) continue;
    if (run < column) draw_span(slot, at, {run, column}, out);
    run = column + 1;
  }
}

void ObjectBoard::draw_span(std::uint32_t slot, const LineEdges& at, Interval span, frame::FragmentLine& out) {
  const auto begin = static_cast<std::uint32_t>(span.begin);
  const auto end = static_cast<std::uint32_t>(span.end);
  const std::uint32_t mask = format_.mask();
  out.extend(begin, end, mask);
  touched_.begin = std::min(touched_.begin, span.begin);
  touched_.end = std::max(touched_.end, span.end);
  counters_.fragments_in += end - begin;
  const std::uint32_t start = at.depth + at.depth_step * begin;
  const std::size_t count = end - begin;
  if (format_.bits() < 32)
    compare_depth<std::int32_t>(start, at.depth_step, mask, slot + 1, out.depth.data() + begin, winner_.data() + begin,
                                count);
  else
    compare_depth<std::uint32_t>(start, at.depth_step, mask, slot + 1, out.depth.data() + begin, winner_.data() + begin,
                                 count);
  std::uint16_t* __restrict coverage = out.coverage.data();
  for (std::uint32_t column = begin; column < end; ++column) ++coverage[column];
}

void ObjectBoard::resolve_winners(std::uint32_t line, frame::FragmentLine& out) {
  const auto begin = static_cast<std::size_t>(touched_.begin);
  const auto end = static_cast<std::size_t>(touched_.end);
  std::uint64_t seen = 0;
  const std::uint64_t in_before = counters_.fragments_kept + counters_.fragments_hidden;
  for (std::size_t column = begin; column < end;) {
    if (winner_[column] == 0) {
      column += winner_[column + 1] == 0 ? 2 : 1;
      continue;
    }
    // A stretch of pixels that this board shows, by runs of one winner; winner_[columns] is 0 and ends the last.
    const std::size_t stretch = column;
    while (winner_[column] != 0) {
      const std::uint32_t winner = winner_[column];
      const std::size_t run = column;
      while (winner_[column] == winner) ++column;
      fill_run(winner - 1, line, run, column, out);
    }
    std::fill(winner_.begin() + static_cast<std::ptrdiff_t>(stretch),
              winner_.begin() + static_cast<std::ptrdiff_t>(column), 0U);
    prenormaliser_.line({normal_[0].data() + stretch, normal_[1].data() + stretch, normal_[2].data() + stretch},
                        {out.normal_x.data() + stretch, out.normal_y.data() + stretch, out.normal_z.data() + stretch},
                        column - stretch);
    seen += column - stretch;
  }
  counters_.fragments_kept += seen;
  counters_.fragments_hidden += counters_.fragments_in - in_before - seen;
}

void ObjectBoard::fill_run(std::uint32_t slot, std::uint32_t line, std::size_t begin, std::size_t end,
                           frame::FragmentLine& out) {
  const ProcessorWords& words = slots_[slot].backup;
  const auto first = static_cast<std::uint32_t>(begin);
  const auto last = static_cast<std::uint32_t>(end);
  for (std::size_t component = 0; component < 3; ++component) {
    const std::size_t processor = kNormalX + component;
    const std::uint32_t step = words[word_index(processor, 0)];
    std::uint32_t* __restrict normal = normal_[component].data();
    std::uint32_t start = words[word_index(processor, 1)] * (line + 1) + words[word_index(processor, 2)];
    if (late_carry_) {
      const LateCarryLine late =
          late_carry_line({step, words[word_index(processor, 1)], words[word_index(processor, 2)]}, parameters_, line);
      start = late.start;
      if (begin == 0) normal[0] = late.first;
    }
    const std::uint32_t from = late_carry_ ? std::max(first, 1U) : first;
    std::uint32_t word = start + step * from;
    for (std::uint32_t column = from; column < last; ++column) {
      normal[column] = word;
      word += step;
    }
  }
  const auto material = static_cast<std::uint8_t>(words[kMaterialIndex]);
  const std::uint32_t object = slots_[slot].object;
  std::uint8_t* __restrict materials = out.material.data();
  std::uint32_t* __restrict objects = out.object.data();
  for (std::size_t column = begin; column < end; ++column) {
    materials[column] = material;
    objects[column] = object;
  }
}

}  // namespace rastertlm::object_processor
