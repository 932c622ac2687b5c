#include "src/report/frames_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "src/report/error_summaries.h"
#include "src/report/schema_errors.h"

namespace rastertlm::report {
namespace {

constexpr const char* kFrameColumns =
    "frame,animation_frame,last_animation_frame,first_pixel_ps,last_pixel_ps,"
    "drawn_triangles,facing_triangles,back_face_triangles,degenerate_triangles,outside_triangles,"
    "piece_processors,dropped_pieces,snap_fraction_bits,covered_pixels,fragment_pixels,"
    "host_flop,sent_words,words_ahead,light_apart,late_table_lines,line_slack_cycles,retrace_slack_cycles,host_slack_"
    "us";
constexpr const char* kErrorColumns[] = {"compared_pixels",
                                         "missing_pixels",
                                         "extra_pixels",
                                         "wrong_object_pixels",
                                         "max_level",
                                         "max_level_same_object",
                                         "rmse_level",
                                         "rmse_unrounded_level",
                                         "psnr_db",
                                         "psnr_outline_db",
                                         "over_one_level_percent"};

// Names and texts of figures, as report.json has them; units in the names.
class FigureTexts {
 public:
  explicit FigureTexts(bool only_later, std::string prefix = {})
      : only_later_(only_later), prefix_(std::move(prefix)) {}
  template <class Whole>
  void value(const char* key, const Field& field, const Whole& number) {
    add(key, field, fmt::format("{}", number));
  }
  void metric(const char* key, const Field& field, const std::optional<double>& number) {
    add(key, field, number ? fmt::format("{:.6g}", *number) : "");
  }
  const std::string& names() const { return names_; }
  const std::string& texts() const { return texts_; }

 private:
  void add(const std::string& key, const Field& field, const std::string& text) {
    if (only_later_ && !field.later) return;
    constexpr std::string_view kCovered = "covered_";
    std::string name = key.starts_with(kCovered) ? key.substr(kCovered.size()) : key;
    if (std::string_view(field.unit) == "pixels" && !name.ends_with("_pixels")) name += "_pixels";
    names_ += ',' + prefix_ + name;
    texts_ += ',' + text;
  }
  bool only_later_;
  std::string prefix_;
  std::string names_;
  std::string texts_;
};

struct Columns {
  std::string names;
  std::string texts;
};

// Of the whole picture what the columns above have not, and everything of its parts.
Columns further_columns(const std::string& reference, reference::ErrorFigures errors) {
  FigureTexts whole(true, reference + '_');
  schema::visit_part(whole, errors);
  Columns columns{whole.names(), whole.texts()};
  const auto add = [&](const char* name, reference::RegionFigures& part) {
    FigureTexts texts(false, fmt::format("{}_{}_", reference, name));
    schema::visit_part(texts, part);
    columns.names += texts.names();
    columns.texts += texts.texts();
  };
  add("inside", errors.inside);
  add("silhouettes", errors.silhouettes);
  add("highlights", errors.highlights);
  return columns;
}

std::string error_fields(const reference::ErrorFigures* e) {
  if (e == nullptr) {
    const std::string names = further_columns("", {}).names;
    return std::string(std::size(kErrorColumns) + static_cast<std::size_t>(std::count(names.begin(), names.end(), ',')),
                       ',');
  }
  return fmt::format(",{},{},{},{},{},{},{:.6g},{:.6g},{},{},{:.6g}", e->compared, e->covered_missing, e->covered_extra,
                     e->wrong_object, e->max_level, e->max_level_same_object, e->rmse_level, e->rmse_unrounded_level,
                     e->psnr_db ? fmt::format("{:.6g}", *e->psnr_db) : "",
                     e->psnr_outline_db ? fmt::format("{:.6g}", *e->psnr_outline_db) : "", e->over_one_level_percent) +
         further_columns("", *e).texts;
}

}  // namespace

std::string frames_csv(const run::Result& result) {
  const std::vector<std::string> references = references_of(result);
  std::string text = kFrameColumns;
  for (const std::string& name : references) {
    for (const char* column : kErrorColumns) text += fmt::format(",{}_{}", name, column);
    text += further_columns(name, {}).names;
  }
  text += '\n';
  for (const run::FrameFigures& f : result.frames) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", f.frame,
                        f.animation_frame, f.last_animation_frame, f.first_pixel_ps, f.last_pixel_ps, f.drawn, f.facing,
                        f.back_faces, f.degenerate, f.outside, f.pieces, f.pieces_dropped, f.snap_fraction_bits,
                        f.covered_pixels, f.fragments, f.host_flops, f.words_sent, f.words_ahead, f.light_apart ? 1 : 0,
                        f.late_table_lines, f.line_slack_cycles, f.retrace_slack_cycles,
                        f.host_slack_us ? fmt::format("{:.6g}", *f.host_slack_us) : "");
    for (const std::string& name : references) {
      const auto found = std::find_if(f.errors.begin(), f.errors.end(),
                                      [&](const reference::ErrorFigures& e) { return e.reference == name; });
      text += error_fields(found == f.errors.end() ? nullptr : &*found);
    }
    text += '\n';
  }
  return text;
}

}  // namespace rastertlm::report
