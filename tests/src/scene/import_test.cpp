// Mesh files written by the tests themselves, and one from a package.
#include "src/scene/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/src/scene/mesh_checks.h"
#include "tests/src/scene/support.h"

namespace rastertlm::scene {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const char* const kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string refusal_of(const std::string& path) {
  try {
    import_mesh(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <class T>
std::string raw(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// A glTF 2 file of one triangle and its buffer beside it: indices after three positions.
void write_gltf(const Directory& directory, const std::vector<float>& positions,
                const std::vector<std::uint16_t>& indices, const std::string& node) {
  const std::string buffer = raw(positions) + raw(indices);
  directory.write("mesh.bin", buffer);
  const std::string bytes = std::to_string(buffer.size());
  const std::string split = std::to_string(positions.size() * 4);
  directory.write("mesh.gltf",
                  R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + node +
                      R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
                      R"("materials":[{"name":"gold","pbrMetallicRoughness":{"baseColorFactor":[1.0,0.75,0.25,1.0]}}],)"
                      R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
                      std::to_string(positions.size() / 3) +
                      R"(,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},{"bufferView":1,"componentType":5123,"count":)" +
                      std::to_string(indices.size()) +
                      R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + split +
                      R"(},{"buffer":0,"byteOffset":)" + split + R"(,"byteLength":)" +
                      std::to_string(indices.size() * 2) + R"(}],"buffers":[{"uri":"mesh.bin","byteLength":)" + bytes +
                      "}]}");
}

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n2 2 0\n";

// A small file of nodes that name one mesh again and again would fill any memory.
TEST(Import, MeshesNamedTooOftenAreRefused) {
  const Directory directory;
  std::vector<std::uint16_t> indices;
  for (int face = 0; face < 5000; ++face) indices.insert(indices.end(), {0, 1, 2});
  std::string nodes = R"({"children":[1)", others;
  for (int node = 1; node <= 700; ++node) {
    if (node > 1) nodes.append(",").append(std::to_string(node));
    others += R"(,{"mesh":0})";
  }
  write_gltf(directory, {0, 0, 0, 1, 0, 0, 0, 1, 0}, indices, nodes.append("]}").append(others));
  EXPECT_THAT(refusal_of(directory.path() + "/mesh.gltf"), HasSubstr("in 10500000 places: at most 8388608 are read"));
}

TEST(Import, ObjWithoutNormalsIsSmoothAndClosed) {
  const Directory directory;
  const ImportedMesh imported = import_mesh(directory.write("t.obj", kTetrahedron));
  const Mesh& mesh = imported.mesh;
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_TRUE(imported.materials.empty());
  EXPECT_EQ(seams(mesh).open, 0U);
  EXPECT_NEAR(signed_volume(mesh), 1.0 / 6.0, 1e-15);
  // The corner at the origin: three right angles on the three coordinate planes.
  for (std::size_t i = 0; i < 4; ++i)
    if (mesh.positions[i] == glm::dvec3(0.0)) {
      EXPECT_LT(glm::length(mesh.normals[i] - glm::dvec3(-1 / std::sqrt(3.0))), 1e-15);
    }
  EXPECT_LT(worst_length_error(mesh), 1e-15);
}

TEST(Import, ObjKeepsItsOwnNormals) {
  const Directory directory;
  const std::string path =
      directory.write("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 3 4\nf 1//1 2//1 3//2\n");
  const Mesh mesh = import_mesh(path).mesh;
  EXPECT_EQ(mesh.normals[0], glm::dvec3(0, 0, 1));
  EXPECT_LT(glm::length(mesh.normals[2] - glm::dvec3(0, 0.6, 0.8)), 1e-7);
}

TEST(Import, PolygonsAreTriangulatedAndLinesLeftOut) {
  const Directory directory;
  // A concave arrow head of five corners, area 1.5; a quad, area 1; a line.
  const std::string path = directory.write("p.obj",
                                           "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 0.5 0\nv 0 1 0\n"
                                           "v 0 0 5\nv 1 0 5\nv 1 1 5\nv 0 1 5\nf 1 2 3 4 5\nf 6 7 8 9\nl 1 2\n");
  const Mesh mesh = import_mesh(path).mesh;
  EXPECT_EQ(mesh.triangles.size(), 5U);
  EXPECT_EQ(mesh.left_out, 1U);
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 twice =
        glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    EXPECT_GT(twice.z, 0.0);  // a triangle outside the arrow head would be negative or add area
    area += 0.5 * twice.z;
  }
  EXPECT_DOUBLE_EQ(area, 1.5 + 1.0);
}

TEST(Import, ObjMaterialsComeWithTheirColours) {
  const Directory directory;
  directory.write("c.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0.5 1\n");
  const std::string path = directory.write(
      "c.obj", "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n");
  const ImportedMesh imported = import_mesh(path);
  ASSERT_EQ(imported.materials.size(), 2U);
  EXPECT_EQ(imported.materials[0].name, "c.obj:red");
  EXPECT_EQ(imported.materials[0].colour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(imported.materials[1].name, "c.obj:blue");
  EXPECT_EQ(imported.materials[1].colour, glm::dvec3(0, 0.5, 1));
  EXPECT_EQ(imported.mesh.material, (std::vector<std::uint16_t>{0, 1}));
  // What the file refers to is part of what was read.
  directory.write("c.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0.25 1\n");
  EXPECT_NE(import_mesh(path).digest, imported.digest);
}

TEST(Import, BuildSceneTakesTheFilesMaterialsUnlessTheObjectNamesOne) {
  const Directory directory;
  directory.write("c.mtl", "newmtl red\nKd 1 0 0\n");
  directory.write("c.obj", "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  SceneDescription d = sound_scene();
  d.objects[0].kind = ObjectKind::mesh;
  d.objects[0].file = "c.obj";
  EXPECT_EQ(build_scene(d, "", directory.path()).objects[0].mesh.material[0], 0);
  d.objects.push_back(d.objects[0]);
  d.objects[0].material = d.objects[1].material = "";
  const Scene scene = build_scene(d, "", directory.path());
  ASSERT_EQ(scene.materials.size(), 2U);  // two objects of one file share it
  EXPECT_EQ(scene.materials[1].name, "c.obj:red");
  EXPECT_EQ(scene.objects[0].mesh.material[0], 1);
  EXPECT_EQ(scene.objects[1].mesh.material[0], 1);
}

TEST(Import, SceneDigestFollowsTheMeshFile) {
  const Directory directory;
  directory.write("t.obj", kTetrahedron);
  SceneDescription d = sound_scene();
  d.objects[0].kind = ObjectKind::mesh;
  d.objects[0].file = "t.obj";
  const std::string before = build_scene(d, "", directory.path()).digest;
  directory.write("t.obj", std::string(kTetrahedron) + "# changed\n");
  EXPECT_NE(before, build_scene(d, "", directory.path()).digest);
}

TEST(Import, PlyQuadBecomesTwoTriangles) {
  const Directory directory;
  const Mesh mesh = import_mesh(directory.write("q.ply", kPlyHeader + "0 2 0\n4 0 1 2 3\n")).mesh;
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.positions.size(), 4U);
  for (const auto& n : mesh.normals) EXPECT_EQ(n, glm::dvec3(0, 0, 1));
}

TEST(Import, StlSoupIsJoinedAndSmooth) {
  const Directory directory;
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const char* corners[4] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  std::string text = "solid t\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) text += std::string("vertex ") + corners[corner] + "\n";
    text += "endloop\nendfacet\n";
  }
  const Directory& d = directory;
  const Mesh stl = import_mesh(d.write("t.stl", text + "endsolid t\n")).mesh;
  const Mesh obj = import_mesh(d.write("t.obj", kTetrahedron)).mesh;
  EXPECT_EQ(stl.positions, obj.positions);
  EXPECT_EQ(stl.normals, obj.normals);
  EXPECT_EQ(stl.triangles, obj.triangles);
}

TEST(Import, GltfAppliesNodeTransformsAndMaterial) {
  const Directory directory;
  write_gltf(directory, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2},
             R"({"children":[1],"translation":[10,0,0]},{"mesh":0,"translation":[1,2,3],"scale":[2,4,2]})");
  const ImportedMesh imported = import_mesh(directory.path() + "/mesh.gltf");
  const Mesh& mesh = imported.mesh;
  ASSERT_EQ(mesh.positions.size(), 3U);
  EXPECT_EQ(mesh.positions[0], glm::dvec3(11, 2, 3));
  EXPECT_EQ(mesh.positions[1], glm::dvec3(13, 2, 3));
  EXPECT_EQ(mesh.positions[2], glm::dvec3(11, 6, 3));
  ASSERT_EQ(imported.materials.size(), 1U);
  EXPECT_EQ(imported.materials[0].name, "mesh.gltf:gold");
  EXPECT_EQ(imported.materials[0].colour, glm::dvec3(1.0, 0.75, 0.25));
}

TEST(Import, GltfMirroredNodeKeepsItsOutside) {
  const Directory directory;
  write_gltf(directory, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3},
             R"({"mesh":0,"scale":[-1,1,1]})");
  const Mesh mesh = import_mesh(directory.path() + "/mesh.gltf").mesh;
  EXPECT_NEAR(signed_volume(mesh), 1.0 / 6.0, 1e-15);
  EXPECT_GT(worst_agreement(mesh), 0.0);
}

TEST(Import, RefusesWhatIsNotAMesh) {
  const Directory d;
  EXPECT_EQ(refusal_of(d.path() + "/none.obj"), d.path() + "/none.obj: does not exist");
  EXPECT_EQ(refusal_of(d.path()), d.path() + ": is not a file");
  EXPECT_EQ(refusal_of(d.write("empty.obj", "")), d.path() + "/empty.obj: is empty");
  for (const char* name : {"text.obj", "text.ply", "text.stl", "text.gltf", "text.glb", "text.toml"})
    EXPECT_THAT(refusal_of(d.write(name, "hello")), HasSubstr(std::string(name) + ": is not a mesh that can be read"))
        << name;
  EXPECT_THAT(refusal_of(d.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\np 2\n")), HasSubstr("has no triangle"));
}

TEST(Import, RefusesVerticesThatAreNotFinite) {
  const Directory d;
  EXPECT_THAT(refusal_of(d.write("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n")),
              HasSubstr("vertex 2 is not finite"));
  EXPECT_THAT(refusal_of(d.write("b.obj", "v 0 0 0\nv 1 0 0\nv inf 1 0\nf 1 2 3\n")), HasSubstr("is not finite"));
  EXPECT_THAT(refusal_of(d.write("c.ply", kPlyHeader + "0 nan 0\n3 0 1 3\n")), HasSubstr("is not finite"));
  EXPECT_THAT(refusal_of(d.write("d.stl",
                                 "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\n"
                                 "endloop\nendfacet\nendsolid a\n")),
              HasSubstr("is not finite"));
  write_gltf(d, {0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 1, 0}, {0, 1, 2}, R"({"mesh":0})");
  EXPECT_THAT(refusal_of(d.path() + "/mesh.gltf"), HasSubstr("is not finite"));
}

TEST(Import, RefusesFacesThatNameNoVertex) {
  const Directory d;
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_THAT(refusal_of(d.write("a.obj", three + "f 1 2 4\n")), HasSubstr("index out of range"));
  EXPECT_THAT(refusal_of(d.write("b.obj", three + "f 1 2 0\n")), HasSubstr("Invalid face index"));
  EXPECT_THAT(refusal_of(d.write("c.obj", three + "f -1 -2 -9\n")), HasSubstr("index out of range"));
  EXPECT_THAT(refusal_of(d.write("d.ply", kPlyHeader + "0 2 0\n3 0 1 4\n")), HasSubstr("out of range"));
  EXPECT_THAT(refusal_of(d.write("e.ply", kPlyHeader + "0 2 0\n3 0 1 -1\n")), HasSubstr("out of range"));
  EXPECT_THAT(refusal_of(d.write("f.ply", kPlyHeader + "0 2 0\n")), HasSubstr("cut short"));
  write_gltf(d, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 1, 3}, R"({"mesh":0})");
  EXPECT_THAT(refusal_of(d.path() + "/mesh.gltf"), HasSubstr("a face names a vertex that does not exist"));
}

// What assimp 5.2.5 does not survive: reads beyond its memory, counts that it believes, headers that it looks for the
// end of for ever. Fuzzing found these; tests/fuzz has more.
TEST(Import, RefusesWhatStopsAssimp) {
  const Directory d;
  const std::string refused = "a.ply: is not a mesh that can be read: its header does not end";
  EXPECT_THAT(refusal_of(d.write("a.ply", "pLy\nformat ascii 1.0\nelement vertex 4\nproperty float x\n")),
              HasSubstr(refused));
  EXPECT_THAT(refusal_of(d.write("a.ply", kPlyHeader.substr(0, kPlyHeader.find("\n0 0 0")) + ";\n0 0 0\n")),
              HasSubstr(refused));
  std::string elements = "ply\nformat binary_little_endian 1.0element faty float z\nelement uchar int vertex_indices\n";
  elements += "end_header\n" + std::string(64, '\0');
  EXPECT_THAT(refusal_of(d.write("b.ply", elements)), HasSubstr("b.ply: is "));
  for (const char* text : {"metric\x80\x80\x80\x80\x80\x80\x80\x80\x80\x80\x80\x80 ", "indexarray{", "geometrynode "})
    EXPECT_THAT(refusal_of(d.write("c.gltf", text)), HasSubstr("c.gltf: is "));
}

// Opening it would wait for somebody who writes.
TEST(Import, DoesNotReadPipesThatAFileNames) {
  const Directory d;
  ASSERT_EQ(::mkfifo((d.path() + "/pipe.mtl").c_str(), 0600), 0);
  const std::string path = d.write("a.obj", "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(import_mesh(path).mesh.triangles.size(), 1U);
}

TEST(Import, SceneErrorNamesTheKeyAndTheFile) {
  const Directory d;
  d.write("flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
  SceneDescription s = sound_scene();
  s.objects[0].kind = ObjectKind::mesh;
  s.objects[0].file = "gone.obj";
  EXPECT_EQ(refusal(s, d.path()), "scene.toml: object[0].file: 'gone.obj' does not exist");
  s.objects[0].file = "flat.obj";
  EXPECT_EQ(refusal(s, d.path()), "scene.toml: object[0]: none of its 1 triangles has an area");
}

// Package glmark2-data. The file has no normals.
TEST(Import, BunnyHas69666Triangles) {
  const Mesh mesh = import_mesh("/usr/share/glmark2/models/bunny.obj").mesh;
  EXPECT_EQ(mesh.triangles.size(), 69666U);
  EXPECT_EQ(mesh.degenerate, 0U);
  EXPECT_EQ(seams(mesh).repeated, 0U);
  EXPECT_GT(signed_volume(mesh), 0.0);
  EXPECT_LT(worst_length_error(mesh), 1e-15);
}

}  // namespace
}  // namespace rastertlm::scene
