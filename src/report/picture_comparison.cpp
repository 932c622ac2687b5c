#include "src/report/picture_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "src/base/errors.h"
#include "src/image/image_files.h"
#include "src/report/error_image.h"
#include "src/report/exr_frame.h"
#include "src/report/text_file.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

constexpr double kLevels = 255.0;

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw InputError(Diagnostic{path, 0, "", message});
}

// A value that stands for a level, which is no binary fraction, is that level.
double level_of(float value) {
  const double level = kLevels * static_cast<double>(value);
  const double nearest = std::floor(level + 0.5);
  return static_cast<float>(nearest / kLevels) == value ? nearest : level;
}

// Into every third value from `levels` on.
void read_channel(const PictureFile& file, const image::ReadChannel& channel, double* levels) {
  switch (channel.type) {
    case image::ChannelType::u8:
      for (const std::uint8_t value : channel.u8) {
        *levels = value;
        levels += 3;
      }
      return;
    case image::ChannelType::f32:
      for (const float value : channel.f32) {
        if (!std::isfinite(value))
          refuse(file.path, fmt::format("channel {} holds a value that is no number", channel.name));
        *levels = level_of(value);
        levels += 3;
      }
      return;
    case image::ChannelType::u32:
      refuse(file.path, fmt::format("channel {} holds whole numbers of 32 bits, which are no levels", channel.name));
  }
}

std::string plain(double value) { return fmt::format("{:.6g}", value); }

struct NamedRegion {
  frame::Region region;
  const char* name;
};
constexpr NamedRegion kNamedRegions[] = {{frame::Region::inside, "inside"},
                                         {frame::Region::silhouettes, "silhouettes"},
                                         {frame::Region::highlights, "highlights"},
                                         {frame::Region::none, "background"}};

// What of the values, so many a pixel, is of pixels in that region.
std::vector<double> values_in(frame::Region region, const std::vector<frame::Region>& regions,
                              const std::vector<double>& values) {
  const std::size_t each = values.size() / regions.size();
  std::vector<double> there;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (regions[i / each] == region) there.push_back(values[i]);
  return there;
}

std::vector<PartComparison> parts_of(const std::vector<frame::Region>& regions, const LevelPicture& a,
                                     const LevelPicture& b, const reference::PerceptualFigures& seen) {
  std::vector<PartComparison> parts;
  if (3 * regions.size() != a.levels.size()) return parts;
  for (const NamedRegion& named : kNamedRegions) {
    const std::vector<double> first = values_in(named.region, regions, a.levels);
    if (first.empty()) continue;
    parts.push_back({named.region, first.size() / 3,
                     reference::compare_levels(first, values_in(named.region, regions, b.levels)),
                     reference::seen_figures(values_in(named.region, regions, seen.flip),
                                             values_in(named.region, regions, seen.ciede2000))});
  }
  return parts;
}

std::string parts_text(const std::vector<PartComparison>& parts) {
  if (parts.empty()) return "";
  std::vector<Column> columns{{"of which"}};
  for (const char* name :
       {"pixels", "largest", "over one, %", "over two, %", "RMSE", "PSNR", "FLIP", "95 %", "CIEDE2000", "99 %"})
    columns.push_back({name, Align::right});
  TextTable table(columns);
  for (const PartComparison& part : parts) {
    const auto* const named = std::find_if(std::begin(kNamedRegions), std::end(kNamedRegions),
                                           [&](const NamedRegion& one) { return one.region == part.region; });
    const reference::LevelFigures& level = part.by_level;
    table.row({named->name, fmt::format("{}", part.pixels), plain(level.max_level), plain(level.over_one_level_percent),
               plain(level.over_two_levels_percent), plain(level.rmse_level),
               level.psnr_db ? plain(*level.psnr_db) : "infinite", plain(part.as_seen.flip_mean),
               plain(part.as_seen.flip_p95), plain(part.as_seen.ciede2000_mean), plain(part.as_seen.ciede2000_p99)});
  }
  return '\n' + table.text();
}

}  // namespace

LevelPicture read_level_picture(const PictureFile& file) {
  const image::Image image = image::read_image(file.path);
  LevelPicture picture{image.columns, image.lines, std::vector<double>(3 * image.columns * image.lines)};
  const std::string prefix = file.layer.empty() ? "" : file.layer + '.';
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const image::ReadChannel* channel = image.find(prefix + names[c]);
    if (channel == nullptr && file.layer.empty() && image.find("R") == nullptr) channel = image.find("Y");
    if (channel == nullptr) {
      std::string known;
      for (const image::ReadChannel& there : image.channels) known += (known.empty() ? "" : ", ") + there.name;
      refuse(file.path, fmt::format("has no channel {}{}; it has {}", prefix, names[c], known));
    }
    read_channel(file, *channel, picture.levels.data() + c);
  }
  if (const image::ReadChannel* channel = image.find(kRegionChannel); channel != nullptr)
    for (const std::uint32_t region : channel->u32)
      picture.regions.push_back(region < frame::kRegions ? static_cast<frame::Region>(region) : frame::Region::none);
  return picture;
}

