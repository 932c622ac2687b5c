// Of report.json: a displayed frame.
#pragma once

#include <algorithm>
#include <string>

#include "src/report/file_names.h"
#include "src/report/schema_errors.h"
#include "src/report/schema_field.h"
#include "src/run/result.h"

namespace rastertlm::report::schema {

// The figures against one of the references, or null.
inline reference::ErrorFigures* find_error(run::FrameFigures& frame, const std::string& reference) {
  const auto found = std::find_if(frame.errors.begin(), frame.errors.end(),
                                  [&](const reference::ErrorFigures& e) { return e.reference == reference; });
  return found == frame.errors.end() ? nullptr : &*found;
}

template <class Visitor>
void visit_span(Visitor& v, run::SpanFrameFigures& s) {
  v.value("drawn_pieces", {"triangles", kCount, "handed to the span unit, children of split ones counted one by one"},
          s.drawn_pieces);
  v.value("splits", {"triangles", kCount, "that the highlight test replaced by four"}, s.splits);
  v.value("at_depth_limit", {"triangles", kCount, "not split any more, although the highlight test says so"},
          s.at_depth_limit);
  v.value("flat", {"triangles", kCount, "drawn in one colour: too low, or the solver had no answer"}, s.flat);
  v.value("lighting_evaluations", {"evaluations", kCount, "of the lighting equation, at points of triangles"},
          s.lighting_evaluations);
  v.value("shaded_pixels", {"pixels", kCount, "lit one by one by the pixel unit: as many evaluations more"},
          s.shaded_pixels);
  v.value("shading_flops", {"flop", kCount, "of the pixel unit for them: its lines and pixels"}, s.shading_flops);
  v.value("step_edges", {"edges", kCount, "that one triangle has whole and its neighbours in parts, or in other parts"},
          s.step_edges);
  v.value("largest_step_levels", {"levels", kFormula, "of colour along such an edge, in any channel"},
          s.largest_step_levels);
  v.value("clamped_knots", {"values", kCount, "channels of points beyond the levels"}, s.clamped_knots);
  v.value("not_finite", {"values", kCount, "channels of points that were no numbers: black"}, s.not_finite);
  v.value("span_pixels", {"pixels", kCount, "that the span unit drew on the screen"}, s.span_pixels);
  v.value("off_screen_pixels", {"pixels", kCount, "that it stepped over"}, s.off_screen_pixels);
  v.value("set_up_us", {"us", kFormula, "from the frame's start to its last word, waits included"}, s.set_up_us);
  v.value("shown_us", {"us", kFormula, "from the frame's start to when it is shown"}, s.shown_us);
  v.value("torn_lines", {"lines", kCount, "of its screen, that do not show it as it was when it was whole"},
          s.torn_lines);
}

template <class Visitor>
void visit_highlight(Visitor& v, run::HighlightFigures& h) {
  v.value("highlight_tested", {"triangles", kCount, "that were looked at for highlights"}, h.tested);
  v.value("potentially_highlighted", {"triangles", kCount, "of them, that may hold a highlight's centre (PHT)"},
          h.potentially);
  v.value("highlight_neighbours", {"triangles", kCount, "treated alike because they lie beside one"}, h.neighbours);
  v.value("divided", {"triangles", kCount, "cut up, of both"}, h.divided);
  v.value("parts", {"triangles", kCount, "into which they were cut"}, h.parts);
  v.value("highlight_centres", {"centres", kCount, "found inside a triangle, a light"}, h.centres);
  v.value("highlights_beside", {"centres", kCount, "found outside: a corner is put on the nearest edge"}, h.beside);
  v.value("highlights_unfound", {"triangles", kCount, "where the search had no answer"}, h.unfound);
  v.value("parts_at_limit",
          {"triangles", kCount, "not cut further, although larger or further off than the threshold, or not looked at"},
          h.at_limit);
  v.value("parts_at_grid_limit",
          {"triangles", kCount, "of them, those that the grid of corners is not fine enough for"}, h.at_grid_limit);
  v.value("stitched", {"triangles", kCount, "that got corners from those beside them; not among the parts"},
          h.stitched);
  v.value("stitch_corners", {"corners", kCount, "that they got: as many more are drawn"}, h.stitch_corners);
  v.value("true_highlight_centres",
          {"centres", kCount, "found by a search of every triangle, a light; needs references"}, h.true_centres);
  v.metric("highlight_recall",
           {"", kFormula, "share of true centres in triangles that may hold one; null: there is none"}, h.recall);
  v.metric("highlight_precision", {"", kFormula, "share of triangles that may hold a centre, that do"}, h.precision);
}

template <class Visitor>
void visit_board(Visitor& v, run::FrameFigures& f) {
  v.value("words_ahead",
          {"words", kCount, "in use that belong to an update which the computation units have not finished"},
          f.words_ahead);
  v.value("light_apart", {"", kCount, "whether objects of one animation frame are shown in the light of another"},
          f.light_apart);
  v.value("late_table_lines", {"lines", kCount, "shaded from half-written tables"}, f.late_table_lines);
  v.value("line_slack_cycles", {"pixel clocks", kFormula, "left at its worst line"}, f.line_slack_cycles);
  v.value("retrace_slack_cycles", {"pixel clocks", kFormula, "left of its vertical retrace"}, f.retrace_slack_cycles);
  v.metric("host_slack_us", {"us", kFormula, "from the last host's last word to its retrace; null: nothing new"},
           f.host_slack_us);
  v.later_object("solids", "of the scene, a quadric processor each", [&](Visitor& o) {
    o.value("drawn", {"solids", kCount, "that were loaded"}, f.solids_drawn);
    o.value("outside", {"solids", kCount, "of which nothing can be in the view volume"}, f.solids_outside);
    o.value("refused", {"solids", kCount, "left out, because the machine's words cannot show them"}, f.solids_refused);
  });
}

template <class Visitor>
void visit(Visitor& v, run::FrameFigures& f, const Kinds& kinds) {
  v.value("frame", {"", kCount, "the displayed frame, from 0"}, f.frame);
  v.derived("file", {"", kFormula, "what the display shows"}, picture_name(f.frame));
  v.derived("channels_file", {"", kFormula, "everything that is known of each pixel"}, channels_name(f.frame));
  v.derived("error_file", {"", kFormula, "absolute error against the ideal picture, amplified; empty: not measured"},
            find_error(f, "ideal") != nullptr ? error_name(f.frame) : std::string());
  v.value("animation_frame", {"", kFormula, "the pose that it shows; of interlaced video, on its even lines"},
          f.animation_frame);
  v.value("last_animation_frame", {"", kFormula, "the pose that it shows on its last line: of its second field"},
          f.last_animation_frame);
  v.value("first_pixel_ps", {"ps", kCount, "first pixel, since the first displayed frame's retrace began"},
          f.first_pixel_ps);
  v.value("last_pixel_ps", {"ps", kCount, "last pixel, since the same"}, f.last_pixel_ps);
  v.value("drawn", {"triangles", kCount, "that have an area: facing, back faces and outside"}, f.drawn);
  v.value("facing", {"triangles", kCount, "of those drawn, that face the viewer (or are two-sided) and are in view"},
          f.facing);
  v.value("back_faces", {"triangles", kCount, "that face away"}, f.back_faces);
  v.value("degenerate", {"triangles", kCount, "of zero area, as made or after snapping"}, f.degenerate);
  v.value("outside", {"triangles", kCount, "wholly outside the view volume"}, f.outside);
  v.value("pieces", {"processors", kCount, "more of them taken by what clipping made"}, f.pieces);
  v.value("pieces_dropped", {"pieces", kCount, "that found no processor"}, f.pieces_dropped);
  v.value("snap_fraction_bits", {"bits", kFormula, "of a snapped vertex' coordinates"}, f.snap_fraction_bits);
  v.value("covered_pixels", {"pixels", kCount, "that show an object"}, f.covered_pixels);
  v.value("fragments", {"pixels", kCount, "of all objects, hidden ones included"}, f.fragments);
  v.value("host_flops", {"flop", kCount, "of all computation units; 0 where nothing was computed for this frame"},
          f.host_flops);
  v.value("words_sent", {"words", kCount, "written to the object boards for this frame"}, f.words_sent);
  v.derived("torn", {"", kFormula, "words_ahead > 0, light_apart or torn_lines > 0"}, f.torn());
  if (kinds.boards) visit_board(v, f);
  if (kinds.spans) visit_span(v, f.span);
  if (kinds.highlights) visit_highlight(v, f.highlight);
  v.derived_object("error", "the figures of errors[] against the reference \"ideal\"", find_error(f, "ideal"),
                   [](Visitor& e, reference::ErrorFigures& figures) { visit(e, figures); });
  v.list("errors", "distance from each exact picture", f.errors,
         [](Visitor& e, reference::ErrorFigures& figures) { visit(e, figures); });
}

}  // namespace rastertlm::report::schema
