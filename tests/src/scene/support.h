// Descriptions and files for the tests of scenes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "src/base/errors.h"
#include "src/scene/scene.h"

namespace rastertlm::scene::testing {

// A teapot that is lit, of one material.
inline SceneDescription sound_scene() {
  SceneDescription d;
  d.lights.emplace_back();
  d.materials.emplace_back();
  d.materials[0].name = "glaze";
  d.objects.emplace_back();
  d.objects[0].material = "glaze";
  return d;
}

inline SceneDescription one_triangle() {
  SceneDescription d = sound_scene();
  d.objects[0].kind = ObjectKind::triangles;
  d.objects[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  return d;
}

// What build_scene says against it: one line a problem, or "" where it takes it.
inline std::string refusal(const SceneDescription& d, const std::string& directory = ".") {
  try {
    build_scene(d, "scene.toml", directory);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A directory of the test's own that goes with it.
class Directory {
 public:
  Directory() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("rastertlm_") + info->test_suite_name() + "_" + info->name();
    for (char& c : name)
      if (c == '/') c = '_';
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  std::string path() const { return path_.string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace rastertlm::scene::testing
