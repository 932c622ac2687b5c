#include "modules/host/computation.h"

#include <algorithm>
#include <utility>

namespace rastertlm::host {

using geometry::operation_counts;
using geometry::OperationCounts;
using set_up::Outcome;

namespace {

// left * right, for an object's matrix and the camera's: charged to the unit that needs it.
template <class T>
glm::dmat4 product(const glm::dmat4& left, const glm::dmat4& right) {
  glm::dmat4 result;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      T sum = T(left[0][row]) * T(right[column][0]);
      for (int k = 1; k < 4; ++k) sum += T(left[k][row]) * T(right[column][k]);
      result[column][row] = sum.value();
    }
  return result;
}

// Adds what is counted while it lives to `sum`.
class CountedStep {
 public:
  explicit CountedStep(OperationCounts& sum) : sum_(sum), start_(operation_counts) {}
  ~CountedStep() { sum_ += operation_counts - start_; }
  CountedStep(const CountedStep&) = delete;
  CountedStep& operator=(const CountedStep&) = delete;

 private:
  OperationCounts& sum_;
  OperationCounts start_;
};

}  // namespace

TriangleCounts& TriangleCounts::operator+=(const TriangleCounts& other) {
  drawn += other.drawn;
  back_faces += other.back_faces;
  degenerate += other.degenerate;
  outside += other.outside;
  pieces += other.pieces;
  return *this;
}

Computation::Computation(const ResidentScene& scene, const MachineFormat& format, const std::vector<SlotOwner>& owners)
    : scene_(scene), format_(format), guarded_frame_(geometry::frame_grid(format.grids, true, format.viewport)) {
  std::vector<std::size_t> first_object;  // number of the first triangle of each mesh
  std::size_t count = 0;
  for (const ResidentObject& object : scene.objects) {
    first_object.push_back(count);
    count += object.mesh->triangles.size();
  }
  triangles_.reserve(owners.size());
  std::vector<bool> owned(format.slots, false);
  for (const SlotOwner& owner : owners) {
    const auto mesh =
        static_cast<std::size_t>(std::upper_bound(first_object.begin(), first_object.end(), owner.object) -
                                 first_object.begin()) -
        1;
    const ResidentObject& object = scene.objects[mesh];
    const std::size_t index = owner.object - first_object[mesh];
    const auto& corners = object.mesh->triangles[index];
    triangles_.push_back({owner.object,
                          static_cast<std::uint32_t>(mesh),
                          {corners[0], corners[1], corners[2]},
                          owner.slot,
                          object.mesh->material[index],
                          object.two_sided});
    owned[owner.slot] = true;
  }
  for (std::uint32_t slot = 0; slot < format.slots; ++slot)
    if (!owned[slot]) free_slots_.push_back(slot);
  object_to_clip_.resize(scene.objects.size());
}

Survey Computation::survey(const FrameWork& work) {
  const CountedStep step(operations_);
  work_ = &work;
  std::vector<std::uint8_t> has_matrix(scene_.objects.size(), 0);
  Survey survey;
  for (Triangle& triangle : triangles_) {
    triangle.renewed = work.renew[triangle.mesh] != 0;
    if (triangle.renewed) {
      if (has_matrix[triangle.mesh] == 0) {
        object_to_clip_[triangle.mesh] = product<Number>(work.pose.eye_to_clip, work.pose.object_to_eye[triangle.mesh]);
        has_matrix[triangle.mesh] = 1;
      }
      transform(triangle);
    }
    survey.guarded = survey.guarded || triangle.needs_guard;
  }
  allocate(survey);
  return survey;
}

void Computation::transform(Triangle& triangle) {
  const geometry::Mesh& mesh = *scene_.objects[triangle.mesh].mesh;
  const glm::dmat3& normal_to_eye = work_->pose.normal_to_eye[triangle.mesh];
  geometry::ClipTriangle<Number> corners;
  triangle.needs_guard = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t corner = triangle.corner[i];
    corners[i] = set_up::transform_vertex<Number>(mesh.positions[corner], mesh.normals[corner],
                                                  object_to_clip_[triangle.mesh], normal_to_eye);
    if (triangle.needs_guard) continue;
    triangle.needs_guard = !geometry::within_depth(corners[i]);
    if (triangle.needs_guard) continue;
    triangle.screen[i] = geometry::to_screen(corners[i], format_.viewport);
    triangle.needs_guard = !geometry::within_samples(triangle.screen[i], format_.grids.on_screen, format_.viewport);
  }
  cut_.erase(static_cast<std::uint32_t>(&triangle - triangles_.data()));
  if (triangle.needs_guard) cut(triangle, corners);
}

