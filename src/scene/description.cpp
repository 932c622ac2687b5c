#include "src/scene/description.h"

namespace rastertlm::scene {
namespace {

using parameter::Condition;
using parameter::Range;

constexpr Range<double> kCoordinate{-kFarthest, kFarthest};
constexpr Range<double> kAngle{-1e9, 1e9};
constexpr Range<double> kFraction{0.0, 1.0};
constexpr Range<double> kLength{0.0, kFarthest, true};
constexpr Range<double> kCoefficient{-1e100, 1e100};

const std::vector<std::string> kUpright{"cylinder", "cone", "paraboloid", "hyperboloid"};

Condition type_is(std::vector<std::string> values) { return {"type", std::move(values)}; }

}  // namespace

void KeyDescription::declare(parameter::Table& table) {
  table.real("frame", frame, {-1e9, 1e9},
             {"frames", "Number of the frame at which the thing is there; keys go upwards.", "picture"});
  table.triple("translate", translate, kCoordinate,
               {"world units", "Where it is then, from where the scene puts it.", "picture"});
  table.triple("rotate_deg", rotate_deg, kAngle,
               {"degrees", "How it is turned then, about x, then y, then z of the world.", "picture"});
}

void AnimationDescription::declare(parameter::Table& table) {
  table.choice("type", kind, {"spin", "orbit", "keys"},
               {"",
                "spin turns in the thing's own space (the camera: in place), orbit about an axis of the world, keys go "
                "linearly from key "
                "to key; several apply in the order of the file.",
                "picture of every frame but frame 0"});
  const auto turning = type_is({"spin", "orbit"});
  table.triple("axis", axis, kCoordinate,
               {"", "Direction of the axis, any length; positive angles are counter-clockwise seen from its tip.",
                "picture of every frame but frame 0", turning});
  table.triple(
      "centre", centre, kCoordinate,
      {"world units",
       "A point of the axis: of the thing's own space for spin (the camera: from the eye), of the world for orbit.",
       "picture of every frame but frame 0", turning});
  table.real("deg_per_frame", deg_per_frame, kAngle,
             {"degrees/frame", "Angle of a frame; frame n is turned by n times it.",
              "picture of every frame but frame 0", turning});
  table.list("key", keys, "Key frames of an animation of type keys: held before the first and after the last.");
}

void CameraDescription::declare(parameter::Table& table) {
  const std::string projection_path = "camera.projection";
  table.choice(projection_path, projection, {"perspective", "orthographic"},
               {"", "How the view volume is projected.", "picture"});
  table.triple("camera.eye", eye, kCoordinate, {"world units", "Where the camera stands.", "picture"});
  table.triple("camera.target", target, kCoordinate,
               {"world units", "The point in the middle of the picture.", "picture"});
  table.triple("camera.up", up, kCoordinate, {"", "Direction that is upright in the picture, any length.", "picture"});
  table.real("camera.vertical_fov_deg", vertical_fov_deg, {0.001, 179.0},
             {"degrees", "Angle between the picture's upper and lower border.", "picture",
              Condition{projection_path, {"perspective"}}});
  table.real("camera.height", height, {0.0, kFarthest, true},
             {"world units", "Height of the view volume.", "picture", Condition{projection_path, {"orthographic"}}});
  table.real("camera.near", near, kCoordinate,
             {"world units", "Distance of the near plane before the eye; above 0 in perspective.",
              "depth; picture where it clips"});
  table.real("camera.far", far, kCoordinate,
             {"world units", "Distance of the far plane, beyond near.", "depth; picture where it clips"});
  table.list("camera.animation", animation, "What moves the camera, in this order.");
}

void LightDescription::declare(parameter::Table& table) {
  table.choice("type", kind, {"directional", "point"}, {"", "Infinitely far, or at a point.", "picture"});
  table.triple("towards", towards, kCoordinate,
               {"", "From the surface to the light in world space, any length.", "picture", type_is({"directional"})});
  table.triple("position", position, kCoordinate,
               {"world units", "Where the light is.", "picture", type_is({"point"}), true});
  table.triple("intensity", intensity, {0.0, 100.0},
               {"", "Red, green and blue; 1 shows a material's own colour.", "picture"});
}

void MaterialDescription::declare(parameter::Table& table) {
  table.text("name", name, {"", "What objects call it.", "nothing: a name", {}, true, true});
  table.triple("colour", colour, kFraction, {"", "Red, green and blue of ambient and diffuse light.", "picture"});
  table.real("ambient", ambient, kFraction, {"", "Ka.", "picture"});
  table.real("diffuse", diffuse, kFraction, {"", "Kd.", "picture"});
  table.real("specular", specular, kFraction, {"", "Ks; highlights have the colour of the light.", "picture"});
  table.integer("exponent", exponent, {1, 1000},
                {"", "Exponent of the highlight; larger is smaller and sharper.", "picture"});
}

void PlaneDescription::declare(parameter::Table& table) {
  table.triple("normal", normal, kCoordinate,
               {"", "Outwards, in the object's own space, any length but 0; the cut shows it.", "picture"});
  table.real(
      "distance", distance, kCoefficient,
      {"", "What remains is where normal . x <= distance; world units where the normal has length 1.", "picture"});
}

void ObjectDescription::declare_solid(parameter::Table& table) {
  table.triple("radii", radii, kLength,
               {"world units", "Half axes along x, y and z.", "picture", type_is({"ellipsoid"})});
  table.real("height", height, kLength,
             {"world units",
              "From z = 0 up; the apex of a cone and a paraboloid is there. A hyperboloid goes from -height/2 to "
              "height/2.",
              "picture", type_is(kUpright)});
  table.integer(
      "sheets", sheets, {1, 2},
      {"", "1: a waist about z = 0; 2: apart, one above and one below.", "picture", type_is({"hyperboloid"})});
  table.real("waist", waist, kLength,
             {"world units",
              "One sheet: the radius at z = 0, less than `radius`. Two: the apexes are at z = -waist and waist, within "
              "the height.",
              "picture", type_is({"hyperboloid"})});
  table.boolean(
      "capped", capped,
      {"", "It ends at its height; else it goes on without end, a cone as two.", "picture", type_is(kUpright)});
  const auto general = type_is({"quadric"});
  table.triple("squares", squares, kCoefficient,
               {"", "Of x^2, y^2 and z^2; the solid is where the polynomial is 0 and less.", "picture", general});
  table.triple("products", products, kCoefficient, {"", "Of xy, yz and zx.", "picture", general});
  table.triple("linear", linear, kCoefficient, {"", "Of x, y and z.", "picture", general});
  table.real("constant", constant, kCoefficient, {"", "What is added to them.", "picture", general});
}

void ObjectDescription::declare(parameter::Table& table) {
  table.choice("type", kind,
               {"teapot", "uv_sphere", "mesh", "triangles", "sphere", "ellipsoid", "cylinder", "cone", "paraboloid",
                "hyperboloid", "quadric"},
               {"",
                "Where its triangles come from; from sphere on it is a solid, its surface exact. The axis of "
                "solids is z.",
                "picture"});
  table.text("material", material,
             {"", "Name of its material; without one, those of the mesh file, or else the scene's first.", "picture"});
  table.triple("translate", translate, kCoordinate, {"world units", "Moved, after all else.", "picture"});
  table.triple("rotate_deg", rotate_deg, kAngle,
               {"degrees", "Turned about x, then y, then z, after scaling.", "picture"});
  table.triple("scale", scale, kCoordinate,
               {"", "Factors along its own axes; negative mirrors, 0 is refused.", "picture"});
  table.boolean("two_sided", two_sided,
                {"", "Back faces are kept and their normals turned, instead of culled. A solid has an outside.",
                 "picture", type_is({"teapot", "uv_sphere", "mesh", "triangles"})});
  table.integer(
      "segments", segments, {1, 128},
      {"", "Quads a patch and direction, of two triangles each.", "picture; number of triangles", type_is({"teapot"})});
  table.integer("patches", patches, {28, 32},
                {"", "28, or 32 with the bottom.", "number of triangles", type_is({"teapot"})});
  table.real("radius", radius, kLength,
             {"world units",
              "Of a sphere or a cylinder; of a cone and a paraboloid at z = 0, of a hyperboloid at z = height/2.",
              "picture", type_is({"uv_sphere", "sphere", "cylinder", "cone", "paraboloid", "hyperboloid"})});
  table.integer("slices", slices, {3, 4096},
                {"", "Sectors of longitude.", "picture; number of triangles", type_is({"uv_sphere"})});
  table.integer("stacks", stacks, {2, 4096},
                {"", "Bands of latitude.", "picture; number of triangles", type_is({"uv_sphere"})});
  table.text("file", file,
             {"", "OBJ, PLY, STL or glTF 2, relative to the scene file.", "picture", type_is({"mesh"}), true});
  table.triples("positions", positions,
                {"world units", "Corners, three a triangle or as `indices` say; counter-clockwise from outside.",
                 "picture", type_is({"triangles"}), true});
  table.triples("normals", normals,
                {"", "One a position, any length; computed where there are none.", "picture", type_is({"triangles"})});
  table.index_triples(
      "indices", indices,
      {"", "Three positions a triangle, counted from 0.", "picture; number of triangles", type_is({"triangles"})});
  declare_solid(table);
  table.list("animation", animation, "What moves the object, in this order.");
  table.list("plane", planes, "Planes that cut a solid.");
}

void SceneDescription::declare(parameter::Table& table) {
  table.integer("schema", schema, {1, 1},
                {"", "Version of this file's form.", "nothing: 1 is the only one", {}, true, true});
  table.triple("background", background, {0.0, 255.0}, {"levels", "Shown where no object is.", "picture"});
  table.triple("ambient_light", ambient_light, {0.0, 100.0}, {"", "Ia, red, green and blue.", "picture"});
  table.choice("lighting.model", model, {"blinn", "phong"},
               {"", "Highlights from N.H (Blinn) or from R.V (Phong).", "picture, at highlights"});
  table.boolean("lighting.specular_gate", specular_gate,
                {"", "No highlight where the light is behind the surface (N.L <= 0).",
                 "picture, at highlights near the terminator"});
  camera.declare(table);
  table.list("light", lights, "Lights; at least one.");
  table.list("material", materials, "Materials, named.");
  table.list("object", objects, "Objects; at least one.");
}

}  // namespace rastertlm::scene
