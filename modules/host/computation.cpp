#include "modules/host/computation.h"

#include <algorithm>
#include <utility>

namespace rastertlm::host {

using geometry::operation_counts;
using geometry::OperationCounts;
using set_up::Outcome;

namespace {

constexpr std::size_t kAhead = 4;  // triangles

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
    : scene_(scene),
      format_(format),
      paths_(count_paths()),
      guarded_frame_(geometry::frame_grid(format.grids, true, format.viewport)) {
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
  loads_.reserve(triangles_.size());
}

Survey Computation::survey(const FrameWork& work) {
  work_ = &work;
  std::vector<std::uint8_t> has_matrix(scene_.objects.size(), 0);
  Survey survey;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    Triangle& triangle = triangles_[i];
    if (i + kAhead < triangles_.size()) prefetch(triangles_[i + kAhead]);
    triangle.renewed = work.renew[triangle.mesh] != 0;
    if (triangle.renewed) {
      if (has_matrix[triangle.mesh] == 0) {
        object_to_clip_[triangle.mesh] =
            matrix_product<double>(work.pose.eye_to_clip, work.pose.object_to_eye[triangle.mesh]);
        operations_ += paths_.matrix;
        has_matrix[triangle.mesh] = 1;
      }
      transform(triangle);
    }
    survey.guarded = survey.guarded || triangle.needs_guard;
  }
  allocate(survey);
  return survey;
}

// A unit's triangles lie apart in the mesh: what the next ones need is asked for while this one is computed.
void Computation::prefetch(const Triangle& triangle) const {
  const geometry::Mesh& mesh = *scene_.objects[triangle.mesh].mesh;
  for (const std::uint32_t corner : triangle.corner) {
    __builtin_prefetch(&mesh.positions[corner]);
    __builtin_prefetch(&mesh.normals[corner]);
  }
}

// With plain numbers as long as no corner needs the guard band; otherwise from the start again, counting.
void Computation::transform(Triangle& triangle) {
  const geometry::Mesh& mesh = *scene_.objects[triangle.mesh].mesh;
  const glm::dmat3& normal_to_eye = work_->pose.normal_to_eye[triangle.mesh];
  const glm::dmat4& object_to_clip = object_to_clip_[triangle.mesh];
  triangle.needs_guard = false;
  for (std::size_t i = 0; i < 3 && !triangle.needs_guard; ++i) {
    const std::uint32_t corner = triangle.corner[i];
    geometry::ScreenVertex<double> screen;
    triangle.needs_guard = !on_screen(
        set_up::transform_vertex<double>(mesh.positions[corner], mesh.normals[corner], object_to_clip, normal_to_eye),
        format_.grids.on_screen, format_.viewport, screen);
    triangle.screen[i] = {screen.x, screen.y, screen.z, screen.normal};
  }
  if (!cut_.empty()) cut_.erase(static_cast<std::uint32_t>(&triangle - triangles_.data()));
  if (triangle.needs_guard)
    transform_counted(triangle);
  else
    operations_ += paths_.three_inside;
}

void Computation::transform_counted(Triangle& triangle) {
  const CountedStep step(operations_);
  const geometry::Mesh& mesh = *scene_.objects[triangle.mesh].mesh;
  const glm::dmat3& normal_to_eye = work_->pose.normal_to_eye[triangle.mesh];
  const glm::dmat4& object_to_clip = object_to_clip_[triangle.mesh];
  geometry::ClipTriangle<Number> corners;
  geometry::ScreenVertex<Number> screen{};
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = set_up::transform_vertex<Number>(mesh.positions[triangle.corner[i]], mesh.normals[triangle.corner[i]],
                                                  object_to_clip, normal_to_eye);
    // Once one needs the band, the others are only transformed.
    inside = inside && on_screen(corners[i], format_.grids.on_screen, format_.viewport, screen);
  }
  cut(triangle, corners);
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
  step_start_ = operations_;
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
    const set_up::SetUpResult result = fit_words(triangle, grid);
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

// 1 / w, which the words do not need, is not kept.
template <class T>
set_up::ScreenTriangle<T> Computation::on_screen_again(const std::array<Corner, 3>& corners) {
  set_up::ScreenTriangle<T> screen;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& c = corners[i];
    screen[i] = {c.x, c.y, c.z, 1.0, {c.normal.x, c.normal.y, c.normal.z}};
  }
  return screen;
}

set_up::SetUpResult Computation::fit_words(const Triangle& triangle, const geometry::SnapGrid& grid) {
  if (format_.words.edges == set_up::EdgeForm::snapped) {
    const auto result = set_up::set_up_triangle<double>(on_screen_again<double>(triangle.screen), triangle.material,
                                                        triangle.two_sided, grid, format_.words);
    operations_ += paths_.of(result.outcome);
    return result;
  }
  const CountedStep step(operations_);
  return set_up::set_up_triangle<Number>(on_screen_again<Number>(triangle.screen), triangle.material,
                                         triangle.two_sided, grid, format_.words);
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
  loads_.push_back({slot, object, false, operations_ - step_start_, words});
}

void Computation::park(std::uint32_t slot) {
  loads_.push_back({slot, 0, true, operations_ - step_start_,
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
