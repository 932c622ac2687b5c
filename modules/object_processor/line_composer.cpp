#include "modules/object_processor/line_composer.h"

#include <algorithm>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

LineComposer::LineComposer(const ObjectProcessorParameters& parameters, std::size_t columns, bool observe,
                           VectorVariant variant)
    : word_mask_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.word_bits)))),
      prenormaliser_(parameters, variant),
      observe_(observe),
      kernels_(&span_kernels(variant)),
      winner_(columns + frame::FragmentLine::kSpare) {
  for (auto& component : normal_) component.resize(columns + frame::FragmentLine::kSpare);
}

std::uint64_t LineComposer::compose(std::span<const frame::CoveredLine* const> boards, std::uint32_t line,
                                    frame::FragmentLine& out) {
  out.clear();
  std::size_t spans = 0;
  for (const frame::CoveredLine* board : boards) spans += board->count;
  if (spans == 0) return 0;
  if (sources_.size() <= spans) sources_.resize(spans + 1);
  const std::size_t columns = out.columns();
  out.begin = 0;
  out.end = columns;
  compare(boards, line, out);
  if (observe_) count_coverage(boards, out);
  const std::uint64_t seen = kernels_->resolve({winner_.data(),
                     static_cast<std::uint32_t>(columns),
                     line,
                     sources_.data(),
                     {normal_[0].data(), normal_[1].data(), normal_[2].data()},
                     out.material.data(),
                     out.object.data()});
  prenormaliser_.line({normal_[0].data(), normal_[1].data(), normal_[2].data()},
                      {out.normal_x.data(), out.normal_y.data(), out.normal_z.data()}, columns,
                      out.object.data());
  return seen;
}

void LineComposer::compare(std::span<const frame::CoveredLine* const> boards, std::uint32_t line,
                           frame::FragmentLine& out) {
  kernels_->clear(out.depth.data(), winner_.data(), out.columns() + 1, word_mask_);
  std::uint32_t mark = 1;
  for (const frame::CoveredLine* board : boards) {
    kernels_->draw({board->spans.data(), board->count, line, word_mask_, mark, sources_.data(), out.depth.data(),
                    winner_.data()});
    mark += static_cast<std::uint32_t>(board->count);
  }
}

void LineComposer::count_coverage(std::span<const frame::CoveredLine* const> boards, frame::FragmentLine& out) {
  std::fill(out.coverage.begin(), out.coverage.end(), std::uint16_t{0});
  std::uint16_t* __restrict coverage = out.coverage.data();
  for (const frame::CoveredLine* board : boards)
    for (std::size_t i = 0; i < board->count; ++i)
      for (std::uint32_t column = board->spans[i].begin; column < board->spans[i].end; ++column) ++coverage[column];
}

}  // namespace rastertlm::object_processor
