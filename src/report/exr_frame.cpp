#include "src/report/exr_frame.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "src/image/image_files.h"

namespace rastertlm::report {
namespace {

using image::Channel;
using image::ChannelType;

constexpr double kLevels = 255.0;

void add_interleaved(std::vector<Channel>& channels, const std::vector<std::string>& names,
                     const std::vector<float>& values) {
  for (std::size_t i = 0; i < names.size(); ++i)
    channels.push_back({names[i], ChannelType::f32, values.data() + i, names.size() * sizeof(float)});
}

}  // namespace

void write_exr_frame(const std::string& path, const frame::Frame& shown, const frame::ExactFrame* ideal,
                     const LabelledPicture* labels) {
  const std::size_t values = shown.rgb.size();
  std::vector<float> colour(values);
  for (std::size_t i = 0; i < values; ++i) colour[i] = static_cast<float>(shown.rgb[i] / kLevels);
  const std::vector<float> depth(shown.depth.begin(), shown.depth.end());

  std::vector<Channel> channels;
  add_interleaved(channels, {"R", "G", "B"}, colour);
  channels.push_back({"Z", ChannelType::f32, depth.data(), 0});
  // A machine that interpolates colours has no normals at pixels.
  if (!shown.normal.empty()) add_interleaved(channels, {"N.X", "N.Y", "N.Z"}, shown.normal);
  channels.push_back({"object.id", ChannelType::u32, shown.object.data(), 0});
  channels.push_back({"material.id", ChannelType::u32, shown.material.data(), 0});
  channels.push_back({"coverage.count", ChannelType::u32, shown.coverage.data(), 0});

  std::vector<float> exact;
  std::vector<float> error;
  std::vector<std::uint32_t> region;
  if (ideal != nullptr) {
    exact.resize(values);
    error.resize(values);
    for (std::size_t i = 0; i < values; ++i) {
      exact[i] = static_cast<float>(ideal->rgb[i] / kLevels);
      error[i] = static_cast<float>((shown.rgb[i] - ideal->rgb[i]) / kLevels);
    }
    add_interleaved(channels, {"reference.R", "reference.G", "reference.B"}, exact);
    add_interleaved(channels, {"error.R", "error.G", "error.B"}, error);
    region.resize(ideal->region.size());
    std::transform(ideal->region.begin(), ideal->region.end(), region.begin(),
                   [](frame::Region one) { return static_cast<std::uint32_t>(one); });
    channels.push_back({kRegionChannel, ChannelType::u32, region.data(), 0});
  }
  if (labels != nullptr) channels.push_back({labels->channel, ChannelType::u32, labels->values.data(), 0});
  image::write_exr(path, shown.columns, shown.lines, channels);
}

}  // namespace rastertlm::report
