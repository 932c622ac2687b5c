// The kinds of hard case: which step of a machine each measures, what its files may say, and how. A kind is a class of
// its own beside a line in the table of case_kinds.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/object_processor/prenormaliser.h"
#include "modules/object_processor/triangle_processor.h"
#include "modules/quadric_processor/quadric_words.h"
#include "modules/set_up/point_lighting.h"
#include "modules/set_up/quadratic_form.h"
#include "modules/shading/table_bank.h"
#include "modules/span_unit/span_words.h"
#include "src/analysis/measurement.h"
#include "src/base/errors.h"
#include "src/geometry/projection.h"
#include "src/parameter/table.h"
#include "src/run/inputs.h"
#include "src/scene/description.h"

namespace rastertlm::analysis {

// What is done on purpose to the words that go into a core, so that a test sees a bound break. Nothing is, by default.
struct Tampering {
  std::function<void(object_processor::TriangleWords&)> object_words;
  std::function<void(quadric_processor::QuadricWords&)> quadric_words;
  std::function<void(span_unit::TriangleLoad&)> span_load;
  std::function<void(object_processor::LinkNormal&)> link_normal;  // after the pre-normalisation unit
  std::function<void(shading::TableBank&)> shading_tables;         // once they are loaded
  std::function<void(set_up::LitPoint&)> lit_point;
  std::function<void(set_up::QuadraticForm<double>&)> form;                // that a solver has found
  std::function<std::uint64_t(std::uint64_t)> colour_word;                 // a constant of a colour's registers
  std::function<void(geometry::ScreenVertex<double>&)> neighbours_corner;  // as the second of two neighbours clips it
  std::function<void(glm::dmat4&)> projection;                             // the matrix from the eye to clip space
  // In place of scene::animate, from where it is placed at the origin.
  std::function<glm::dmat4(const scene::AnimationDescription&, std::int64_t frame)> animate;
};

// Of a quadratic or an adaptive machine; else null.
const quadratic::Machine* span_machine(const run::Inputs::Content& content);

// What a case is measured on.
struct Trial {
  const run::Inputs::Content& machine;
  Numbers numbers;
  std::optional<std::int64_t> tries = std::nullopt;  // random inputs, in place of the case's own
  Tampering tampering = {};

  std::int64_t tried = 0;  // random inputs that the case asked for; 0: it draws none

  std::int64_t tries_or(std::int64_t own) { return tried = tries.value_or(own); }
  // Null where the machine is another.
  const imogene::Machine* object_machine() const { return std::get_if<imogene::Machine>(&machine.machine); }
  const quadratic::Machine* span_machine() const { return analysis::span_machine(machine); }
};

class CaseKind {
 public:
  virtual ~CaseKind() = default;
  // The keys of a file of this kind, beside those that every case has.
  virtual void declare(parameter::Table& table) = 0;
  // What no single range can say of them.
  virtual void check(const std::string& /*file*/, Diagnostics& /*diagnostics*/) const {}
  // The parameter of that machine which decides whether the bounds hold: "span_unit.start_edge".
  virtual std::string step(const run::Inputs::Content& machine) const = 0;
  // About what a try costs, in microseconds: of a long run most inputs go where they are cheap.
  virtual double try_us(const run::Inputs::Content& /*machine*/) const { return 1000.0; }
  // By the machine's own core. The same numbers, the same figures.
  virtual Measured measure(Trial& trial) const = 0;
};

struct NamedKind {
  const char* name;  // as the files have it
  std::unique_ptr<CaseKind> (*make)();
};
const std::vector<NamedKind>& case_kinds();

}  // namespace rastertlm::analysis
