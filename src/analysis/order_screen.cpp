#include "src/analysis/order_screen.h"

#include <algorithm>

#include "modules/decision_unit/decision_unit.h"
#include "modules/frame_store/frame_store.h"
#include "modules/object_processor/line_composer.h"
#include "modules/object_processor/object_board.h"
#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_unit.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using decision_unit::Topology;
using geometry::SnapGrid;
using object_processor::ObjectBoard;
using set_up::ScreenTriangle;

constexpr std::uint32_t kSlots = 8;  // of a board; more are not needed

// Triangles on any processors of any boards, in the order of their numbers.
class ObjectOrder : public OrderScreen {
 public:
  ObjectOrder(const imogene::Machine& machine, Trial& trial)
      : trial_(trial),
        parameters_(machine.object_processor),
        format_{static_cast<int>(parameters_.word_bits), static_cast<std::size_t>(machine.video.columns),
                static_cast<std::size_t>(machine.video.lines), parameters_.edges} {
    parameters_.carry_clock = object_processor::CarryClock::clock1;
    const auto count = static_cast<std::uint32_t>(machine.host.computation_units);
    for (std::uint32_t board = 0; board < count; ++board) {
      boards_.emplace_back(parameters_, kSlots, board * kSlots, static_cast<std::uint32_t>(format_.columns),
                           static_cast<std::uint32_t>(format_.lines));
      lines_.emplace_back().resize(format_.columns);
    }
    composed_.resize(format_.columns);
  }

  void show(const std::vector<ScreenTriangle<double>>& triangles, const SnapGrid& grid,
            const VisitSeen& visit) override {
    load(triangles, grid);
    object_processor::LineComposer composer(parameters_, format_.columns);
    for (std::uint32_t y = 0; y < format_.lines; ++y) {
      for (const Topology topology : {Topology::tree, Topology::pipeline}) merge_lines(topology, y, visit);
      compose_line(composer, y, visit);
    }
  }
  double fraction() const override { return 0.0; }

 private:
  void load(const std::vector<ScreenTriangle<double>>& triangles, const SnapGrid& grid) {
    for (ObjectBoard& board : boards_)
      for (std::uint32_t slot = 0; slot < kSlots; ++slot) board.park(slot);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      set_up::SetUpResult result = set_up::set_up_triangle<double>(triangles[i], 0, true, grid, format_);
      if (trial_.tampering.object_words) trial_.tampering.object_words(result.words);
      // One of as many processors in a row as there are for each.
      const std::size_t all = boards_.size() * kSlots, each = all / triangles.size();
      const auto number = static_cast<std::uint32_t>(
          i * each + static_cast<std::size_t>(trial_.numbers.whole(0, static_cast<std::int64_t>(each) - 1)));
      ObjectBoard& board = boards_[number / kSlots];
      board.write(number % kSlots, result.words);
      board.set_object(number % kSlots, static_cast<std::uint32_t>(i) + 1);
    }
    for (ObjectBoard& board : boards_) board.copy();
  }

  static void visit_line(const frame::FragmentLine& line, std::uint32_t y, const VisitSeen& visit) {
    for (std::size_t x = line.begin; x < line.end; ++x)
      if (line.object[x] != 0) visit(static_cast<std::int64_t>(x), y, line.object[x] - 1);
  }

  void merge_lines(Topology topology, std::uint32_t y, const VisitSeen& visit) {
    std::vector<frame::FragmentLine*> pointers;
    bool any = false;
    for (std::size_t board = 0; board < boards_.size(); ++board) {
      lines_[board].clear();
      boards_[board].evaluate_line(y, lines_[board]);
      any = any || !lines_[board].empty();
      pointers.push_back(&lines_[board]);
    }
    if (!any) return;
    decision_unit::DecisionUnit unit({topology, true}, boards_[0].background_depth());
    unit.merge(pointers);
    visit_line(lines_[0], y, visit);
  }

  void compose_line(object_processor::LineComposer& composer, std::uint32_t y, const VisitSeen& visit) {
    std::vector<const frame::CoveredLine*> covered;
    bool any = false;
    for (ObjectBoard& board : boards_) {
      covered.push_back(&board.cover_line(y));
      any = any || covered.back()->count > 0;
    }
    if (!any) return;
    composer.compose(covered, y, composed_);
    visit_line(composed_, y, visit);
  }

  Trial& trial_;
  object_processor::ObjectProcessorParameters parameters_;
  set_up::WordFormat format_;
  std::vector<ObjectBoard> boards_;
  std::vector<frame::FragmentLine> lines_;
  frame::FragmentLine composed_;
};

