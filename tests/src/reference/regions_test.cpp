// Are silhouettes, highlights and edges of triangles where they are?
#include "src/reference/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/frame/fields.h"
#include "tests/src/reference/pictures.h"

namespace rastertlm::reference {
namespace {

using frame::Region;
using testing_support::add_flat_triangle;
using testing_support::add_triangle;
using testing_support::kToEye;
using testing_support::Picture;
using testing_support::Random;

// A letter a pixel: background ., inside i, highlights h, silhouettes s.
std::string letters(const frame::ExactFrame& picture, std::size_t line) {
  std::string text;
  for (std::size_t column = 0; column < picture.columns; ++column)
    text += ".ihs"[static_cast<std::size_t>(picture.region[line * picture.columns + column])];
  return text;
}

// Of two triangles, samples first_column..last_column x first_line..last_line, at z < 0.
void add_rectangle(scene::Mesh& mesh, double first_column, double last_column, double first_line, double last_line,
                   double z, const glm::dvec3& normal = kToEye) {
  const double left = first_column - 0.5, right = last_column + 0.5;
  const double top = -(first_line - 0.5), bottom = -(last_line + 0.5);
  add_triangle(mesh, {{{left, bottom, z}, {right, bottom, z}, {right, top, z}}}, {normal, normal, normal});
  add_triangle(mesh, {{{left, bottom, z}, {right, top, z}, {left, top, z}}}, {normal, normal, normal});
}

TEST(Regions, TwoPixelsOnEitherSideOfAnOutline) {
  Picture p(16, 12);
  p.look_at_pixels();
  add_rectangle(p.add_object(), 4, 12, 3, 9, -30);
  const frame::ExactFrame picture = p.render_as(Reference::ideal);
  EXPECT_EQ(letters(picture, 0), "................");
  EXPECT_EQ(letters(picture, 1), "...sssssssssss..") << "corners are cut";
  EXPECT_EQ(letters(picture, 4), "..sssssssssssss.");
  EXPECT_EQ(letters(picture, 5), "..ssssiiiiissss.");
  EXPECT_EQ(letters(picture, 7), "..ssssiiiiissss.");
  EXPECT_EQ(letters(picture, 8), "..sssssssssssss.");
  EXPECT_EQ(letters(picture, 10), "..sssssssssssss.");
  EXPECT_EQ(letters(picture, 11), "...sssssssssss..");
}

// The screen's border is no silhouette; what hides another part of the same object ends at its edge, and another object
// that lies beside it at the same depth is another surface.
TEST(Regions, SurfacesEndWhereTheyHideOthersAndWhereObjectsEnd) {
  Picture hidden(24, 6);
  hidden.look_at_pixels();
  scene::Mesh& mesh = hidden.add_object();
  add_rectangle(mesh, 0, 11, 0, 5, -30);
  add_rectangle(mesh, 0, 23, 0, 5, -40);
  Picture beside(24, 6);
  beside.look_at_pixels();
  add_rectangle(beside.add_object(), 0, 11, 0, 5, -30);
  add_rectangle(beside.add_object(), 12, 23, 0, 5, -30);
  for (Picture* p : {&hidden, &beside})
    for (const Reference kind : {Reference::ideal, Reference::snapped, Reference::true_model})
      EXPECT_EQ(letters(p->render_as(kind), 2), "iiiiiiiiiissssiiiiiiiiii");
}

// Two slopes of one object that meet in a ridge: an edge, no silhouette. Columns 0..11 fall to the left, 12..23 to the
// right; both flat in y. The diagonals of the two rectangles are edges too.
TEST(Regions, RidgesAreEdgesAndNoSilhouettes) {
  Picture p(24, 4);
  p.look_at_pixels();
  scene::Mesh& mesh = p.add_object();
  const auto add_slope = [&](double outer) {
    const glm::dvec3 far_top(outer, 0.5, -50), far_bottom(outer, -3.5, -50);
    const glm::dvec3 top(11.5, 0.5, -20), bottom(11.5, -3.5, -20);
    add_flat_triangle(mesh, {far_bottom, bottom, top});
    add_flat_triangle(mesh, {far_bottom, top, far_top});
  };
  add_slope(-0.5);
  add_slope(23.5);
  for (const std::size_t i : {2, 3}) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  const frame::ExactFrame picture = p.render_as(Reference::ideal);
  for (std::size_t line = 0; line < 4; ++line) {
    EXPECT_EQ(letters(picture, line), std::string(24, 'i'));
    if (line == 0) continue;  // the diagonals end beside the ridge there
    EXPECT_EQ(picture.edges[line * 24 + 11] & frame::kEdgeToTheRight, frame::kEdgeToTheRight) << line;
  }
}

// A triangle of one column between two others: no two pixels of it in a line, so nothing to take a slope of.
TEST(Regions, EdgesNeedTwoPixelsOfBothTriangles) {
  frame::ExactFrame picture;
  picture.resize(9, 1);
  picture.object = {1, 1, 2, 2, 3, 4, 4, 5, 5};
  const std::vector<float> specular(9, 0.0F);
  mark_regions(picture, specular, [](std::size_t, std::size_t) { return false; });
  EXPECT_EQ(picture.edges, (std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(letters(picture, 0), "iiiiiiiii");
}

// Ks 0.4 and E 4: 255 * 0.4 * cos^4 of the angle between normal and half vector is 32 levels at cos = 0.748.
TEST(Regions, HighlightsAreWhereSpecularLightAddsAnEighth) {
  for (const double cosine : {0.74, 0.76}) {
    Picture p(16, 12);
    p.look_at_pixels();
    p.add_light({scene::LightKind::directional, kToEye, glm::dvec3(1.0)});
    const glm::dvec3 normal(std::sqrt(1 - cosine * cosine), 0, cosine);
    add_rectangle(p.add_object(), 4, 12, 3, 9, -30, normal);
    EXPECT_EQ(letters(p.render_as(Reference::true_model), 6), cosine < 0.75 ? "..ssssiiiiissss." : "..sssshhhhhssss.");
  }
}

TEST(Regions, AreThoseOfADefinitionPixelByPixel) {
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    frame::ExactFrame picture;
    picture.resize(static_cast<std::size_t>(random.whole(1, 30)), static_cast<std::size_t>(random.whole(1, 12)));
    const auto columns = static_cast<std::int64_t>(picture.columns);
    const auto lines = static_cast<std::int64_t>(picture.lines);
    std::vector<float> specular;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
      const bool as_before = i > 0 && random.whole(0, 3) > 0;
      picture.object[i] = as_before ? picture.object[i - 1] : static_cast<std::uint32_t>(random.whole(0, 5));
      specular.push_back(static_cast<float>(random.whole(0, 64)));
    }
    // Objects 1, 2 and 3 are of one surface, 4 and 5 of another.
    const auto surface = [&](std::int64_t pixel) {
      const std::uint32_t object = picture.object[static_cast<std::size_t>(pixel)];
      return object == 0 ? 0 : (object <= 3 ? 1 : 2);
    };
    mark_regions(picture, specular, [&](std::size_t a, std::size_t b) {
      return surface(static_cast<std::int64_t>(a)) != surface(static_cast<std::int64_t>(b));
    });
    const auto ends_beside = [&](std::int64_t x, std::int64_t y) {
      const auto differs = [&](std::int64_t u, std::int64_t v) {
        return u >= 0 && v >= 0 && u < columns && v < lines && surface(v * columns + u) != surface(y * columns + x);
      };
      return differs(x - 1, y) || differs(x + 1, y) || differs(x, y - 1) || differs(x, y + 1);
    };
    for (std::int64_t y = 0; y < lines; ++y)
      for (std::int64_t x = 0; x < columns; ++x) {
        const auto pixel = static_cast<std::size_t>(y * columns + x);
        Region wanted =
            picture.object[pixel] == 0 ? Region::none : (specular[pixel] >= 32 ? Region::highlights : Region::inside);
        for (std::int64_t v = std::max<std::int64_t>(y - 1, 0); v <= std::min(y + 1, lines - 1); ++v)
          for (std::int64_t u = std::max<std::int64_t>(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u)
            if (ends_beside(u, v)) wanted = Region::silhouettes;
        EXPECT_EQ(picture.region[pixel], wanted) << x << ',' << y;
      }
  }
}

// Of a picture of two fields, what lies below a line is of the other pose.
TEST(Regions, AreWovenWithTheirLines) {
  frame::ExactFrame even, odd, woven;
  for (frame::ExactFrame* field : {&even, &odd}) field->resize(2, 4);
  std::fill(even.region.begin(), even.region.end(), Region::inside);
  std::fill(odd.region.begin(), odd.region.end(), Region::highlights);
  std::fill(even.edges.begin(), even.edges.end(), std::uint8_t{frame::kEdgeToTheRight | frame::kEdgeBelow});
  frame::copy_lines(even, 0, 2, woven);
  frame::copy_lines(odd, 1, 2, woven);
  EXPECT_EQ(letters(woven, 2) + letters(woven, 3), "iihh");
  EXPECT_EQ(woven.edges, (std::vector<std::uint8_t>{1, 1, 0, 0, 1, 1, 0, 0}));
}

TEST(Regions, SpecularLevelsOfAnotherPictureAreRefused) {
  frame::ExactFrame picture;
  picture.resize(2, 2);
  EXPECT_THROW(mark_regions(picture, std::vector<float>(3), [](std::size_t, std::size_t) { return true; }),
               std::invalid_argument);
}

}  // namespace
}  // namespace rastertlm::reference
