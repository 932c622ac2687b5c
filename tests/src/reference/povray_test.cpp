// Is the true picture what an independent renderer makes of the same triangles and solids? POV-Ray traces smooth
// triangles, and quadrics that planes cut, with a light at a point, a parallel light and a local viewer, in both
// highlight models.
//
// Tolerance: 0.004 levels in every channel of every pixel whose eight neighbours are covered too (POV-Ray's silhouette
// may differ by a sample). That is one step of its 16-bit file; its rounding takes half of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/base/mathematics.h"
#include "src/geometry/quadric.h"
#include "src/scene/solids.h"
#include "tests/src/reference/pictures.h"
#include "tests/src/reference/solids.h"

namespace rastertlm::reference {
namespace {

namespace fs = std::filesystem;
using testing_support::Picture;

constexpr std::size_t kColumns = 160;
constexpr std::size_t kLines = 120;
constexpr double kTolerance = 0.004;  // levels
constexpr double kTanHalfField = 0.36;

// A picture without objects.
Picture lights(scene::LightingModel model) {
  Picture p(kColumns, kLines);
  p.scene.camera.projection = scene::ProjectionKind::perspective;
  const double aspect = static_cast<double>(kColumns) / static_cast<double>(kLines);
  p.pose.eye_to_clip =
      glm::frustumRH_ZO(-kTanHalfField * aspect, kTanHalfField * aspect, -kTanHalfField, kTanHalfField, 1.0, 50.0);
  p.scene.model = model;
  p.scene.specular_gate = true;  // POV-Ray has no highlight where no light falls
  p.scene.materials[0] = {"glaze", {0.9, 0.5, 0.2}, 0.1, 0.5, 0.4, 20};
  p.add_light({scene::LightKind::point, {3, 2, -2}, {0.9, 0.8, 0.7}});
  p.add_light({scene::LightKind::directional, glm::normalize(glm::dvec3{-0.8, 0.3, 0.5}), {0.3, 0.2, 0.25}});
  return p;
}

// A sphere of `slices` x `stacks`, unit normals, in eye space.
void add_sphere(scene::Mesh& mesh, const glm::dvec3& centre, double radius, int slices, int stacks) {
  const auto point = [&](int i, int j) {
    const double azimuth = 360.0 * i / slices;
    const double polar = 180.0 * j / stacks;
    const double ring = mathematics::sin_deg(polar);
    return glm::dvec3{ring * mathematics::cos_deg(azimuth), mathematics::cos_deg(polar),
                      -ring * mathematics::sin_deg(azimuth)};
  };
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    testing_support::add_triangle(mesh, {centre + radius * a, centre + radius * b, centre + radius * c}, {a, b, c});
  };
  for (int j = 0; j < stacks; ++j)
    for (int i = 0; i < slices; ++i) {
      if (j + 1 < stacks) add(point(i, j), point(i, j + 1), point(i + 1, j + 1));
      if (j > 0) add(point(i, j), point(i + 1, j + 1), point(i + 1, j));
    }
}

Picture sphere_and_lights(scene::LightingModel model) {
  Picture p = lights(model);
  add_sphere(p.add_object(), {0.2, -0.1, -8}, 2.4, 20, 12);
  return p;
}

// One of each kind in rows, each turned its own way.
Picture solids_and_lights(scene::LightingModel model) {
  Picture p = lights(model);
  testing_support::Random random(5);
  const std::vector<testing_support::KnownSolid> all = testing_support::one_of_each(random, true);
  for (std::size_t i = 0; i < all.size(); ++i) {
    p.add_object();
    p.scene.objects.back().solid = scene::make_solid(all[i].object);
    const double x = 2.4 * static_cast<double>(i % 4) - 3.6, y = i < 4 ? 1.6 : -1.6;
    glm::dmat4& to_eye = p.pose.object_to_eye.back();
    to_eye = glm::translate(glm::dmat4(1.0), {x, y, -10});
    to_eye = glm::rotate(to_eye, random.between(0, 6), random.normal());
    to_eye = glm::scale(to_eye, glm::dvec3(0.75, 0.6, 0.7));
  }
  return p;
}

// POV-Ray's space is left-handed: z is turned.
std::string vector(const glm::dvec3& v) {
  std::ostringstream text;
  text.precision(17);
  text << '<' << v.x << ',' << v.y << ',' << -v.z << '>';
  return text.str();
}

std::string colour(const glm::dvec3& c) {
  std::ostringstream text;
  text << "rgb <" << c.x << ',' << c.y << ',' << c.z << '>';
  return text.str();
}

// A quadric of eye space as POV-Ray has it: of x^2, y^2, z^2, of xy, xz, yz, of x, y, z and the constant; z is turned.
std::string solid(const geometry::Solid& solid, const glm::dmat4& object_to_eye) {
  const glm::dmat4 q = geometry::quadric_in_eye_space(solid.quadric, object_to_eye);
  std::ostringstream text;
  text.precision(17);
  text << "intersection { quadric { <" << q[0][0] << ',' << q[1][1] << ',' << q[2][2] << ">, <" << 2 * q[0][1] << ','
       << -2 * q[0][2] << ',' << -2 * q[1][2] << ">, <" << 2 * q[0][3] << ',' << 2 * q[1][3] << ',' << -2 * q[2][3]
       << ">, " << q[3][3] << " }";
  for (const glm::dvec4& plane : solid.planes) {
    const glm::dvec4 at = plane * glm::inverse(object_to_eye);
    const double length = glm::length(glm::dvec3(at));
    text << " plane { " << vector(glm::dvec3(at) / length) << ", " << -at.w / length << " }";
  }
  text << " plane { z, 50 } }\n";  // an intersection is of two and more
  return text.str();
}

std::string povray_scene(const Picture& p) {
  const scene::Material& m = p.scene.materials[0];
  std::ostringstream text;
  text.precision(17);
  text << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 ambient_light rgb 1 }\nbackground { rgb 0 }\n";
  text << "camera { perspective location 0 direction <0,0," << 0.5 / kTanHalfField << "> up <0,1,0> right <"
       << static_cast<double>(kColumns) / static_cast<double>(kLines) << ",0,0> }\n";
  for (const scene::Light& light : p.pose.lights) {
    const bool at_point = light.kind == scene::LightKind::point;
    text << "light_source { " << vector(at_point ? light.vector : 100.0 * light.vector) << ' '
         << colour(light.intensity) << (at_point ? "" : " parallel point_at 0") << " }\n";
  }
  text << "union {\n";
  for (std::size_t o = 0; o < p.scene.objects.size(); ++o)
    if (p.scene.objects[o].solid) text << solid(*p.scene.objects[o].solid, p.pose.object_to_eye[o]);
  const scene::Mesh& mesh = p.scene.objects[0].mesh;
  for (const auto& t : mesh.triangles) {
    text << "smooth_triangle { ";
    for (std::size_t i = 0; i < 3; ++i)
      text << vector(mesh.positions[t[i]]) << ',' << vector(mesh.normals[t[i]]) << (i < 2 ? "," : " }\n");
  }
  const bool blinn = p.scene.model == scene::LightingModel::blinn;
  text << "pigment { " << colour(m.colour) << " } finish { ambient " << m.ambient << " diffuse " << m.diffuse << ' '
       << (blinn ? "specular " : "phong ") << m.specular << (blinn ? " roughness 1/" : " phong_size ") << m.exponent
       << " } no_shadow }\n";
  return text.str();
}

