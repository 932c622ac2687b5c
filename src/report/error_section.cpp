#include "src/report/error_section.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/report/error_image.h"
#include "src/report/error_summaries.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

// Object machines shade each pixel by their own model; others are compared with light at every pixel.
const char* meaning(const std::string& reference, bool interpolates) {
  if (reference == "ideal")
    return interpolates ? "light at every pixel in double, vertices not snapped: the error of interpolation and "
                          "arithmetic together"
                        : "the machine's own model in double, vertices not snapped: the error of the arithmetic";
  if (reference == "snapped")
    return "the same given the snapped vertices: where edges are snapped, no pixel of a triangle may be missing or "
           "extra";
  if (reference == "true")
    return "perspective-correct normals, local viewer and lights: the error of the model as well";
  if (reference == "sphere")
    return "the spheres themselves, where meshes stand for them: the error of the meshes as well";
  return "";
}

std::string plain(double value) { return fmt::format("{:.4g}", value); }
std::string plain(const std::optional<double>& value) { return value ? plain(*value) : "-"; }
// Counts are whole in a frame, and not in the mean of many.
std::string count_text(std::uint64_t count) { return grouped(count); }
std::string count_text(const std::optional<double>& mean) { return mean ? fmt::format("{:.1f}", *mean) : "-"; }
std::string level_text(int level) { return fmt::format("{}", level); }
std::string level_text(const std::optional<double>& mean) { return plain(mean); }

// Without pixels there is no figure.
template <class Part>
void add_row(TextTable& table, bool as_seen, const std::string& reference, const char* where, const Part& e) {
  std::vector<std::string> row{reference,
                               where,
                               count_text(e.compared),
                               count_text(e.covered_missing),
                               count_text(e.covered_extra),
                               count_text(e.wrong_object),
                               count_text(e.wrong_order),
                               level_text(e.max_level),
                               plain(e.rmse_level),
                               plain(e.psnr_db),
                               plain(e.over_two_levels_percent),
                               plain(e.edge_jump_rms_level),
                               plain(e.flicker_rms_level)};
  if (as_seen)
    for (const auto& figure : {e.flip_mean, e.flip_p95, e.ciede2000_mean, e.ciede2000_p99})
      row.push_back(plain(figure));
  table.row(row);
}

template <class Errors>
void add_rows(TextTable& table, bool as_seen, const std::string& reference, const Errors& e) {
  add_row(table, as_seen, reference, "everywhere", e);
  add_row(table, as_seen, "", "inside", e.inside);
  add_row(table, as_seen, "", "silhouettes", e.silhouettes);
  add_row(table, as_seen, "", "highlights", e.highlights);
}

TextTable parts_table(bool as_seen) {
  std::vector<Column> columns{{"reference"},
                              {"where"},
                              {"compared", Align::right},
                              {"missing", Align::right},
                              {"extra", Align::right},
                              {"other", Align::right},
                              {"order", Align::right},
                              {"largest", Align::right},
                              {"RMSE", Align::right},
                              {"PSNR", Align::right},
                              {"over two", Align::right},
                              {"edges", Align::right},
                              {"flicker", Align::right}};
  if (as_seen)
    for (const char* name : {"FLIP", "95 %", "CIEDE2000", "99 %"}) columns.push_back({name, Align::right});
  return TextTable(columns, "  ");
}

// What each pixel is compared of.
const char* thing(const run::Result& result) { return result.modelled.solids_made > 0 ? "object" : "triangle"; }

// {}: what is compared.
constexpr const char* kMeanings =
    "  silhouettes: two pixels on either side of where the exact picture's surface ends; highlights: of the others, "
    "those to which it adds 32 levels of specular light; inside: the rest.\n"
    "  compared, missing, extra, other {}, and of these those whose depth belongs to nothing seen there (order), "
    "in pixels; largest and RMSE in levels, PSNR in dB; over two levels in % of the compared.\n"
    "  edges: RMS in levels by which the slope of the levels jumps otherwise than it should where two triangles of a "
    "surface meet (Mach bands); flicker: RMS change of the error from frame to frame where the exact levels stand "
    "still.\n";

