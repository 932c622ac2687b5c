// A board's line as spans.
#include <algorithm>
#include <bit>

#include "modules/object_processor/object_board.h"
#include "modules/object_processor/visit_spans.h"

namespace rastertlm::object_processor {

// Finds the spans of the line's band.
void ObjectBoard::make_ready(std::uint32_t line) {
  const std::span<const std::uint32_t> slots = bands_.active(line);
  ready_first_ = line / kBandLines * kBandLines;
  const std::size_t room = slots.size() + 1;
  if (spans_.size() < kBandLines * room) spans_.resize(kBandLines * room);
  BandLines found;
  for (std::size_t k = 0; k < kBandLines; ++k) found.line[k].spans = &spans_[k * room];
  const bool careful =
      careful_count_ > 0 && std::any_of(slots.begin(), slots.end(), [this](auto slot) { return careful_[slot] != 0; });
  if (!careful)
    kernels_.band({slots.data(), slots.size(), borders_.data(), intervals_.data(), sources_.data(), ready_first_,
                   columns_, format_.mask(), seen_.data(), seen_.size() / kBandLines},
                  found);
  for (std::uint32_t k = 0; k < kBandLines; ++k) {
    const BandLine& band_line = found.line[k];
    const std::uint32_t touched = ready_first_ + k < lines_ ? bands_.touched_by(ready_first_ + k) : 0;
    ready_[k] = {{band_line.spans, band_line.count, band_line.seen_pixels},
                 band_line.fragments,
                 touched,
                 touched > 0 && (careful || (found.doubtful >> k & 1U) != 0)};
  }
}

void ObjectBoard::cover_lines(std::uint32_t line, std::size_t count, std::uint32_t step,
                              const frame::CoveredLine** covered) {
  check_line(line, columns_);
  if (line - ready_first_ >= kBandLines) make_ready(line);
  BoardCounters more;
  for (std::size_t k = 0; k < count; ++k, line += step) {
    Ready& ready = ready_[line - ready_first_];
    if (ready.careful) cover_carefully(line, ready);
    more.lines_evaluated += ready.touched > 0 ? 1 : 0;
    more.processors_visited += ready.touched;
    more.fragments_in += ready.fragments;
    more.fragments_kept += ready.covered.seen_pixels;
    covered[k] = &ready.covered;
  }
  counters_.lines_evaluated += more.lines_evaluated;
  counters_.processors_visited += more.processors_visited;
  counters_.fragments_in += more.fragments_in;
  counters_.fragments_kept += more.fragments_kept;
  counters_.fragments_hidden += more.fragments_in - more.fragments_kept;
}

// A line on which an edge could wrap, or a depth reach the word of nothing: span by span, as evaluate_line draws it.
void ObjectBoard::cover_carefully(std::uint32_t line, Ready& ready) {
  std::fill(seen_.begin(), seen_.end(), 0U);
  std::vector<frame::CoveredSpan>& spans = careful_spans_[line - ready_first_];
  spans.clear();
  ready.fragments = 0;
  for (const std::uint32_t slot : bands_.active(line)) {
    if (!intervals_[slot].holds(static_cast<std::int32_t>(line))) continue;
    const LineEdges at = line_edges(slot, line);
    visit_spans(at, {0, static_cast<std::int32_t>(columns_)}, [&](const Interval& span) {
      ready.fragments += static_cast<std::uint64_t>(span.end - span.begin);
      cover_span(slot, at, span, spans);
    });
  }
  std::uint64_t seen = 0;
  for (const std::uint64_t word : seen_) seen += static_cast<std::uint64_t>(std::popcount(word));
  ready.covered = {spans.data(), spans.size(), seen};
}

void ObjectBoard::cover_span(std::uint32_t slot, const LineEdges& at, Interval span,
                             std::vector<frame::CoveredSpan>& spans) {
  const auto begin = static_cast<std::uint32_t>(span.begin);
  const auto end = static_cast<std::uint32_t>(span.end);
  spans.push_back({begin, end, &sources_[slot]});
  for (std::uint32_t column = begin; column < end; ++column)
    if (((at.depth + at.depth_step * column) & format_.mask()) != format_.mask())
      seen_[column / 64] |= std::uint64_t{1} << (column % 64);
}

}  // namespace rastertlm::object_processor
