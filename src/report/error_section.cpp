#include "src/report/error_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/report/error_image.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

void take_worst(reference::ErrorFigures& worst, const reference::ErrorFigures& e) {
  worst.compared = std::max(worst.compared, e.compared);
  worst.covered_missing = std::max(worst.covered_missing, e.covered_missing);
  worst.covered_extra = std::max(worst.covered_extra, e.covered_extra);
  worst.wrong_object = std::max(worst.wrong_object, e.wrong_object);
  worst.max_level = std::max(worst.max_level, e.max_level);
  worst.max_level_same_object = std::max(worst.max_level_same_object, e.max_level_same_object);
  worst.rmse_level = std::max(worst.rmse_level, e.rmse_level);
  worst.rmse_unrounded_level = std::max(worst.rmse_unrounded_level, e.rmse_unrounded_level);
  if (e.psnr_db) worst.psnr_db = worst.psnr_db ? std::min(*worst.psnr_db, *e.psnr_db) : *e.psnr_db;
  if (e.psnr_outline_db)
    worst.psnr_outline_db =
        worst.psnr_outline_db ? std::min(*worst.psnr_outline_db, *e.psnr_outline_db) : *e.psnr_outline_db;
  worst.over_one_level_percent = std::max(worst.over_one_level_percent, e.over_one_level_percent);
}

// Object machines shade each pixel by their own model; others are compared with light at every pixel.
const char* meaning(const std::string& reference, bool interpolates) {
  if (reference == "ideal")
    return interpolates ? "light at every pixel in double, vertices not snapped: the error of interpolation and "
                          "arithmetic together"
                        : "the machine's own model in double, vertices not snapped: the error of the arithmetic";
  if (reference == "snapped")
    return "the same given the snapped vertices: where edges are snapped, no pixel of it may be missing or extra";
  if (reference == "true")
    return "perspective-correct normals, local viewer and lights: the error of the model as well";
  if (reference == "sphere") return "the spheres that the meshes stand for: the error of the meshes as well";
  return "";
}

}  // namespace

std::string decibels(const std::optional<double>& value, std::uint64_t pixels) {
  if (value) return fmt::format("{:.6g} dB", *value);
  return pixels == 0 ? "nothing to compare" : "infinite";
}

std::vector<std::string> references_of(const run::Result& result) {
  std::vector<std::string> names;
  for (const run::FrameFigures& frame : result.frames)
    for (const reference::ErrorFigures& e : frame.errors)
      if (std::find(names.begin(), names.end(), e.reference) == names.end()) names.push_back(e.reference);
  return names;
}

std::optional<reference::ErrorFigures> worst_of(const run::Result& result, const std::string& reference) {
  std::optional<reference::ErrorFigures> worst;
  for (const run::FrameFigures& frame : result.frames)
    for (const reference::ErrorFigures& e : frame.errors) {
      if (e.reference != reference) continue;
      if (worst)
        take_worst(*worst, e);
      else
        worst = e;
    }
  return worst;
}

std::string error_section(const run::Result& result) {
  std::string title = "Distance from the exact picture";
  if (result.frames.size() > 1)
    title += fmt::format(" (the worst of {} frames, each figure by itself)", result.frames.size());
  std::string text = '\n' + title + '\n' + std::string(title.size(), '=') + '\n';
  const std::vector<std::string> references = references_of(result);
  if (references.empty()) return text + "  Not measured (--no-reference).\n";
  TextTable table({{"reference"},
                   {"missing", Align::right},
                   {"extra", Align::right},
                   {"other triangle", Align::right},
                   {"largest", Align::right},
                   {"same triangle", Align::right},
                   {"RMSE", Align::right},
                   {"PSNR", Align::right},
                   {"with outlines", Align::right},
                   {"over one level", Align::right}},
                  "  ");
  for (const std::string& name : references) {
    const reference::ErrorFigures e = *worst_of(result, name);
    table.row({name, grouped(e.covered_missing) + " px", grouped(e.covered_extra) + " px",
               grouped(e.wrong_object) + " px", fmt::format("{} levels", e.max_level),
               fmt::format("{} levels", e.max_level_same_object), fmt::format("{:.6g} levels", e.rmse_level),
               decibels(e.psnr_db, e.compared),
               decibels(e.psnr_outline_db, e.compared + e.covered_missing + e.covered_extra),
               fmt::format("{:.6g} %", e.over_one_level_percent)});
  }
  text += table.text();
  for (const std::string& name : references)
    text += fmt::format("  {}: {}\n", name, meaning(name, result.platform != "imogene"));
  text +=
      "  Levels are compared where both pictures are covered; \"with outlines\" is the PSNR where either is, missing "
      "and extra pixels included.\n";
  text += fmt::format(
      "  A level is 1/255 of a channel. error_*.png: absolute difference from the ideal picture, times {}.\n",
      kErrorAmplification);
  return text;
}

}  // namespace rastertlm::report
