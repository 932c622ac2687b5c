#include "modules/host/computation.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace rastertlm::host {

using geometry::operation_counts;
using geometry::OperationCounts;
using set_up::Outcome;

namespace {

constexpr std::size_t kAhead = 8;  // triangles

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

Computation::Computation(const ResidentScene& scene, const MachineFormat& format, const std::vector<SlotOwner>& owners,
                         VectorVariant variant)
    : scene_(scene),
      format_(format),
      paths_(count_paths()),
      guarded_frame_(geometry::frame_grid(format.grids, true, format.viewport)),
      kernels_(set_up::triangle_kernels(variant)),
      object_corners_{} {
  std::vector<std::size_t> first_object;  // number of the first triangle of each mesh
  std::vector<std::uint32_t> solids;      // before each
  std::size_t count = 0;
  std::uint32_t solid_count = 0;
  for (const ResidentObject& object : scene.objects) {
    first_object.push_back(count);
    solids.push_back(solid_count);
    if (object.solid != nullptr)
      ++solid_count;
    else
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
    triangles_.push_back({owner.object + solids[mesh],
                          static_cast<std::uint32_t>(mesh),
                          {corners[0], corners[1], corners[2]},
                          owner.slot,
                          object.mesh->material[index],
                          object.two_sided});
    owned[owner.slot] = true;
  }
  for (std::uint32_t slot = 0; slot < format.slots; ++slot)
    if (!owned[slot]) free_slots_.push_back(slot);
  screen_.resize((triangles_.size() + kLanes - 1) / kLanes);
  object_to_clip_.resize(scene.objects.size());
  loads_.reserve(triangles_.size());
}

Survey Computation::survey(const FrameWork& work) {
  work_ = &work;
  for (Triangle& triangle : triangles_) triangle.renewed = work.renew[triangle.mesh] != 0;
  prepare_matrices();
  Survey survey;
  for (std::size_t number = 0; number < screen_.size(); ++number) transform(block(number), screen_[number]);
  for (const Triangle& triangle : triangles_) survey.guarded = survey.guarded || triangle.needs_guard;
  allocate(survey);
  return survey;
}

// Of every object that has a renewed triangle here.
void Computation::prepare_matrices() {
  std::vector<std::uint8_t> has_matrix(scene_.objects.size(), 0);
  for (const Triangle& triangle : triangles_) {
    if (!triangle.renewed || has_matrix[triangle.mesh] != 0) continue;
    object_to_clip_[triangle.mesh] =
        matrix_product<double>(work_->pose.eye_to_clip, work_->pose.object_to_eye[triangle.mesh]);
    operations_ += paths_.matrix;
    has_matrix[triangle.mesh] = 1;
  }
}

// A unit's triangles lie apart in the mesh: what the next ones need is asked for while these are computed.
void Computation::prefetch(const Triangle& triangle) const {
  const geometry::Mesh& mesh = *scene_.objects[triangle.mesh].mesh;
  for (const std::uint32_t corner : triangle.corner) {
    __builtin_prefetch(&mesh.positions[corner]);
    __builtin_prefetch(&mesh.normals[corner]);
  }
}

// The block's renewed triangles, object by object.
void Computation::transform(const Block& block, set_up::ScreenCorners& screen) {
  unsigned left = 0;
  for (std::size_t i = block.begin; i < block.end; ++i) {
    const Triangle& triangle = triangles_[i];
    if (i + kAhead < triangles_.size()) prefetch(triangles_[i + kAhead]);
    if (!triangle.renewed) continue;
    const std::size_t lane = i - block.begin;
    left |= 1U << lane;
    const geometry::Mesh& mesh = *scene_.objects[triangle.mesh].mesh;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3& position = mesh.positions[triangle.corner[c]];
      const glm::dvec3& normal = mesh.normals[triangle.corner[c]];
      for (int component = 0; component < 3; ++component) {
        object_corners_.position[c][component][lane] = position[component];
        object_corners_.normal[c][component][lane] = normal[component];
      }
    }
  }
  while (left != 0) {
    const std::uint32_t mesh = triangles_[block.begin + static_cast<std::size_t>(std::countr_zero(left))].mesh;
    unsigned lanes = 0;
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (triangles_[i].mesh == mesh) lanes |= 1U << (i - block.begin);
    transform_of_mesh(block, lanes & left, mesh, screen);
    left &= ~lanes;
  }
}

// Those that need the guard band once more from the start, counting.
void Computation::transform_of_mesh(const Block& block, unsigned lanes, std::uint32_t mesh,
                                    set_up::ScreenCorners& screen) {
  set_up::TransformRequest request = set_up::transform_request(object_to_clip_[mesh], work_->pose.normal_to_eye[mesh],
                                                               format_.grids.on_screen, format_.viewport);
  request.lanes = lanes;
  const unsigned inside = kernels_.transform(request, object_corners_, screen);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    Triangle& triangle = triangles_[block.begin + lane];
    triangle.needs_guard = (inside >> lane & 1U) == 0;
    if (!cut_.empty()) cut_.erase(static_cast<std::uint32_t>(block.begin + lane));
    if (triangle.needs_guard)
      transform_counted(triangle);
    else
      operations_ += paths_.three_inside;
  }
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

