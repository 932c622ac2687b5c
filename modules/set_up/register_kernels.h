// The words that the span unit's registers start with, of three colours and of depth at once. Compiled for several
// instruction sets; which one is used is chosen at run time (src/base/vector_variant.h). The sources of the kernels
// include this header and nothing that other code shares.
#pragma once

#include "modules/span_unit/span.h"
#include "src/base/vector_variant.h"

namespace rastertlm::set_up {

// Quadratic forms a set of registers (quadratic_form.h; depth is linear), and how they become words. Nothing is set
// where none is given: there is one a triangle.
struct alignas(32) RegisterForms {
  double t0[span_unit::kRegisterSets];
  double t1[span_unit::kRegisterSets];
  double t2[span_unit::kRegisterSets];
  double t3[span_unit::kRegisterSets];
  double t4[span_unit::kRegisterSets];
  double t5[span_unit::kRegisterSets];
  double added[span_unit::kRegisterSets];  // to the start: a half of a level
  double scale[span_unit::kRegisterSets];  // 2^fraction bits
};

struct RegisterKernels {
  // At (x, y) of an edge that goes `slope` pixels sideways a line. False where a word is 2^51 or more in size, or no
  // number: then nothing that was written means anything.
  bool (*start)(const RegisterForms& forms, double x, double y, double slope, span_unit::StartEdgeRegisters& out);
};

const RegisterKernels& register_kernels(VectorVariant variant);

}  // namespace rastertlm::set_up
