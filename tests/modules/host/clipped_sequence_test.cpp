// Objects move across the screen's border and back: do the boards hold, in every frame, what a machine that starts with
// that frame would hold, and nothing of the frames before?
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "modules/object_processor/object_board.h"
#include "tests/modules/host/resident_world.h"

namespace rastertlm::host {
namespace {

using object_processor::ObjectBoard;
using object_processor::ProcessorWords;
using set_up::Outcome;

using Drawn = std::tuple<ProcessorWords, std::uint32_t>;  // and its object, from 1

Drawn drawn(const object_processor::TriangleWords& words, std::uint32_t object) {
  return {object_processor::to_words(words), object + 1};
}

// Every piece of a frame, by the rules of the frame's grid, in plain numbers.
std::vector<Drawn> expected_pieces(const World& world, std::int64_t frame, const MachineFormat& format) {
  const std::vector<PlainTriangle> triangles = plain_triangles(world, frame);
  const auto needs_guard = [&](const PlainTriangle& triangle) {
    return geometry::needs_guard_band(triangle.corners, format.grids.on_screen, format.viewport);
  };
  const bool guarded = std::any_of(triangles.begin(), triangles.end(), needs_guard);
  const geometry::FrameGrid grid = geometry::frame_grid(format.grids, guarded, format.viewport);
  std::vector<Drawn> result;
  for (const PlainTriangle& triangle : triangles) {
    std::vector<set_up::ScreenTriangle<double>> pieces;
    if (needs_guard(triangle)) {
      const auto cut = set_up::pieces(triangle.corners, grid, format.viewport);
      pieces.assign(cut.list().begin(), cut.list().end());
    } else {
      pieces.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) pieces[0][k] = geometry::to_screen(triangle.corners[k], format.viewport);
    }
    for (const auto& piece : pieces) {
      const auto fitted =
          set_up::set_up_triangle<double>(piece, triangle.material, triangle.two_sided, grid.grid, format.words);
      if (fitted.outcome == Outcome::drawn) result.push_back(drawn(fitted.words, triangle.object));
    }
  }
  return result;
}

ObjectBoard board(std::uint32_t slots, std::uint32_t first) {
  return ObjectBoard({}, slots, first, static_cast<std::uint32_t>(kColumns), static_cast<std::uint32_t>(kLines));
}

// As a computation unit writes it: a whole slot, or as few words as park it.
void write(ObjectBoard& to, const Load& load) {
  const ProcessorWords words = object_processor::to_words(load.words);
  const std::size_t count = load.park ? kParkWords : words.size();
  for (std::size_t i = 0; i < count; ++i) to.write_word(load.slot, i, words[i]);
  if (!load.park) to.set_object(load.slot, load.object + 1);
}

// What the processors of the boards draw.
std::vector<Drawn> held(const std::vector<ObjectBoard>& boards) {
  const object_processor::LinearWords off{0, 0, 0xFFFFFF};
  std::vector<Drawn> result;
  for (const ObjectBoard& one : boards)
    for (std::uint32_t slot = 0; slot < one.processors(); ++slot)
      if (const auto words = one.backup(slot); words.edges[0] != off)
        result.emplace_back(object_processor::to_words(words), one.object_of_processor(slot));
  return result;
}

struct Pixel {
  std::uint32_t depth;
  std::uint32_t coverage;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

std::vector<Pixel> picture(std::vector<ObjectBoard>& boards) {
  std::vector<Pixel> pixels;
  frame::FragmentLine line;
  for (std::uint32_t y = 0; y < kLines; ++y) {
    line.resize(kColumns);
    for (ObjectBoard& one : boards) one.evaluate_line(y, line);
    for (std::size_t x = 0; x < kColumns; ++x) {
      const bool inside = x >= line.begin && x < line.end;
      pixels.push_back(inside ? Pixel{line.depth[x], line.coverage[x]} : Pixel{0xFFFFFF, 0});
    }
  }
  return pixels;
}

void erase_one(std::vector<Drawn>& from, const Drawn& what) {
  const auto found = std::find(from.begin(), from.end(), what);
  RC_ASSERT((found != from.end()));
  from.erase(found);
}

// Some objects move about the border, near and far plane among them, some stand still, and at times nothing moves.
void fill(World& world, std::size_t frames, std::mt19937& random) {
  const auto real = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  world.resident.camera_moves = random() % 5 == 0;
  const std::size_t objects = 1 + random() % 4;
  world.places.resize(frames);
  for (std::size_t i = 0; i < objects; ++i) {
    const bool moves = random() % 4 != 0;
    add_random_triangles(world.add(random() % 2 == 0, moves), 1 + random() % 5, 1.0 + static_cast<double>(random() % 8),
                         random);
    for (std::size_t frame = 0; frame < frames; ++frame) {
      const bool stays = frame > 0 && (!moves || random() % 4 == 0);
      world.places[frame].push_back(stays ? world.places[frame - 1][i]
                                          : glm::dvec3(real(-7, 7), real(-5, 5), real(-22, -5)));
    }
  }
}

RC_GTEST_PROP(ClippedSequence, BoardsHoldNothingOfFormerFrames, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  constexpr std::size_t kFrames = 7;
  World world;
  fill(world, kFrames, random);
  const std::size_t units = 1 + random() % 3;
  const auto own = static_cast<std::uint32_t>((world.triangles() + units - 1) / units);
  const MachineFormat machine_format = format(own + static_cast<std::uint32_t>(random() % 3 == 0 ? 0 : random() % 12));
  HostParameters parameters;
  parameters.computation_units = static_cast<std::int64_t>(units);
  parameters.processors_per_unit = machine_format.slots;
  const SlotMap slots = assign_objects(world.triangles(), parameters);
  const Animation animation(world.resident, random() % 4 == 0);
  std::vector<Computation> computations;
  std::vector<ObjectBoard> boards;
  for (std::size_t unit = 0; unit < units; ++unit) {
    computations.emplace_back(world.resident, machine_format, slots.boards[unit]);
    boards.push_back(board(machine_format.slots, static_cast<std::uint32_t>(unit) * machine_format.slots));
  }
  for (std::int64_t frame = 0; frame < static_cast<std::int64_t>(kFrames); ++frame) {
    const FrameWork work = animation.frame_work(frame, frame == 0);
    bool guarded = false;
    std::vector<Piece> homeless;
    std::vector<std::uint32_t> free_slots;
    for (Computation& computation : computations) {
      const Survey survey = computation.survey(work);
      guarded = guarded || survey.guarded;
      free_slots.push_back(survey.free_slots);
      homeless.insert(homeless.end(), survey.homeless.begin(), survey.homeless.end());
    }
    const auto placed = place_pieces(homeless, free_slots);
    TriangleCounts counts;
    for (std::size_t unit = 0; unit < units; ++unit) {
      for (const Load& load : computations[unit].set_up(guarded, placed[unit])) write(boards[unit], load);
      boards[unit].copy();
      counts += computations[unit].triangle_counts();
    }
    std::vector<Drawn> expected = expected_pieces(world, frame, machine_format);
    for (const Piece& left : homeless) erase_one(expected, drawn(left.words, left.object));
    std::vector<Drawn> actual = held(boards);
    std::sort(expected.begin(), expected.end());
    std::sort(actual.begin(), actual.end());
    RC_ASSERT((actual == expected));
    RC_ASSERT(counts.drawn + counts.back_faces + counts.degenerate + counts.outside == world.triangles());
    RC_ASSERT(counts.drawn + counts.pieces == expected.size());

    std::vector<ObjectBoard> fresh;
    fresh.push_back(board(static_cast<std::uint32_t>(expected.size()) + 1, 0));
    for (std::uint32_t i = 0; i < expected.size(); ++i)
      fresh[0].write(i, object_processor::to_triangle(std::get<0>(expected[i])));
    fresh[0].copy();
    RC_ASSERT((picture(boards) == picture(fresh)));
  }
}

}  // namespace
}  // namespace rastertlm::host
