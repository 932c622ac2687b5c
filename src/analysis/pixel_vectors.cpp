#include "src/analysis/pixel_vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace rastertlm::analysis {
namespace {

bool shows_object(const frame::FragmentLine& line, std::size_t column) {
  return column >= line.begin && column < line.end && line.object[column] != 0;
}

}  // namespace

void write_decision(const std::vector<frame::FragmentLine>& lines, std::uint32_t background_depth, VectorFiles& files) {
  files.stream("decision.csv", [&](report::TextFileWriter& file) {
    file.append("line,column,object,depth,normal_x,normal_y,normal_z,material\n");
    std::string rows;
    for (std::size_t y = 0; y < lines.size(); ++y) {
      const frame::FragmentLine& line = lines[y];
      rows.clear();
      for (std::size_t x = 0; x < line.columns(); ++x)
        if (shows_object(line, x))
          fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{}\n", y, x, line.object[x], line.depth[x],
                         line.normal_x[x], line.normal_y[x], line.normal_z[x], line.material[x]);
        else
          fmt::format_to(std::back_inserter(rows), "{},{},0,{},0,0,0,0\n", y, x, background_depth);
      file.append(rows);
    }
  });
}

void write_rgb(const frame::Frame& frame, std::size_t field, std::size_t fields, VectorFiles& files) {
  files.stream("rgb.csv", [&](report::TextFileWriter& file) {
    file.append("line,column,r,g,b\n");
    std::string rows;
    for (std::size_t y = field; y < frame.lines; y += fields) {
      rows.clear();
      for (std::size_t x = 0; x < frame.columns; ++x) {
        const std::uint8_t* levels = &frame.rgb[3 * (y * frame.columns + x)];
        fmt::format_to(std::back_inserter(rows), "{},{},{},{},{}\n", y, x, levels[0], levels[1], levels[2]);
      }
      file.append(rows);
    }
  });
}

bool tables_shade(const shading::DeferredShader& shader, const std::vector<frame::FragmentLine>& lines,
                  const frame::Frame& frame) {
  shading::ShadingCounters ignored;
  for (std::size_t y = 0; y < lines.size(); ++y)
    for (std::size_t x = 0; x < lines[y].columns(); ++x) {
      const frame::FragmentLine& line = lines[y];
      const shading::Levels levels =
          shows_object(line, x)
              ? shader.shade_pixel(line.normal_x[x], line.normal_y[x], line.normal_z[x], line.material[x], ignored)
              : shader.front().background;
      if (!std::equal(levels.begin(), levels.end(), &frame.rgb[3 * (y * frame.columns + x)])) return false;
    }
  return true;
}

}  // namespace rastertlm::analysis
