#include "modules/object_processor/line_composer.h"

#include <algorithm>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

LineComposer::LineComposer(const ObjectProcessorParameters& parameters, std::size_t columns, bool observe,
                           VectorVariant variant)
    : word_bits_(static_cast<unsigned>(parameters.word_bits)),
      word_mask_(static_cast<std::uint32_t>(low_mask(word_bits_))),
      normal_bits_(static_cast<unsigned>(parameters.normal_bits)),
      prenormaliser_(parameters, variant),
      observe_(observe),
      kernels_(&span_kernels(variant)),
      depth_(columns / 16 + 2),
      winner_(columns / 16 + 2) {
  for (auto& component : normal_) component.resize(columns + frame::FragmentLine::kSpare);
}

std::uint64_t LineComposer::compose(std::span<const frame::CoveredLine* const> boards, std::uint32_t line,
                                    frame::FragmentLine& out) {
  out.clear();
  std::size_t spans = 0;
  std::size_t solids = 0;
  for (const frame::CoveredLine* board : boards) {
    spans += board->count;
    solids += board->solid_count;
  }
  first_solid_ = static_cast<std::uint32_t>(spans) + 1;
  spans += solids;
  if (spans == 0) return 0;
  if (sources_.size() <= spans) sources_.resize(spans + 1);
  static constexpr frame::FragmentSource kNobody{};
  sources_.front() = &kNobody;
  const bool in_keys = word_bits_ + kMarkBits <= 32 && spans <= kMarkMask;
  const std::size_t columns = out.columns();
  out.begin = 0;
  out.end = columns;
  compare(boards, line, columns, in_keys);
  if (observe_) observe(boards, in_keys, out);
  ResolveRequest request;
  request.winner = in_keys ? depth_.front().words : winner_.front().words;
  request.mark_mask = in_keys ? kMarkMask : ~0U;
  request.columns = static_cast<std::uint32_t>(columns);
  request.line = line;
  request.sources = sources_.data();
  request.word_bits = word_bits_;
  request.normal_bits = normal_bits_;
  request.material = out.material.data();
  request.object = out.object.data();
  const std::array<std::uint16_t*, 3> link{out.normal_x.data(), out.normal_y.data(), out.normal_z.data()};
  // Normals of solids are not known yet.
  const bool normalises = word_bits_ <= kNormalisedBits && solids == 0;
  for (std::size_t i = 0; i < 3; ++i) {
    request.normal[i] = normal_[i].data();
    request.link[i] = normalises ? link[i] : nullptr;
  }
  const std::uint64_t seen = kernels_->resolve(request);
  if (solids > 0) compose_solids(boards, request);
  if (!normalises) prenormaliser_.line({normal_[0].data(), normal_[1].data(), normal_[2].data()}, link, columns);
  return seen;
}

void LineComposer::compare(std::span<const frame::CoveredLine* const> boards, std::uint32_t line, std::size_t columns,
                           bool in_keys) {
  // Strictly nearer than nothing wins: the key of nothing has the lowest mark, which is nobody's.
  kernels_->fill(depth_.front().words, columns + 1, in_keys ? word_mask_ << (32 - word_bits_) : word_mask_);
  if (!in_keys) kernels_->fill(winner_.front().words, columns + 1, 0);
  kernels_->draw({boards.data(), boards.size(), line, word_bits_, sources_.data(), depth_.front().words,
                  in_keys ? nullptr : winner_.front().words});
  std::uint32_t mark = first_solid_;
  for (const frame::CoveredLine* board : boards)
    for (std::size_t i = 0; i < board->solid_count; ++i, ++mark) {
      const frame::SolidSpan& span = board->solids[i];
      sources_[mark] = &span.source->middle;
      kernels_->draw_solid({&span, mark, word_bits_, depth_.front().words, in_keys ? nullptr : winner_.front().words});
    }
}

// A solid's source has given its pixels material, number and the normals at the middle of the ray; those of its surface
// come here.
void LineComposer::compose_solids(std::span<const frame::CoveredLine* const> boards, const ResolveRequest& request) {
  SolidNormalRequest normals;
  normals.mark = first_solid_;
  normals.winner = request.winner;
  normals.mark_mask = request.mark_mask;
  for (std::size_t k = 0; k < 3; ++k) normals.normal[k] = request.normal[k];
  for (const frame::CoveredLine* board : boards)
    for (std::size_t i = 0; i < board->solid_count; ++i, ++normals.mark) {
      normals.span = &board->solids[i];
      kernels_->solid_normal(normals);
    }
}

void LineComposer::observe(std::span<const frame::CoveredLine* const> boards, bool in_keys,
                           frame::FragmentLine& out) const {
  const std::uint32_t* const depth = depth_.front().words;
  const unsigned down = in_keys ? 32 - word_bits_ : 0;
  for (std::size_t x = 0; x < out.columns(); ++x) out.depth[x] = depth[x] >> down;
  std::fill(out.coverage.begin(), out.coverage.end(), std::uint16_t{0});
  std::uint16_t* __restrict coverage = out.coverage.data();
  for (const frame::CoveredLine* board : boards)
    for (std::size_t i = 0; i < board->count; ++i)
      for (std::uint32_t column = board->spans[i].begin; column < board->spans[i].end; ++column) ++coverage[column];
  for (const frame::CoveredLine* board : boards)
    for (std::size_t i = 0; i < board->solid_count; ++i) {
      const frame::SolidSpan& span = board->solids[i];
      for (std::uint32_t column = span.begin; column < span.end; ++column)
        coverage[column] =
            static_cast<std::uint16_t>(coverage[column] + (span.depth[column - span.begin] != word_mask_ ? 1U : 0U));
    }
}

}  // namespace rastertlm::object_processor
