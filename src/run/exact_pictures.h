// The exact pictures of a simulation: rendered by itself, or shared with simulations of the same scene on the same
// screen. One of a scene and a view is made once.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "platforms/imogene/machine.h"
#include "platforms/quadratic/machine.h"
#include "src/frame/frame.h"
#include "src/reference/error_meter.h"
#include "src/reference/renderer.h"
#include "src/run/simulate.h"
#include "src/scene/scene.h"

namespace rastertlm::run {

// What a machine is compared with, in the order in which its report has them.
std::vector<reference::RenderOptions> exact_options(const imogene::Machine& machine);
std::vector<reference::RenderOptions> exact_options(const quadratic::Machine& machine);

// What their depth words mean, and by how much a plane's word may be off; none where depths are not compared.
std::optional<reference::DepthWords> depth_words(const imogene::Machine& machine);
std::optional<reference::DepthWords> depth_words(const quadratic::Machine& machine);

// How the errors against that reference are measured.
reference::MeterOptions meter_options(const std::string& reference, const std::optional<reference::DepthWords>& depth,
                                      const Options& options);

// A picture, and the SHA-256 of what it is of: the scene, what moves in it at that frame, the screen and the options.
struct KeptPicture {
  std::string digest;
  frame::ExactFrame picture;
};

// A sphere has no triangles to tell apart: pixels that both show are of the same thing.
void take_objects(const frame::Frame& shown, frame::ExactFrame& spheres);

class ExactPictures {
 public:
  ExactPictures(const scene::Scene& scene, ExactStore* store) : scene_(scene), store_(store) {}
  // The picture of the scene in that pose, into `kept`; where that holds it already, or `other` does, nothing is made.
  void render(const scene::Pose& pose, const reference::RenderOptions& options, KeptPicture& kept,
              const KeptPicture* other = nullptr);
  // Of its spheres, solids or what meshes stand for.
  void render_spheres(const scene::Pose& pose, std::size_t columns, std::size_t lines, KeptPicture& kept);

  // How many pictures were wanted, and how many of them were not there yet.
  std::uint64_t wanted() const { return wanted_; }
  std::uint64_t made() const { return made_; }
  std::chrono::steady_clock::duration time() const { return time_; }  // that they took

 private:
  void keep(const std::string& key, const std::function<frame::ExactFrame()>& render, KeptPicture& kept,
            const KeptPicture* other);

  const scene::Scene& scene_;
  ExactStore* store_;
  std::uint64_t wanted_ = 0;
  std::uint64_t made_ = 0;
  std::chrono::steady_clock::duration time_{};
};

}  // namespace rastertlm::run
