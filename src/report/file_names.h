// The names of what a run writes into its directory.
#pragma once

#include <cstdint>
#include <string>

namespace rastertlm::report {

inline constexpr const char* kReportJson = "report.json";
inline constexpr const char* kReportText = "report.txt";
inline constexpr const char* kTimeline = "timeline.json";
inline constexpr const char* kReportPage = "report.html";
inline constexpr const char* kFramesCsv = "frames.csv";
inline constexpr const char* kVectorsManifest = "manifest.json";
inline constexpr const char* kVectorsPage = "README.md";
inline constexpr const char* kResolvedMachine = "config.resolved.toml";
inline constexpr const char* kResolvedScene = "scene.resolved.toml";

std::string picture_name(std::uint64_t frame);   // frame_0000.png
std::string channels_name(std::uint64_t frame);  // frame_0000.exr
std::string error_name(std::uint64_t frame);     // error_0000.png
std::string blame_name(std::uint64_t frame);     // blame_0000.png

}  // namespace rastertlm::report