// A triangle that needs the guard band settles the frame's grid, so its pieces can be fitted at once: what of them is
// drawn decides how many slots it takes.
void Computation::cut(Triangle& triangle, const geometry::ClipTriangle<Number>& corners) {
  const auto pieces = set_up::pieces(corners, guarded_frame_, format_.viewport);
  auto& drawn = cut_[static_cast<std::uint32_t>(&triangle - triangles_.data())];
  triangle.fate = Fate::outside;
  for (const auto& piece : pieces.list()) {
    const auto result =
        set_up::set_up_triangle(piece, triangle.material, triangle.two_sided, guarded_frame_.grid, format_.words);
    if (result.outcome == Outcome::drawn) drawn.push_back(result.words);
    if (triangle.fate != Fate::drawn)
      triangle.fate = result.outcome == Outcome::drawn       ? Fate::drawn
                      : result.outcome == Outcome::back_face ? Fate::back_face
                                                             : Fate::degenerate;
  }
}

// The first piece of a triangle takes the triangle's own slot, further ones free slots of the board, in the order of
// triangles.
void Computation::allocate(Survey& survey) {
  extra_.clear();
  std::size_t next_free = 0;
  for (const auto& [index, pieces] : cut_)
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const Piece piece{triangles_[index].object, pieces[i]};
      if (next_free < free_slots_.size())
        extra_.emplace(free_slots_[next_free++], piece);
      else
        survey.homeless.push_back(piece);
    }
  survey.free_slots = static_cast<std::uint32_t>(free_slots_.size() - next_free);
}

const std::vector<Load>& Computation::set_up(bool guarded, const std::vector<Piece>& adopted) {
  const CountedStep step(operations_);
  step_start_ = operation_counts;
  loads_.clear();
  const bool grid_changed = first_ || guarded != last_guarded_;
  const geometry::SnapGrid& grid = guarded ? format_.grids.guarded : format_.grids.on_screen;
  for (Triangle& triangle : triangles_)
    if (triangle.renewed || grid_changed) fit(triangle, grid);
  std::size_t next_free = extra_.size();
  for (const Piece& piece : adopted) extra_.emplace(free_slots_.at(next_free++), piece);
  load_pieces();
  last_guarded_ = guarded;
  first_ = false;
  return loads_;
}

void Computation::fit(Triangle& triangle, const geometry::SnapGrid& grid) {
  if (triangle.needs_guard) {
    const auto& pieces = cut_.at(static_cast<std::uint32_t>(&triangle - triangles_.data()));
    if (!pieces.empty()) {
      put(triangle.slot, triangle.object, pieces.front());
      triangle.loaded = true;
      return;
    }
  } else {
    const auto result =
        set_up::set_up_triangle(triangle.screen, triangle.material, triangle.two_sided, grid, format_.words);
    triangle.fate = result.outcome == Outcome::drawn       ? Fate::drawn
                    : result.outcome == Outcome::back_face ? Fate::back_face
                                                           : Fate::degenerate;
    if (result.outcome == Outcome::drawn) {
      put(triangle.slot, triangle.object, result.words);
      triangle.loaded = true;
      return;
    }
  }
  if (triangle.loaded) park(triangle.slot);
  triangle.loaded = false;
}

void Computation::load_pieces() {
  for (const auto& [slot, piece] : extra_) {
    const auto last = loaded_extra_.find(slot);
    if (last == loaded_extra_.end() || last->second.object != piece.object || !(last->second.words == piece.words))
      put(slot, piece.object, piece.words);
  }
  for (const auto& [slot, piece] : loaded_extra_)
    if (!extra_.contains(slot)) park(slot);
  loaded_extra_ = extra_;
}

void Computation::put(std::uint32_t slot, std::uint32_t object, const object_processor::TriangleWords& words) {
  loads_.push_back({slot, object, false, operation_counts - step_start_, words});
}

void Computation::park(std::uint32_t slot) {
  loads_.push_back({slot, 0, true, operation_counts - step_start_,
                    object_processor::parked_triangle(static_cast<unsigned>(format_.words.word_bits))});
}

TriangleCounts Computation::triangle_counts() const {
  TriangleCounts counts;
  for (const Triangle& triangle : triangles_) {
    counts.drawn += triangle.fate == Fate::drawn ? 1U : 0U;
    counts.back_faces += triangle.fate == Fate::back_face ? 1U : 0U;
    counts.degenerate += triangle.fate == Fate::degenerate ? 1U : 0U;
    counts.outside += triangle.fate == Fate::outside ? 1U : 0U;
  }
  counts.pieces = extra_.size();
  return counts;
}

std::vector<std::vector<Piece>> place_pieces(std::vector<Piece>& homeless,
                                             const std::vector<std::uint32_t>& free_slots) {
  std::vector<std::vector<Piece>> placed(free_slots.size());
  std::size_t next = 0;
  for (std::size_t unit = 0; unit < free_slots.size(); ++unit)
    while (placed[unit].size() < free_slots[unit] && next < homeless.size()) placed[unit].push_back(homeless[next++]);
  homeless.erase(homeless.begin(), homeless.begin() + static_cast<std::ptrdiff_t>(next));
  return placed;
}

}  // namespace rastertlm::host
