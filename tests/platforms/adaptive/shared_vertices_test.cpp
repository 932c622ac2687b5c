// Vertices that triangles share, placed and lit once: the same picture, for less.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "src/run/inputs.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

struct Shown {
  std::uint64_t evaluations = 0;
  std::uint64_t flops = 0;
  std::uint64_t facing = 0;
  std::uint64_t vertices = 0;  // of all triangles of the scene, each once
  std::string software;        // what is counted of a program without hardware
  std::vector<int> rgb;
};

Shown shown(const std::string& method, const std::string& vertices) {
  const std::string packed = in_child([&] {
    std::vector<std::string> settings{"video.columns=160", "video.lines=120"};
    settings.push_back(std::string("set_up.method=").append(method));
    settings.push_back(std::string("set_up.vertices=").append(vertices));
    const run::Inputs inputs =
        run::read_inputs(RASTERTLM_SOURCE_DIR "/configs/machines/adaptive.toml",
                         RASTERTLM_SOURCE_DIR "/configs/scenes/teapot_four_lights.toml", settings);
    std::set<std::uint32_t> used;
    for (const auto& triangle : inputs.content->scene->objects[0].mesh.triangles)
      for (const std::uint32_t corner : {triangle[0], triangle[1], triangle[2]}) used.insert(corner);
    run::Options options;
    options.reference = false;
    std::ostringstream out;
    const run::Result result = run::simulate(inputs, options, [&](const run::FramePixels& pixels) {
      out << pixels.figures.span.lighting_evaluations << ' ' << pixels.figures.host_flops << ' '
          << pixels.figures.facing << ' ' << used.size() << ' ';
      for (const std::uint8_t level : pixels.shown.rgb) out << static_cast<int>(level) << ' ';
    });
    for (const run::Budget& budget : result.budgets)
      if (budget.name == std::string("software.").append(method)) out << '\n' << budget.source;
    return out.str();
  });
  Shown all;
  std::istringstream stream(packed);
  stream >> all.evaluations >> all.flops >> all.facing >> all.vertices;
  all.rgb.resize(3U * 160U * 120U);
  for (int& level : all.rgb) stream >> level;
  EXPECT_TRUE(stream.good());
  std::getline(stream >> std::ws, all.software);
  return all;
}

TEST(SharedVertices, ShowTheSamePictureForLess) {
  for (const char* method : {"gouraud", "regular_subdivision", "highlight_subdivision"}) {
    const Shown corners = shown(method, "corners"), shared = shown(method, "shared");
    int largest = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < corners.rgb.size(); ++i) {
      const int difference = std::abs(corners.rgb[i] - shared.rgb[i]);
      largest = std::max(largest, difference);
      different += difference > 0 ? 1 : 0;
    }
    // A corner's position is taken from the screen there, and from the mesh here: the last bit of a number.
    EXPECT_LE(largest, 1) << method;
    EXPECT_LT(different, corners.rgb.size() / 1000) << method;
    EXPECT_LT(shared.evaluations, corners.evaluations) << method;
    EXPECT_LT(shared.flops, corners.flops) << method;
    EXPECT_NE(shared.software, corners.software) << method;
  }
}

TEST(SharedVertices, AreLitOnce) {
  const Shown corners = shown("gouraud", "corners"), shared = shown("gouraud", "shared");
  EXPECT_EQ(shared.evaluations, shared.vertices);
  EXPECT_EQ(corners.evaluations, 3 * corners.facing);
}

// Where every pixel is lit, no vertex is.
TEST(SharedVertices, OfPhongAreNotLit) { EXPECT_EQ(shown("phong", "shared").evaluations, 0U); }

}  // namespace
}  // namespace rastertlm::test