// Levels 0..255 of a 16-bit PPM file; empty where it is none.
std::vector<double> read_ppm(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string magic;
  std::size_t columns = 0;
  std::size_t lines = 0;
  int largest = 0;
  in >> magic >> std::ws;
  for (std::string comment; in.peek() == '#';) std::getline(in, comment);
  in >> columns >> lines >> largest;
  in.get();
  if (magic != "P6" || columns != kColumns || lines != kLines || largest != 65535) return {};
  std::vector<double> levels(3 * columns * lines);
  for (double& level : levels) {
    const int high = in.get();
    level = (high * 256 + in.get()) * (255.0 / 65535.0);
  }
  return in ? levels : std::vector<double>{};
}

std::vector<double> traced(const Picture& p) {
  const fs::path directory = fs::path(testing::TempDir()) / ("rastertlm_povray_" + std::to_string(getpid()));
  fs::create_directories(directory);
  std::ofstream(directory / "scene.pov") << povray_scene(p);
  const std::string size = " +W" + std::to_string(kColumns) + " +H" + std::to_string(kLines);
  const std::string command = "cd '" + directory.string() +
                              "' && povray +Iscene.pov +Oscene.ppm +FP16 File_Gamma=1.0 Dither=Off -A -D -P +WT1" +
                              size + " >log 2>&1";
  const int status = std::system(command.c_str());
  std::vector<double> levels = read_ppm(directory / "scene.ppm");
  if (status != 0 || levels.empty()) {
    std::ostringstream log;
    log << std::ifstream(directory / "log").rdbuf();
    ADD_FAILURE() << "povray (package povray) made no picture:\n" << log.str();
  }
  fs::remove_all(directory);
  return levels;
}

// Covered all around, and not beside the outline of a solid.
bool well_inside(const Picture& p, const frame::ExactFrame& frame, std::size_t x, std::size_t y) {
  if (x == 0 || y == 0 || x + 1 == frame.columns || y + 1 == frame.lines) return false;
  for (std::size_t j = y - 1; j <= y + 1; ++j)
    for (std::size_t i = x - 1; i <= x + 1; ++i)
      if (frame.object[j * frame.columns + i] == 0) return false;
  const std::size_t pixel = y * frame.columns + x;
  return p.scene.solid_count() == 0 || frame.region[pixel] != frame::Region::silhouettes;
}

void expect_the_traced_picture(Picture p) {
  const frame::ExactFrame out = p.render_as(Reference::true_model);
  const std::vector<double> levels = traced(p);
  ASSERT_EQ(levels.size(), out.rgb.size());
  double largest = 0.0;
  double brightest = 0.0;
  std::size_t compared = 0;
  for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
    if (!well_inside(p, out, pixel % kColumns, pixel / kColumns)) continue;
    ++compared;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      largest = std::max(largest, std::abs(out.rgb[i] - levels[i]));
      brightest = std::max(brightest, out.rgb[i]);
    }
  }
  EXPECT_GT(compared, 6000U);
  EXPECT_GT(brightest, 200.0);  // more than ambient and diffuse light give: the highlight is in the picture,
  EXPECT_LT(brightest, 255.0);  // and not clamped
  EXPECT_LE(largest, kTolerance);
  testing::Test::RecordProperty("largest_difference", std::to_string(largest));
}

TEST(Povray, PhongsHighlights) { expect_the_traced_picture(sphere_and_lights(scene::LightingModel::phong)); }

TEST(Povray, BlinnsHighlights) { expect_the_traced_picture(sphere_and_lights(scene::LightingModel::blinn)); }

TEST(Povray, SolidsOfEveryKind) {
  expect_the_traced_picture(solids_and_lights(scene::LightingModel::phong));
  expect_the_traced_picture(solids_and_lights(scene::LightingModel::blinn));
}

}  // namespace
}  // namespace rastertlm::reference
