// What the lines of boards show together, evaluated only where it is seen: depths are compared along spans, and of the
// nearest alone the normal is computed and normalised. The same words as comparing pixel by pixel (tested).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/object_processor/parameters.h"
#include "modules/object_processor/prenormaliser.h"
#include "modules/object_processor/span_kernels.h"
#include "src/base/vector_variant.h"
#include "src/frame/covered_line.h"
#include "src/frame/scan_line.h"

namespace rastertlm::object_processor {

class LineComposer {
 public:
  // `observe`: a line has its depths, and how many objects cover each pixel; without, they mean nothing.
  LineComposer(const ObjectProcessorParameters& parameters, std::size_t columns, bool observe = true,
               VectorVariant variant = vector_variant());

  // Boards in the order of processor numbers, those of solids last: strictly smaller depth wins, equal depth keeps the
  // lower number. `out` is a line of `columns` that is written anew. Returns the number of pixels in which an object is
  // seen.
  std::uint64_t compose(std::span<const frame::CoveredLine* const> boards, std::uint32_t line,
                        frame::FragmentLine& out);

 private:
  void compare(std::span<const frame::CoveredLine* const> boards, std::uint32_t line, std::size_t columns,
               bool in_keys);
  void compose_solids(std::span<const frame::CoveredLine* const> boards, const ResolveRequest& request);
  void observe(std::span<const frame::CoveredLine* const> boards, bool in_keys, frame::FragmentLine& out) const;

  unsigned word_bits_;
  std::uint32_t word_mask_;
  unsigned normal_bits_;
  Prenormaliser prenormaliser_;
  bool observe_;
  const SpanKernels* kernels_;
  struct alignas(64) Sixteen {
    std::uint32_t words[16];
  };
  std::vector<Sixteen> depth_;                         // of the nearest so far; or with its mark, where both fit
  std::vector<Sixteen> winner_;                        // its mark: 0 nobody, else a span, counted from 1
  std::vector<const frame::FragmentSource*> sources_;  // by mark
  std::array<std::vector<std::uint32_t>, 3> normal_;   // words of the winners before normalisation
  std::uint32_t first_solid_ = 1;                      // mark of the first
};

}  // namespace rastertlm::object_processor