// Triangles drawn one after the other; where the store compares numbers, the last first.
class SpanOrder : public OrderScreen {
 public:
  SpanOrder(const quadratic::Machine& machine, const Tampering& tampering)
      : machine_(machine),
        tampering_(tampering),
        parameters_(machine.span_unit),
        columns_(static_cast<std::uint32_t>(machine.video.columns)),
        lines_(static_cast<std::uint32_t>(machine.video.lines)),
        by_number_(machine.stores_numbers()),
        unit_(right(parameters_), columns_, lines_),
        store_(right(machine.frame_store), store_format()) {}

  void show(const std::vector<ScreenTriangle<double>>& triangles, const SnapGrid& grid,
            const VisitSeen& visit) override {
    store_.clear();
    for (std::size_t i = 0; i < triangles.size(); ++i) draw(triangles, by_number_ ? triangles.size() - 1 - i : i, grid);
    store_.swap();
    store_.observe(frame_);
    for (std::uint32_t y = 0; y < lines_; ++y)
      for (std::uint32_t x = 0; x < columns_; ++x)
        if (const std::uint32_t object = frame_.object[std::size_t{y} * columns_ + x]; object != 0)
          visit(x, y, object - 1);
  }
  double fraction() const override { return 1.0; }

 private:
  static const span_unit::SpanUnitParameters& right(span_unit::SpanUnitParameters& parameters) {
    if (parameters.start_edge == span_unit::StartEdge::published) parameters.start_edge = span_unit::StartEdge::lattice;
    return parameters;
  }
  // A picture is whole when it is looked at, and nothing of the last one is left.
  static frame_store::FrameStoreParameters right(frame_store::FrameStoreParameters parameters) {
    parameters.swap = frame_store::Swap::retrace;
    parameters.clear = true;
    return parameters;
  }
  frame_store::FrameStore::Format store_format() const {
    frame_store::FrameStore::Format format;
    format.columns = columns_;
    format.lines = lines_;
    format.farthest = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters_.depth_bits)));
    format.pixels = span_unit::pixel_format(parameters_);
    format.ties = by_number_;
    return format;
  }

  void draw(const std::vector<ScreenTriangle<double>>& triangles, std::size_t index, const SnapGrid& grid) {
    const set_up::WordFormat format = machine_.depth_format();
    const SnappedPlane plane = depth_plane(triangles[index], grid.fraction_bits, format);
    set_up::ColourTriangle triangle;
    triangle.fraction_bits = grid.fraction_bits;
    triangle.corners = plane.corners();
    triangle.depth = plane.values();
    span_unit::TriangleLoad load = set_up::span_load(triangle, set_up::SpanFormat::of(parameters_, lines_));
    if (tampering_.span_load) tampering_.span_load(load);
    store_.draw(unit_.draw(load).spans, static_cast<std::uint32_t>(index) + 1, 0);
  }

  const quadratic::Machine& machine_;
  const Tampering& tampering_;
  span_unit::SpanUnitParameters parameters_;
  std::uint32_t columns_, lines_;
  bool by_number_;
  span_unit::SpanUnit unit_;
  frame_store::FrameStore store_;
  frame::Frame frame_;
};

}  // namespace

std::unique_ptr<OrderScreen> OrderScreen::of(Trial& trial) {
  if (const imogene::Machine* machine = trial.object_machine()) return std::make_unique<ObjectOrder>(*machine, trial);
  if (const quadratic::Machine* machine = trial.span_machine())
    return std::make_unique<SpanOrder>(*machine, trial.tampering);
  return nullptr;
}

}  // namespace rastertlm::analysis
