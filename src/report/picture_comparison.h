// Two picture files beside each other, whoever made them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/frame/frame.h"
#include "src/reference/picture_metrics.h"

namespace rastertlm::report {

// `layer` of an EXR: its channels LAYER.R, LAYER.G and LAYER.B; empty: R, G and B, or Y alone of a grey picture.
struct PictureFile {
  std::string path;
  std::string layer;
};

// Display levels, 3 a pixel: of 8 bits as they are, of others 255 times the value, not rounded but where the value is
// the float nearest to a level. EXR may hold levels outside 0..255.
struct LevelPicture {
  std::size_t columns = 0;
  std::size_t lines = 0;
  std::vector<double> levels;
  std::vector<frame::Region> regions = {};  // of each pixel; empty where the file does not say
};

// Other channels are not looked at. Throws InputError where there are no such channels, where they hold what is no
// level, or where the file cannot be read.
LevelPicture read_level_picture(const PictureFile& file);

// Of the pixels of one region.
struct PartComparison {
  frame::Region region = frame::Region::none;
  std::size_t pixels = 0;
  reference::LevelFigures by_level;
  reference::SeenFigures as_seen;
};

struct Comparison {
  std::size_t columns = 0;
  std::size_t lines = 0;
  reference::LevelFigures by_level;
  reference::PerceptualFigures as_seen;
  std::vector<double> differences;    // |difference| in levels, 3 a pixel
  std::vector<PartComparison> parts;  // where a picture says which regions its exact picture has (frame_*.exr)
};

// Throws InputError as above, and where the sizes differ.
Comparison compare_pictures(const PictureFile& first, const PictureFile& second, double pixels_per_degree);

// Every figure with its unit, for a reader.
std::string comparison_text(const Comparison& comparison);

// Whether a map can be written by that name: a PNG or an EXR.
bool is_error_map_name(const std::string& path);

// A PNG, min(255, kErrorAmplification |difference|) of each channel as in error_*.png, or an EXR: R, G, B, |difference|
// / 255, and FLIP and CIEDE2000. Makes the folders above it. Throws OutputError.
void write_error_map(const std::string& path, const Comparison& comparison);

}  // namespace rastertlm::report
