// Runs one machine on one scene in a process of its own, and gives its result and its pictures.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "src/frame/frame.h"
#include "src/report/json_report.h"
#include "src/run/simulate.h"
#include "tests/support/forked.h"

namespace rastertlm::test {

inline const std::string kMachine = RASTERTLM_SOURCE_DIR "/configs/machines/imogene.toml";
inline const std::string kTeapot = RASTERTLM_SOURCE_DIR "/configs/scenes/teapot.toml";

struct Simulated {
  run::Result result;  // its reals to nine digits, its metrics to six
  std::vector<frame::Frame> shown;
};

namespace simulation {

template <class T>
void put(std::string& bytes, const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  bytes.append(reinterpret_cast<const char*>(&size), sizeof(size));
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
}

template <class T>
void take(const std::string& bytes, std::size_t& at, std::vector<T>& values) {
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + at, sizeof(size));
  at += sizeof(size);
  values.resize(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + at, size);
  at += size;
}

template <class Frame, class Visit>
void visit_planes(Frame& frame, const Visit& visit) {
  visit(frame.rgb);
  visit(frame.depth);
  visit(frame.normal);
  visit(frame.object);
  visit(frame.material);
  visit(frame.coverage);
}

inline std::string packed(const run::Result& result, const std::vector<frame::Frame>& shown) {
  const std::string json = report::json_text({result, false});
  std::string bytes;
  put(bytes, std::vector<char>(json.begin(), json.end()));
  for (const frame::Frame& frame : shown) visit_planes(frame, [&](const auto& plane) { put(bytes, plane); });
  return bytes;
}

inline Simulated unpacked(const std::string& bytes) {
  Simulated simulated;
  std::size_t at = 0;
  std::vector<char> json;
  take(bytes, at, json);
  simulated.result = report::read_json(std::string(json.begin(), json.end()), "report of a test").result;
  while (at < bytes.size()) {
    frame::Frame& frame = simulated.shown.emplace_back();
    frame.columns = simulated.result.columns;
    frame.lines = simulated.result.lines;
    visit_planes(frame, [&](auto& plane) { take(bytes, at, plane); });
  }
  return simulated;
}

}  // namespace simulation

struct RunOptions {
  std::vector<std::string> set;  // as --set
  std::uint64_t frames = 1;
  bool model_everything = false;
  bool reference = true;
  bool pictures = true;  // give the frames back, not only the figures
};

// Throws InputError where the machine cannot take the scene.
inline Simulated simulate(const std::string& machine_file, const std::string& scene_file, const RunOptions& options) {
  return simulation::unpacked(in_child([&] {
    const run::Inputs inputs = run::read_inputs(machine_file, scene_file, options.set);
    std::vector<frame::Frame> shown;
    const run::Result result =
        run::simulate(inputs, {options.frames, options.model_everything, options.reference, false},
                      [&](const run::FramePixels& pixels) {
                        if (options.pictures) shown.push_back(pixels.shown);
                      });
    return simulation::packed(result, shown);
  }));
}

// Files of a test: scenes and machines that it writes. The folder goes with the test.
class SimulationTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "rastertlm_imogene_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // The file's path.
  std::string written(const std::string& name, const std::string& text) const {
    std::string path = folder_ + '/' + name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  // On the machine of 004 as `options` changes it.
  Simulated show(const std::string& scene_text, const RunOptions& options) const {
    return simulate(kMachine, written("scene.toml", scene_text), options);
  }

 private:
  std::string folder_;
};

inline const reference::ErrorFigures& error_of(const run::FrameFigures& frame, const std::string& reference) {
  for (const reference::ErrorFigures& error : frame.errors)
    if (error.reference == reference) return error;
  throw std::runtime_error("frame " + std::to_string(frame.frame) + " has no error against " + reference);
}

// The entry of a result's list that has the name.
template <class T>
const T& named(const std::vector<T>& list, const std::string& name) {
  for (const T& entry : list)
    if (entry.name == name) return entry;
  throw std::runtime_error("the result has no " + name);
}

// Every pixel that must is covered and no other, and shows the triangle that it must, but for `wrong_objects` pixels a
// frame; where it does, the shade is not farther off than `largest_level`.
inline void expect_exact(const Simulated& simulated, int largest_level, std::uint64_t wrong_objects = 0) {
  for (const run::FrameFigures& frame : simulated.result.frames) {
    const reference::ErrorFigures& error = error_of(frame, "snapped");
    EXPECT_EQ(error.covered_missing, 0U) << "frame " << frame.frame;
    EXPECT_EQ(error.covered_extra, 0U) << "frame " << frame.frame;
    EXPECT_LE(error.wrong_object, wrong_objects) << "frame " << frame.frame;
    EXPECT_EQ(error.wrong_order, 0U) << "frame " << frame.frame;
    EXPECT_LE(error.max_level_same_object, largest_level) << "frame " << frame.frame;
  }
}

inline bool same_picture(const frame::Frame& a, const frame::Frame& b) {
  return a.columns == b.columns && a.lines == b.lines && a.rgb == b.rgb && a.depth == b.depth && a.normal == b.normal &&
         a.object == b.object && a.material == b.material && a.coverage == b.coverage;
}

}  // namespace rastertlm::test