// Reports of earlier programs do not know the parts.
bool has_parts(const std::vector<reference::ErrorSummary>& summaries) {
  return std::any_of(summaries.begin(), summaries.end(), [](const reference::ErrorSummary& s) {
    return s.worst.inside.compared + s.worst.silhouettes.compared + s.worst.highlights.compared > 0;
  });
}

std::string parts_section(const run::Result& result, const std::vector<reference::ErrorSummary>& summaries) {
  if (!has_parts(summaries)) return "";
  const bool as_seen = result.flip_pixels_per_degree.has_value();
  const bool many = result.frames.size() > 1;
  TextTable worst = parts_table(as_seen);
  TextTable mean = parts_table(as_seen);
  for (const reference::ErrorSummary& summary : summaries) {
    add_rows(worst, as_seen, summary.reference, summary.worst);
    add_rows(mean, as_seen, summary.reference, summary.mean);
  }
  std::string text = fmt::format("\n  Where they differ{}\n", many ? ", the worst of the frames" : "");
  text += worst.text();
  if (many) text += "\n  Where they differ, the mean of the frames\n" + mean.text();
  text += fmt::format(kMeanings, thing(result));
  if (as_seen)
    text += fmt::format(
        "  FLIP (0 .. 1, at {:.6g} pixels a degree) and CIEDE2000 (1: just seen), of all pixels there: mean, and what "
        "95 % and 99 % do not exceed. Levels are read as sRGB.\n",
        *result.flip_pixels_per_degree);
  return text;
}

}  // namespace

std::string decibels(const std::optional<double>& value, std::uint64_t pixels) {
  if (value) return fmt::format("{:.6g} dB", *value);
  return pixels == 0 ? "nothing to compare" : "infinite";
}

std::string error_section(const run::Result& result) {
  std::string title = "Distance from the exact picture";
  if (result.frames.size() > 1)
    title += fmt::format(" (the worst of {} frames, each figure by itself)", result.frames.size());
  std::string text = '\n' + title + '\n' + std::string(title.size(), '=') + '\n';
  const std::vector<reference::ErrorSummary> summaries = summaries_of(result);
  if (summaries.empty()) return text + "  Not measured (--no-reference).\n";
  TextTable table({{"reference"},
                   {"missing", Align::right},
                   {"extra", Align::right},
                   {fmt::format("other {}", thing(result)), Align::right},
                   {"largest", Align::right},
                   {fmt::format("same {}", thing(result)), Align::right},
                   {"RMSE", Align::right},
                   {"PSNR", Align::right},
                   {"with outlines", Align::right},
                   {"over one level", Align::right}},
                  "  ");
  for (const reference::ErrorSummary& summary : summaries) {
    const reference::ErrorFigures& e = summary.worst;
    table.row({summary.reference, grouped(e.covered_missing) + " px", grouped(e.covered_extra) + " px",
               grouped(e.wrong_object) + " px", fmt::format("{} levels", e.max_level),
               fmt::format("{} levels", e.max_level_same_object), fmt::format("{:.6g} levels", e.rmse_level),
               decibels(e.psnr_db, e.compared),
               decibels(e.psnr_outline_db, e.compared + e.covered_missing + e.covered_extra),
               fmt::format("{:.6g} %", e.over_one_level_percent)});
  }
  text += table.text();
  for (const reference::ErrorSummary& summary : summaries)
    text += fmt::format("  {}: {}\n", summary.reference, meaning(summary.reference, result.platform != "imogene"));
  text +=
      "  Levels are compared where both pictures are covered; \"with outlines\" is the PSNR where either is, missing "
      "and extra pixels included.\n";
  text += fmt::format(
      "  A level is 1/255 of a channel. error_*.png: absolute difference from the ideal picture, times {}.\n",
      kErrorAmplification);
  return text + parts_section(result, summaries);
}

}  // namespace rastertlm::report