Comparison compare_pictures(const PictureFile& first, const PictureFile& second, double pixels_per_degree) {
  const LevelPicture a = read_level_picture(first);
  const LevelPicture b = read_level_picture(second);
  if (a.columns != b.columns || a.lines != b.lines)
    refuse(second.path, fmt::format("has {}x{} pixels and {} has {}x{}: pictures of one size are compared", b.columns,
                                    b.lines, first.path, a.columns, a.lines));
  Comparison comparison{a.columns,
                        a.lines,
                        reference::compare_levels(a.levels, b.levels),
                        reference::compare_as_seen(a.columns, a.lines, a.levels, b.levels, pixels_per_degree),
                        std::vector<double>(a.levels.size()),
                        {}};
  comparison.parts = parts_of(a.regions.empty() ? b.regions : a.regions, a, b, comparison.as_seen);
  std::transform(a.levels.begin(), a.levels.end(), b.levels.begin(), comparison.differences.begin(),
                 [](double x, double y) { return std::abs(x - y); });
  return comparison;
}

std::string comparison_text(const Comparison& comparison) {
  const reference::LevelFigures& level = comparison.by_level;
  const reference::PerceptualFigures& seen = comparison.as_seen;
  TextTable table({{"figure"}, {"value", Align::right}, {"unit"}});
  table.row({"largest difference", plain(level.max_level), "levels"});
  table.row({"over one level", plain(level.over_one_level_percent), "% of pixels"});
  table.row({"over two levels", plain(level.over_two_levels_percent), "% of pixels"});
  table.row({"RMSE", plain(level.rmse_level), "levels"});
  table.row({"PSNR", level.psnr_db ? plain(*level.psnr_db) : "infinite", "dB"});
  table.row({"FLIP, mean", plain(seen.flip_mean), "0 .. 1"});
  table.row({"FLIP, 95th percentile", plain(seen.flip_p95), "0 .. 1"});
  table.row({"CIEDE2000, mean", plain(seen.ciede2000_mean), "1: just seen"});
  table.row({"CIEDE2000, 99th percentile", plain(seen.ciede2000_p99), "1: just seen"});
  return fmt::format(
      "{}{}{}x{} pixels, every channel of each. A level is 1/255 of a channel. LDR-FLIP at {:.6g} pixels a degree; "
      "FLIP "
      "and CIEDE2000 read levels as sRGB, D65.\n{}",
      table.text(), parts_text(comparison.parts), comparison.columns, comparison.lines, seen.pixels_per_degree,
      comparison.parts.empty() ? "Which parts are silhouettes or highlights, neither picture says.\n" : "");
}

bool is_error_map_name(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".png" || extension == ".exr";
}

void write_error_map(const std::string& path, const Comparison& comparison) {
  make_folder_of(path);
  const std::vector<double>& differences = comparison.differences;
  if (std::filesystem::path(path).extension() == ".png") {
    std::vector<std::uint8_t> levels(differences.size());
    std::transform(differences.begin(), differences.end(), levels.begin(), [](double difference) {
      return static_cast<std::uint8_t>(std::min(std::floor(kErrorAmplification * difference + 0.5), kLevels));
    });
    image::write_png(path, comparison.columns, comparison.lines, levels);
    return;
  }
  std::vector<float> rgb(differences.size());
  std::transform(differences.begin(), differences.end(), rgb.begin(),
                 [](double difference) { return static_cast<float>(difference / kLevels); });
  const std::vector<float> flip(comparison.as_seen.flip.begin(), comparison.as_seen.flip.end());
  const std::vector<float> ciede2000(comparison.as_seen.ciede2000.begin(), comparison.as_seen.ciede2000.end());
  std::vector<image::Channel> channels;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c)
    channels.push_back({names[c], image::ChannelType::f32, rgb.data() + c, 3 * sizeof(float)});
  channels.push_back({"FLIP", image::ChannelType::f32, flip.data(), 0});
  channels.push_back({"CIEDE2000", image::ChannelType::f32, ciede2000.data(), 0});
  image::write_exr(path, comparison.columns, comparison.lines, channels);
}

}  // namespace rastertlm::report
