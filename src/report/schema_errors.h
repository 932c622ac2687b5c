// Of report.json: how far pictures are from exact ones.
#pragma once

#include <type_traits>

#include "src/reference/error_summary.h"
#include "src/report/schema_field.h"

namespace rastertlm::report::schema {

// Counts and whole levels as they are, what is computed and what is a mean with six digits.
template <class Visitor, class Figure>
void visit_figure(Visitor& v, const char* key, const Field& field, Figure& figure) {
  if constexpr (std::is_integral_v<Figure>)
    v.value(key, field, figure);
  else
    v.metric(key, field, figure);
}

template <class Visitor, class Part>
void visit_levels(Visitor& v, Part& e) {
  visit_figure(v, "compared", {"pixels", kCount, "covered in both pictures"}, e.compared);
  visit_figure(v, "covered_missing", {"pixels", kCount, "covered in the exact picture only"}, e.covered_missing);
  visit_figure(v, "covered_extra", {"pixels", kCount, "covered in the machine's picture only"}, e.covered_extra);
  visit_figure(v, "wrong_object", {"pixels", kCount, "compared pixels that show different triangles"}, e.wrong_object);
  visit_figure(v, "max_level", {"levels", kFormula, "largest difference of a channel of the compared pixels"},
               e.max_level);
  visit_figure(v, "max_level_same_object", {"levels", kFormula, "the same, of pixels that show the same triangle"},
               e.max_level_same_object);
  visit_figure(v, "rmse_level",
               {"levels", kFormula, "root of the mean square difference of the compared pixels' channels"},
               e.rmse_level);
  visit_figure(v, "rmse_unrounded_level",
               {"levels", kFormula, "the same with the exact level not rounded: holds the display's own rounding"},
               e.rmse_unrounded_level);
  visit_figure(v, "psnr_db",
               {"dB", kFormula, "20 log10(255 / rmse_level); null where that is infinite, or nothing is compared"},
               e.psnr_db);
  visit_figure(v, "psnr_outline_db",
               {"dB", kFormula, "PSNR over the pixels that either picture covers, missing and extra ones included"},
               e.psnr_outline_db);
  visit_figure(v, "over_one_level_percent",
               {"%", kFormula, "compared pixels with a channel that differs by more than one level"},
               e.over_one_level_percent);
}

// What reports had not from the start.
template <class Visitor, class Part>
void visit_later_figures(Visitor& v, Part& e) {
  visit_figure(v, "over_two_levels_percent", {"%", kFormula, "the same, by more than two levels", kLater},
               e.over_two_levels_percent);
  visit_figure(v, "wrong_order",
               {"pixels", kCount,
                "of wrong_object: farther from all that the exact picture shows around them than the depth words' "
                "bound allows",
                kLater},
               e.wrong_order);
  visit_figure(v, "edges_measured",
               {"edges", kCount, "between two triangles of one surface, a pixel's width of each", kLater},
               e.edges_measured);
  visit_figure(v, "edge_jump_rms_level",
               {"levels", kFormula,
                "root mean square of the displayed minus the exact jump of the slope across those edges (Mach bands); "
                "null: no edge",
                kLater},
               e.edge_jump_rms_level);
  visit_figure(v, "edge_jump_max_level", {"levels", kFormula, "the largest such difference", kLater},
               e.edge_jump_max_level);
  visit_figure(
      v, "still_pixels",
      {"pixels", kCount, "compared in the frame before too, where no exact level moved by more than one", kLater},
      e.still_pixels);
  visit_figure(v, "flicker_rms_level",
               {"levels", kFormula, "root mean square change of the error of their channels; null: no pixel", kLater},
               e.flicker_rms_level);
  visit_figure(v, "flicker_max_level", {"levels", kFormula, "the largest such change", kLater}, e.flicker_max_level);
  visit_figure(v, "flip_mean", {"", kFormula, "LDR-FLIP of all pixels, 0 .. 1; null without --perceptual", kLater},
               e.flip_mean);
  visit_figure(v, "flip_p95", {"", kFormula, "that 95 % of the pixels do not exceed", kLater}, e.flip_p95);
  visit_figure(v, "ciede2000_mean",
               {"", kFormula, "CIEDE2000 of all pixels, 1: just seen; null without --perceptual", kLater},
               e.ciede2000_mean);
  visit_figure(v, "ciede2000_p99", {"", kFormula, "that 99 % of the pixels do not exceed", kLater}, e.ciede2000_p99);
}

template <class Visitor, class Part>
void visit_part(Visitor& v, Part& part) {
  visit_levels(v, part);
  visit_later_figures(v, part);
}

template <class Visitor, class Errors>
void visit_parts(Visitor& v, Errors& e) {
  visit_part(v, e);
  v.later_object("inside", "of pixels that are neither beside a silhouette nor in a highlight",
                 [&](Visitor& o) { visit_part(o, e.inside); });
  v.later_object("silhouettes", "of two pixels on either side of edges where a surface ends, in the exact picture",
                 [&](Visitor& o) { visit_part(o, e.silhouettes); });
  v.later_object("highlights", "of others to which specular light adds 32 levels and more in the exact picture",
                 [&](Visitor& o) { visit_part(o, e.highlights); });
}

inline constexpr Field kReference{
    "", kSetting,
    "ideal: the machine's own model in double, light at every pixel where it interpolates; snapped: the same given the "
    "snapped vertices; true: perspective-correct normals, local viewer and lights"};

template <class Visitor>
void visit(Visitor& v, reference::ErrorFigures& e) {
  v.value("reference", kReference, e.reference);
  visit_parts(v, e);
}

template <class Visitor>
void visit(Visitor& v, reference::ErrorSummary& s) {
  v.value("reference", kReference, s.reference);
  v.value("frames", {"frames", kCount, "that were compared with it"}, s.frames);
  v.object("worst", "each figure by itself: the largest, of PSNR the least",
           [&](Visitor& o) { visit_parts(o, s.worst); });
  v.object("mean", "each figure over the frames that have it; PSNR of the mean of the mean squares",
           [&](Visitor& o) { visit_parts(o, s.mean); });
}

}  // namespace rastertlm::report::schema
