// Random scenes of solids of every kind, with triangles that go through them, for the tests of the object machine. The
// triangles come first: they have the numbers from 1 on.
#pragma once

#include <fmt/format.h>

#include <array>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/platforms/imogene/scenes.h"

namespace rastertlm::test {

inline const std::string kQuadricMachine = RASTERTLM_SOURCE_DIR "/configs/machines/imogene_quadrics.toml";

class SolidScene {
 public:
  enum class View {
    perspective,
    orthographic,
    near_cuts,   // perspective: the near plane goes through the middle of things
    eye_inside,  // perspective: the eye is within quadrics, of which planes leave parts before it
  };

  SolidScene(std::uint32_t seed, View view) : random_(seed), view_(view) {}

  static constexpr int kTriangles = 4;
  static constexpr int kSolids = 10;  // those about the eye come after them
  // By the planes that cut them: caps and further ones.
  static constexpr std::array<int, kSolids> kPlanes{0, 0, 2, 2, 2, 2, 2, 0, 5, 1};

  // With the solids whose kinds are asked for, those of index i of kSolids where `wanted` holds i; the same ones
  // whatever else is there.
  std::string text(const std::set<int>& wanted = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}) {
    std::string objects = triangles();
    const std::vector<std::string> solids = all_solids();
    for (const int i : wanted) objects += solids.at(static_cast<std::size_t>(i));
    if (view_ == View::eye_inside) objects += about_the_eye();
    return scene_of(objects, camera());
  }

 private:
  std::vector<std::string> all_solids() {
    std::vector<std::string> all;
    all.push_back(solid("sphere", fmt::format("radius = {}\n", size())));
    all.push_back(solid("ellipsoid", fmt::format("radii = [{}, {}, {}]\n", size(), size(), size())));
    for (const char* type : {"cylinder", "cone", "paraboloid"})
      all.push_back(solid(type, fmt::format("radius = {}\nheight = {}\n", size(), 2 * size())));
    all.push_back(solid("hyperboloid", fmt::format("sheets = 1\nradius = {}\nwaist = {}\nheight = {}\n", size(),
                                                   between(0.1, 0.35), 2 * size())));
    all.push_back(solid("hyperboloid", fmt::format("sheets = 2\nradius = {}\nwaist = {}\nheight = {}\n", size(),
                                                   between(0.05, 0.3), 2 * size() + 0.7)));
    // An ellipsoid in general terms, a saddle in a block, and a ball with a slice off.
    all.push_back(
        solid("quadric", fmt::format("squares = [{}, {}, {}]\nproducts = [{}, {}, {}]\nlinear = [{}, 0.2, "
                                     "0.0]\nconstant = -0.8\n",
                                     between(0.8, 2.0), between(0.8, 2.0), between(0.8, 2.0), between(-0.5, 0.5),
                                     between(-0.5, 0.5), between(-0.5, 0.5), between(-0.4, 0.4))));
    all.push_back(solid("quadric", "squares = [-0.7, 0.7, 0.0]\nlinear = [0.0, 0.0, 1.0]\nconstant = -0.4\n",
                        plane(1, 0, 0, 0.6) + plane(-1, 0, 0, 0.6) + plane(0, 1, 0, 0.6) + plane(0, -1, 0, 0.6) +
                            plane(0, 0, -1, 0.3)));
    all.push_back(solid("sphere", fmt::format("radius = {}\n", size()),
                        plane(between(-1, 1), between(-1, 1), 1, between(-0.2, 0.3))));
    return all;
  }

  double between(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
  double size() { return between(0.4, 0.9); }
  static std::string plane(double x, double y, double z, double distance) {
    return fmt::format("[[object.plane]]\nnormal = [{}, {}, {}]\ndistance = {}\n", x, y, z, distance);
  }

  std::string camera() const {
    switch (view_) {
      case View::orthographic:
        return std::string(kCamera) + "projection = \"orthographic\"\nheight = 5.0\nnear = 6.0\nfar = 15.0\n";
      case View::near_cuts:
        return std::string(kCamera) + "near = 9.6\nfar = 15.0\n";
      case View::eye_inside:
        return std::string(kCamera) + "near = 1.0\nfar = 15.0\n";
      default:
        return std::string(kCamera) + "near = 6.0\nfar = 15.0\n";
    }
  }

  // All of them large, and turning about the middle.
  std::string triangles() {
    std::string all;
    for (int i = 0; i < kTriangles; ++i) {
      const auto point = [&] {
        return fmt::format("[{}, {}, {}]", between(-2.5, 2.5), between(-1.5, 1.5), between(-2.5, 2.5));
      };
      const std::string a = point(), b = point(), c = point();
      all += fmt::format(
          "[[object]]\ntype = \"triangles\"\nmaterial = \"slate\"\ntwo_sided = true\npositions = [{}, {}, {}]\n", a, b,
          c);
      all += spin();
    }
    return all;
  }

  std::string spin() {
    return fmt::format("[[object.animation]]\ntype = \"orbit\"\naxis = [{}, {}, {}]\ndeg_per_frame = {}\n",
                       between(-0.4, 0.4), between(-0.4, 0.4), between(0.5, 1.0), between(11.0, 60.0));
  }

  std::string solid(const std::string& type, const std::string& shape, const std::string& planes = "") {
    return fmt::format(
               "[[object]]\ntype = \"{}\"\nmaterial = \"{}\"\n{}rotate_deg = [{}, {}, {}]\ntranslate = [{}, {}, {}]\n",
               type, random_() % 2 == 0 ? "glaze" : "slate", shape, between(-180, 180), between(-180, 180),
               between(-180, 180), between(-1.6, 1.6), between(-1.6, 1.6), between(-1.6, 1.6)) +
           planes + spin();
  }

  // Of a ball about the eye the lower right, and the far half of a waisted tube into which the eye looks from the near
  // one: rays leave the quadric and enter it again.
  static std::string about_the_eye() {
    return "[[object]]\ntype = \"sphere\"\nmaterial = \"glaze\"\nradius = 4.0\ntranslate = [0.0, -10.0, 0.0]\n" +
           plane(-1, 0, 0, -0.5) + plane(0, -0.2, 1, -0.6) +
           "[[object]]\ntype = \"hyperboloid\"\nsheets = 1\nmaterial = \"slate\"\nradius = 2.6\nwaist = 0.8\nheight = "
           "12.0\nrotate_deg = [90.0, 0.0, 3.0]\n" +
           plane(0.1, 0, 1, -0.5);
  }

  std::mt19937 random_;
  View view_;
};

}  // namespace rastertlm::test
