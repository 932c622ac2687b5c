// Times frames of the quadratic machine's simulation beside a plain loop that draws the same: see README.md.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "platforms/quadratic/quadratic.h"
#include "tests/benchmark/benchmark_scene.h"
#include "tests/benchmark/measuring.h"
#include "tests/benchmark/plain_quadratic.inc"
#include "tests/benchmark/plain_variants.h"
#include "tests/support/forked.h"

namespace plain_quadratic {
namespace baseline {
std::unique_ptr<Loop> make(std::vector<Triangle>, std::vector<Material>, const std::uint8_t (&)[3]);
}
namespace avx2 {
std::unique_ptr<Loop> make(std::vector<Triangle>, std::vector<Material>, const std::uint8_t (&)[3]);
}
namespace avx512 {
std::unique_ptr<Loop> make(std::vector<Triangle>, std::vector<Material>, const std::uint8_t (&)[3]);
}
}  // namespace plain_quadratic

namespace rastertlm::benchmark {
namespace {

std::unique_ptr<plain_quadratic::Loop> loop_of(const scene::Scene& scene) {
  std::vector<plain_quadratic::Triangle> triangles;
  for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Mesh& mesh = scene.objects[o].mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      plain_quadratic::Triangle& triangle = triangles.emplace_back();
      triangle.object = o;
      triangle.material = mesh.material[t];
      for (std::size_t i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) {
          triangle.position[i][c] = mesh.positions[mesh.triangles[t][i]][c];
          triangle.normal[i][c] = mesh.normals[mesh.triangles[t][i]][c];
        }
    }
  }
  std::vector<plain_quadratic::Material> materials;
  for (const scene::Material& m : scene.materials) {
    plain_quadratic::Material& material = materials.emplace_back();
    material.exponent = m.exponent;
    for (int c = 0; c < 3; ++c) {
      material.ambient[c] = (m.ambient * m.colour)[c] * scene.ambient_light[c];
      material.diffuse[c] = (m.diffuse * m.colour)[c] * scene.lights[0].intensity[c];
      material.specular[c] = m.specular * scene.lights[0].intensity[c];
    }
  }
  const std::uint8_t background[3] = {static_cast<std::uint8_t>(scene.background.x),
                                      static_cast<std::uint8_t>(scene.background.y),
                                      static_cast<std::uint8_t>(scene.background.z)};
  const std::string variant = plain::best_variant();
  if (variant == "avx512") return plain_quadratic::avx512::make(triangles, materials, background);
  if (variant == "avx2") return plain_quadratic::avx2::make(triangles, materials, background);
  return plain_quadratic::baseline::make(triangles, materials, background);
}

plain_quadratic::Pose pose_of(const scene::Pose& pose) {
  plain_quadratic::Pose result;
  for (std::size_t o = 0; o < pose.object_to_eye.size(); ++o) {
    plain_quadratic::ObjectPose& object = result.objects.emplace_back();
    const glm::dmat4 clip = host::matrix_product<double>(pose.eye_to_clip, pose.object_to_eye[o]);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) object.object_to_clip[column][row] = clip[column][row];
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) object.normal_to_eye[column][row] = pose.normal_to_eye[o][column][row];
  }
  for (int c = 0; c < 3; ++c) result.light[c] = pose.lights[0].vector[c];
  return result;
}

// One line of the table; false in front of it where pictures differ.
std::string measured(std::size_t triangles, std::size_t pairs) {
  constexpr std::size_t kWarm = 3;
  constexpr double kScreens = 1.5;
  const scene::Scene scene = random_scene(triangles, kScreens * plain_quadratic::kSide * plain_quadratic::kSide);
  const auto loop = loop_of(scene);
  quadratic::Machine machine;
  std::vector<std::uint8_t> rgb(3 * plain_quadratic::kSide * plain_quadratic::kSide + 64);
  std::vector<double> simulated, plain;
  std::size_t different = 0;
  double started = 0.0;
  quadratic::Quadratic platform(machine, scene, {kWarm + pairs, false},
                                [&](const quadratic::ShownFrame& shown, const frame::Frame& frame) {
                                  const double shown_at = worked();
                                  const bool counts = shown.set_up.animation_frame >= static_cast<std::int64_t>(kWarm);
                                  if (counts) simulated.push_back(shown_at - started);
                                  const plain_quadratic::Pose pose = pose_of(shown.set_up.pose);
                                  const double begin = worked();
                                  loop->frame(pose, rgb.data());
                                  const double end = worked();
                                  if (counts) plain.push_back(end - begin);
                                  for (std::size_t i = 0; i < frame.rgb.size(); ++i)
                                    different += rgb[i] != frame.rgb[i] ? 1 : 0;
                                  started = worked();
                                });
  started = worked();
  platform.run();
  const double a = median(simulated), b = median(plain);
  return fmt::format("{}{:>9} {:>9} | {:>9.3f} {:>9.3f} {:>6.3f} | {:>8.3f}",
                     different == 0 ? "" : "different: ", triangles, loop->covered(), a * 1e-6, b * 1e-6, a / b,
                     b / static_cast<double>(loop->covered()));
}

int run(std::size_t pairs, const std::vector<std::size_t>& sizes) {
  fmt::print(
      "Quadratic machine; plain loop for {}. Milliseconds a frame, medians of {} interleaved pairs.\n\n"
      "triangles   covered | simulated     plain  ratio |   ns/cov\n",
      plain::best_variant(), pairs);
  bool good = true;
  for (const std::size_t triangles : sizes) {
    const std::string row = test::in_child([&] { return measured(triangles, pairs); });
    fmt::print("{}\n", row);
    good = good && !row.starts_with("different");
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace rastertlm::benchmark

int sc_main(int, char**) { return 0; }

int main(int argc, char** argv) {
  try {
    const bool has_pairs = argc >= 3 && std::string(argv[1]) == "--pairs";
    if (argc > 4 || (argc > 1 && !has_pairs))
      throw std::invalid_argument("benchmark_quadratic [--pairs N [TRIANGLES]]");
    const std::vector<std::size_t> sizes =
        argc == 4 ? std::vector<std::size_t>{std::stoul(argv[3])} : std::vector<std::size_t>{64, 1024};
    return rastertlm::benchmark::run(has_pairs ? std::stoul(argv[2]) : 30, sizes);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