const std::vector<Load>& Computation::set_up(bool guarded, const std::vector<Piece>& adopted, bool timed) {
  step_start_ = operations_;
  timed_ = timed;
  loads_.clear();
  before_.clear();
  const bool grid_changed = first_ || guarded != last_guarded_;
  grid_ = guarded ? format_.grids.guarded : format_.grids.on_screen;
  request_ = set_up::fit_request(grid_, format_.words);
  for (std::size_t number = 0; number < screen_.size(); ++number) {
    const Block these = block(number);
    unsigned lanes = 0;
    for (std::size_t i = these.begin; i < these.end; ++i)
      if (triangles_[i].renewed || grid_changed) lanes |= 1U << (i - these.begin);
    if (lanes != 0) fit(these, screen_[number], lanes);
  }
  std::size_t next_free = extra_.size();
  for (const Piece& piece : adopted) extra_.emplace(free_slots_.at(next_free++), piece);
  load_pieces();
  last_guarded_ = guarded;
  first_ = false;
  return loads_;
}

void Computation::fit(const Block& block, const set_up::ScreenCorners& screen, unsigned lanes) {
  fitted_.drawn = fitted_.turned_away = 0;
  fitted_.left = set_up::kAllLanes;
  if (request_) kernels_.fit(*request_, screen, fitted_);
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    Triangle& triangle = triangles_[block.begin + lane];
    const auto in = [lane](unsigned some) { return (some >> lane & 1U) != 0; };
    if (triangle.needs_guard) {
      put_pieces(triangle);
    } else if (in(fitted_.left) || (in(fitted_.turned_away) && triangle.two_sided)) {
      fit_alone(triangle, screen, lane);
    } else if (in(fitted_.drawn)) {
      operations_ += paths_.drawn;
      settle(triangle, Outcome::drawn);
      object_processor::TriangleWords& words = put(triangle.slot, triangle.object);
      set_up::take_words(fitted_, lane, words);
      words.material = triangle.material;
    } else {
      const Outcome outcome = in(fitted_.turned_away) ? Outcome::back_face : Outcome::degenerate;
      operations_ += paths_.of(outcome);
      settle(triangle, outcome);
    }
  }
}

// What became of a triangle. One that is no longer drawn is parked.
void Computation::settle(Triangle& triangle, Outcome outcome) {
  triangle.fate = outcome == Outcome::drawn       ? Fate::drawn
                  : outcome == Outcome::back_face ? Fate::back_face
                                                  : Fate::degenerate;
  if (outcome != Outcome::drawn && triangle.loaded) park(triangle.slot);
  triangle.loaded = outcome == Outcome::drawn;
}

// Its fate has been known since it was cut.
void Computation::put_pieces(Triangle& triangle) {
  const auto& pieces = cut_.at(static_cast<std::uint32_t>(&triangle - triangles_.data()));
  if (!pieces.empty())
    put(triangle.slot, triangle.object) = pieces.front();
  else if (triangle.loaded)
    park(triangle.slot);
  triangle.loaded = !pieces.empty();
}

void Computation::fit_alone(Triangle& triangle, const set_up::ScreenCorners& screen, std::size_t lane) {
  set_up::SetUpResult result;
  if (format_.words.edges == set_up::EdgeForm::snapped) {
    result = set_up::set_up_triangle<double>(set_up::triangle_of_lane<double>(screen, lane), triangle.material,
                                             triangle.two_sided, grid_, format_.words);
    operations_ += paths_.of(result.outcome);
  } else {
    const CountedStep step(operations_);
    result = set_up::set_up_triangle<Number>(set_up::triangle_of_lane<Number>(screen, lane), triangle.material,
                                             triangle.two_sided, grid_, format_.words);
  }
  settle(triangle, result.outcome);
  if (result.outcome == Outcome::drawn) put(triangle.slot, triangle.object) = result.words;
}

void Computation::load_pieces() {
  for (const auto& [slot, piece] : extra_) {
    const auto last = loaded_extra_.find(slot);
    if (last == loaded_extra_.end() || last->second.object != piece.object || !(last->second.words == piece.words))
      put(slot, piece.object) = piece.words;
  }
  for (const auto& [slot, piece] : loaded_extra_)
    if (!extra_.contains(slot)) park(slot);
  loaded_extra_ = extra_;
}

object_processor::TriangleWords& Computation::put(std::uint32_t slot, std::uint32_t object) {
  if (timed_) before_.push_back(operations_ - step_start_);
  return loads_.emplace_back(Load{slot, object, false, {}}).words;
}

void Computation::park(std::uint32_t slot) {
  put(slot, 0) = object_processor::parked_triangle(static_cast<unsigned>(format_.words.word_bits));
  loads_.back().park = true;
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
