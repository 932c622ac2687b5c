#include "tests/benchmark/benchmark_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rastertlm::benchmark {
namespace {

constexpr std::size_t kObjects = 8;
constexpr std::size_t kBoards = 8;
constexpr double kDistance = 1000.0;  // of the camera: there a world unit is a pixel
constexpr double kDepth = 50.0;       // of the scene, before and behind that
constexpr double kHalfSide = 225.0;   // of the square that it fills: with its movement just within the screen
constexpr double kRadian = 57.295779513082321;

// Numbers of a linear congruential generator, the same everywhere.
class Random {
 public:
  double between(double low, double high) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 20;
};

scene::AnimationDescription jitter(Random& random) {
  scene::AnimationDescription animation;
  animation.kind = scene::AnimationKind::keys;
  for (int frame = 0; frame <= 100; ++frame) {
    scene::KeyDescription key;
    key.frame = frame;
    key.translate = {random.between(-4.0, 4.0), random.between(-4.0, 4.0), random.between(-4.0, 4.0)};
    key.rotate_deg = {0.0, random.between(-1.5, 1.5), 0.0};
    animation.keys.push_back(key);
  }
  return animation;
}

// An equilateral triangle of the radius, turned about the line of sight and tilted by the depths of its corners.
void add_triangle(Random& random, double radius, scene::Mesh& mesh) {
  const double limit = std::max(kHalfSide - radius, 1.0);
  const double x = random.between(-limit, limit);
  const double z = random.between(-limit, limit);
  const double turn = random.between(0.0, 360.0);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const double middle = random.between(-0.8 * kDepth, 0.8 * kDepth);
  for (int i = 0; i < 3; ++i) {
    const double angle = (turn + 120.0 * i) / kRadian;
    const double depth =
        std::clamp(middle + random.between(-1.0, 1.0) * std::min(radius, 0.2 * kDepth), -kDepth, kDepth);
    const double scale = (kDistance + depth) / kDistance;  // on the screen it has its size at every depth
    mesh.positions.emplace_back((x + radius * std::cos(angle)) * scale, depth, (z + radius * std::sin(angle)) * scale);
    mesh.normals.push_back(glm::normalize(glm::dvec3(random.between(-0.6, 0.6), -1.0, random.between(-0.6, 0.6))));
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.material.push_back(static_cast<std::uint16_t>(mesh.triangles.size() % 4));
}

}  // namespace

scene::Scene random_scene(std::size_t triangles, double pixels) {
  scene::Scene scene;
  scene.background = {20, 30, 40};
  scene.camera.eye = {0, -kDistance, 0};
  scene.camera.target = {0, 0, 0};
  scene.camera.vertical_fov_deg = 2.0 * std::atan(256.0 / kDistance) * kRadian;
  scene.camera.near = kDistance - 2.0 * kDepth;
  scene.camera.far = kDistance + 2.0 * kDepth;
  scene.lights.push_back({scene::LightKind::directional, glm::normalize(glm::dvec3(0.5, -1.0, 0.6)), glm::dvec3(1.0)});
  scene.materials = {{"glaze", {0.9, 0.5, 0.2}, 0.1, 0.5, 0.4, 20},
                     {"slate", {0.3, 0.4, 0.6}, 0.1, 0.6, 0.3, 5},
                     {"chalk", {0.9, 0.9, 0.8}, 0.2, 0.7, 0.1, 10},
                     {"steel", {0.6, 0.6, 0.7}, 0.1, 0.4, 0.6, 50}};
  const double radius = std::sqrt(pixels / static_cast<double>(triangles) / (0.75 * std::sqrt(3.0)));
  Random random;
  scene.objects.resize(std::min(kObjects, triangles));
  for (scene::Object& object : scene.objects) object.animation.push_back(jitter(random));
  for (std::size_t i = 0; i < triangles; ++i)
    add_triangle(random, radius, scene.objects[i * scene.objects.size() / triangles].mesh);
  scene.digest = "benchmark";
  return scene;
}

imogene::Machine quick_host_machine(std::size_t processors) {
  imogene::Machine machine;
  machine.host.computation_units = kBoards;
  machine.host.processors_per_unit = static_cast<std::int64_t>(processors / kBoards);
  machine.host.clock_hz = 1'000'000'000;
  machine.host.sustained_mflops = 1e6;
  machine.host.bus_cycles_per_word = 1;
  machine.host.link_mbit_per_s = 1e6;
  return machine;
}

std::vector<plain::Triangle> plain_triangles(const scene::Scene& scene) {
  std::vector<plain::Triangle> triangles;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    const scene::Mesh& mesh = scene.objects[object].mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      plain::Triangle& triangle = triangles.emplace_back();
      triangle.object = static_cast<std::uint32_t>(object);
      triangle.material = mesh.material[t];
      for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
          triangle.corner[i].position[k] = mesh.positions[mesh.triangles[t][i]][k];
          triangle.corner[i].normal[k] = mesh.normals[mesh.triangles[t][i]][k];
        }
    }
  }
  std::vector<plain::Triangle> by_processor;
  for (std::size_t board = 0; board < kBoards; ++board)
    for (std::size_t i = board; i < triangles.size(); i += kBoards) by_processor.push_back(triangles[i]);
  return by_processor;
}

plain::Pose plain_pose(const scene::Pose& pose) {
  plain::Pose result;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) result.eye_to_clip[column][row] = pose.eye_to_clip[column][row];
  for (std::size_t o = 0; o < pose.object_to_eye.size(); ++o) {
    plain::ObjectPose& object = result.objects.emplace_back();
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) object.object_to_eye[column][row] = pose.object_to_eye[o][column][row];
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) object.normal_to_eye[column][row] = pose.normal_to_eye[o][column][row];
  }
  return result;
}

}  // namespace rastertlm::benchmark
