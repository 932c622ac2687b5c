// What report.json, schema 1, holds: every key with its unit and its meaning, in order. Written once, for who writes
// the file, who reads it back and who describes it. A Visitor has
//   value(key, field, reference)      text, truth or number
//   metric(key, field, reference)     a real that is given to six significant digits
//   derived(key, field, value)        a value that follows from others: written, not read
//   texts(key, field, strings)        a list of sentences
//   integers(key, field, integers)    a list of integers
//   object(key, description, function(Visitor&))
//   list(key, description, vector, function(Visitor&, element))
//   derived_object(key, description, pointer, function(Visitor&, *pointer))   null where there is none
#pragma once

#include <algorithm>
#include <string>

#include "src/report/blame_schema.h"
#include "src/report/file_names.h"
#include "src/run/result.h"

namespace rastertlm::report {

inline constexpr std::int64_t kSchema = 1;

// What report.json holds.
struct Contents {
  run::Result result;
  bool host_figures = false;  // the section "host" is there
  BlameContents blame = {};
};

namespace schema {

// Of which kinds of machine a section speaks: of both where only described.
struct Kinds {
  bool boards = true;      // object processors
  bool spans = true;       // a span unit
  bool highlights = true;  // looked for before drawing
  explicit Kinds(const std::string& platform)
      : boards(platform.empty() || platform == "imogene"),
        spans(platform != "imogene"),
        highlights(platform.empty() || platform == "adaptive") {}
};

template <class Visitor>
void visit_initial_load(Visitor& v, run::Answer& a) {
  v.value("initial_load_frames", {"frames", kFormula, "video frames before the first picture"}, a.initial_load_frames);
  v.value("initial_load_us", {"us", kCount, "until the last computation unit has finished the first frame"},
          a.initial_load_us);
  v.value("initial_load_bytes",
          {"bytes", kCount, "of meshes that cross the links once, each to the unit that keeps it"},
          a.initial_load_bytes);
}

template <class Visitor>
void visit(Visitor& v, run::Answer& a, const Kinds& kinds) {
  v.value("frame_rate_hz", {"Hz", kFormula, "new pictures a second: the update rate, for the object machine"},
          a.frame_rate_hz);
  v.value("display_rate_hz", {"Hz", kFormula, "frames scanned out a second: pixel clock / clocks of a frame"},
          a.display_rate_hz);
  v.value("update_rate_hz",
          {"Hz", kFormula, "display rate / largest over the units of ceil(time a unit needs / time of a frame)"},
          a.update_rate_hz);
  v.value("required_rate_hz", {"Hz", kSetting, "video.refresh_hz"}, a.required_rate_hz);
  v.value("sustained", {"", kFormula, "whether every displayed frame shows a new picture, at the required rate"},
          a.sustained);
  v.value("headroom", {"fraction", kFormula, "rate that the bottleneck allows / required rate - 1; null: no limit"},
          a.headroom);
  v.object("bottleneck", "what limits the rate", [&](Visitor& b) {
    b.value("unit", {"", kFormula, "the unit that needs most of a frame"}, a.bottleneck.unit);
    b.value("resource", {"", kFormula, "what of it"}, a.bottleneck.resource);
    b.value("utilisation", {"fraction", kFormula, "time that it needs / time that it may take in a frame"},
            a.bottleneck.utilisation);
  });
  v.value("latency_frames",
          {"frames", kFormula, "from the start of an animation frame to the first line of its picture"},
          a.latency_frames);
  v.value("latency_first_pixel_us",
          {"us", kFormula, "latency_frames frames, and on to the first pixel: retrace, blanking, stages of the pixel"},
          a.latency_first_pixel_us);
  v.value("latency_last_pixel_us", {"us", kFormula, "the same to the last pixel"}, a.latency_last_pixel_us);
  if (kinds.boards) visit_initial_load(v, a);
  v.value("torn_frames",
          {"frames", kCount,
           "displayed frames with words or light of two animation frames, or lines of what was not whole"},
          a.torn_frames);
  v.value("display_works", {"", kFormula, "whether every unit behind the host keeps its deadlines"}, a.display_works);
  v.texts("limits", {"", kFormula, "one sentence for everything that keeps the machine from its rate"}, a.limits);
}

template <class Visitor>
void visit(Visitor& v, run::UnitFigures& u) {
  v.value("name", {"", kSetting, "the unit"}, u.name);
  v.value("clock", {"", kSetting, "the unit's clock, in whose cycles the others are"}, u.clock);
  v.value("clock_hz", {"Hz", kSetting, "of that clock"}, u.clock_hz);
  v.value("cycles", {"cycles", kCount, "of the whole run: busy + starved + blocked + idle"}, u.cycles);
  v.value("busy", {"cycles", kCount, "in which it worked"}, u.busy);
  v.value("starved", {"cycles", kCount, "in which it waited for its input"}, u.starved);
  v.value("blocked", {"cycles", kCount, "in which it waited for who takes its output"}, u.blocked);
  v.value("idle", {"cycles", kCount, "in which nothing was asked of it"}, u.idle);
}

template <class Visitor>
void visit(Visitor& v, run::Budget& b) {
  v.value("name", {"", kSetting, "the budget"}, b.name);
  v.value("used", {"as unit says", kFormula, "what is needed"}, b.used);
  v.value("available", {"as unit says", kFormula, "what there is"}, b.available);
  v.value("unit", {"", kSetting, "cycles, us, flop, bytes, words, processors or ns"}, b.unit);
  v.value("fits", {"", kFormula, "used <= available"}, b.fits);
  v.value("applies", {"", kSetting, "whether this machine depends on it; false: stated for comparison"}, b.applies);
  v.value("source", {"", kSetting, "the formula or the paper"}, b.source);
  v.value("moved_by", {"", kSetting, "the parameters that change it"}, b.moved_by);
}

template <class Visitor>
void visit(Visitor& v, run::Deadlines& d) {
  v.object("retrace", "the vertical retrace that is left the least", [&](Visitor& o) {
    o.value("available_cycles", {"pixel clocks", kFormula, "of the vertical retrace"}, d.retrace.available_cycles);
    o.value("boards_cycles", {"pixel clocks", kFormula, "of it that pipeline skew and frame start take"},
            d.retrace.boards_cycles);
    o.value("tables_cycles", {"pixel clocks", kFormula, "that the longest load begun at a retrace takes beside them"},
            d.retrace.tables_cycles);
    o.value("frame", {"", kCount, "displayed frame of which it is the retrace"}, d.retrace.frame);
    o.value("slack_cycles", {"pixel clocks", kFormula, "left of it; negative: late"}, d.retrace.slack_cycles);
    o.metric("slack_us", {"us", kFormula, "the same"}, d.retrace.slack_us);
    o.value("needs", {"", kFormula, "what it is left for: frame start or table load"}, d.retrace.needs);
  });
  v.object("lines", "the start of scan lines", [&](Visitor& o) {
    o.value("available_cycles", {"pixel clocks", kFormula, "of horizontal blanking"}, d.lines.available_cycles);
    o.object("worst", "the line that is left the least", [&](Visitor& w) {
      w.value("frame", {"", kCount, "displayed frame"}, d.lines.worst.frame);
      w.value("line", {"", kCount, "of the picture, from 0"}, d.lines.worst.line);
      w.value("available_cycles",
              {"pixel clocks", kFormula, "before its first pixel: blanking, and for a first line the retrace"},
              d.lines.worst.available_cycles);
      w.value("needed_cycles", {"pixel clocks", kFormula, "of them that are needed"}, d.lines.worst.needed_cycles);
      w.value("slack_cycles", {"pixel clocks", kFormula, "left of them; negative: late"}, d.lines.worst.slack_cycles);
      w.metric("slack_us", {"us", kFormula, "the same"}, d.lines.worst.slack_us);
      w.value("needs", {"", kFormula, "what they are left for: line start or table load"}, d.lines.worst.needs);
    });
    o.integers("slack_cycles", {"pixel clocks", kFormula, "of each line, the least over the frames"},
               d.lines.slack_cycles);
  });
  v.object("host", "the update of coefficients that is left the least, before the retrace that copies it",
           [&](Visitor& o) {
             o.value("shown", {"", kCount, "whether it came in after the first picture; false: the next one is meant"},
                     d.host.shown);
             o.value("frame", {"", kCount, "displayed frame that shows it first; 0 where none does"}, d.host.frame);
             o.value("video_frames", {"frames", kFormula, "video frames that the update takes"}, d.host.video_frames);
             o.value("used_cycles", {"host cycles", kFormula, "of the slowest unit, from retrace to last word"},
                     d.host.used_cycles);
             o.value("slack_cycles", {"host cycles", kFormula, "left of those video frames"}, d.host.slack_cycles);
             o.metric("slack_us", {"us", kFormula, "from the last host's last word to the retrace"}, d.host.slack_us);
           });
}

template <class Visitor>
void visit(Visitor& v, run::LinkFigures& l) {
  v.value("name", {"", kSetting, "the link"}, l.name);
  v.value("bits", {"bits", kSetting, "its width"}, l.bits);
  v.value("clock_hz", {"Hz", kSetting, "transfers of that width a second"}, l.clock_hz);
  v.value("bytes", {"bytes", kCount, "that crossed it in the whole run"}, l.bytes);
  v.value("peak_bytes_per_s", {"bytes/s", kFormula, "bits * clock / 8"}, l.peak_bytes_per_s);
  v.value("achieved_bytes_per_s", {"bytes/s", kFormula, "bytes / time of the displayed frames"},
          l.achieved_bytes_per_s);
  v.value("active_bytes_per_s", {"bytes/s", kFormula, "bytes / time in which it was transferring"},
          l.active_bytes_per_s);
  v.value("utilisation", {"fraction", kFormula, "achieved / peak"}, l.utilisation);
}

template <class Visitor>
void visit(Visitor& v, run::Memory& m) {
  v.value("name", {"", kSetting, "the memory, table or set of registers"}, m.name);
  v.value("instances", {"", kSetting, "how many of them the machine has"}, m.instances);
  v.value("words", {"words", kSetting, "of each"}, m.words);
  v.value("bits_per_word", {"bits", kSetting, "width of a word"}, m.bits_per_word);
  v.derived("total_bits", {"bits", kFormula, "instances * words * bits_per_word"}, m.total_bits());
}

template <class Visitor>
void visit(Visitor& v, run::Logic& l) {
  v.value("name", {"", kSetting, "where it is"}, l.name);
  v.value("count", {"as unit says", kFormula, "how many the machine has"}, l.count);
  v.value("unit", {"", kSetting, "adders, comparators, pins, registers, ..."}, l.unit);
}

template <class Visitor>
void visit(Visitor& v, reference::ErrorFigures& e) {
  v.value("reference",
          {"", kSetting,
           "ideal: the machine's own model in double, light at every pixel where it interpolates; snapped: the same "
           "given the snapped vertices; "
           "true: perspective-correct normals, local viewer and lights"},
          e.reference);
  v.value("compared", {"pixels", kCount, "covered in both pictures"}, e.compared);
  v.value("covered_missing", {"pixels", kCount, "covered in the exact picture only"}, e.covered_missing);
  v.value("covered_extra", {"pixels", kCount, "covered in the machine's picture only"}, e.covered_extra);
  v.value("wrong_object", {"pixels", kCount, "compared pixels that show different triangles"}, e.wrong_object);
  v.value("max_level", {"levels", kFormula, "largest difference of a channel of the compared pixels"}, e.max_level);
  v.value("max_level_same_object", {"levels", kFormula, "the same, of pixels that show the same triangle"},
          e.max_level_same_object);
  v.metric("rmse_level", {"levels", kFormula, "root of the mean square difference of the compared pixels' channels"},
           e.rmse_level);
  v.metric("rmse_unrounded_level",
           {"levels", kFormula, "the same with the exact level not rounded: holds the display's own rounding"},
           e.rmse_unrounded_level);
  v.metric("psnr_db",
           {"dB", kFormula, "20 log10(255 / rmse_level); null where that is infinite, or nothing is compared"},
           e.psnr_db);
  v.metric("psnr_outline_db",
           {"dB", kFormula, "PSNR over the pixels that either picture covers, missing and extra ones included"},
           e.psnr_outline_db);
  v.metric("over_one_level_percent",
           {"%", kFormula, "compared pixels with a channel that differs by more than one level"},
           e.over_one_level_percent);
}

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

template <class Visitor>
void visit_boards(Visitor& v, run::Modelled& m) {
  v.object("object_processors", "of the machine", [&](Visitor& o) {
    o.value("available", {"processors", kSetting, "that the machine has"}, m.processors_available);
    o.value("used", {"processors", kCount, "that hold an object"}, m.processors_used);
    o.value("instantiated", {"processors", kCount, "that were simulated"}, m.processors_instantiated);
  });
  v.object("lines", "scan lines of the boards", [&](Visitor& o) {
    o.value("total", {"lines", kFormula, "scan lines * boards"}, m.lines_total);
    o.value("evaluated", {"lines", kCount, "on which a board had something to do"}, m.lines_evaluated);
  });
  v.object("coefficients", "words written to the boards", [&](Visitor& o) {
    o.value(
        "total",
        {"words", kFormula,
         "22 for every slot that holds an object, an update; slots that show nothing are parked with 3 words or none"},
        m.coefficients_total);
    o.value("sent", {"words", kCount, "that were written"}, m.coefficients_sent);
  });
}

template <class Visitor>
void visit(Visitor& v, run::Modelled& m, const Kinds& kinds) {
  if (kinds.boards) visit_boards(v, m);
  v.object("objects", "triangles of the scene", [&](Visitor& o) {
    o.value("made", {"triangles", kCount, "of the scene"}, m.objects_made);
    o.value("degenerate", {"triangles", kCount, "of zero area as made"}, m.objects_degenerate);
    o.value("dropped", {"triangles", kCount, "that found no processor"}, m.objects_dropped);
  });
  v.object("fragments", "pixels of objects, where the nearest is found", [&](Visitor& o) {
    o.value("in", {"fragments", kCount, "kept + hidden"}, m.fragments_in);
    o.value("kept", {"fragments", kCount, "nearest at their pixel"}, m.fragments_kept);
    o.value("hidden", {"fragments", kCount, "behind another"}, m.fragments_hidden);
  });
  v.texts("left_out", {"", kFormula, "what was not simulated because the scene does not need it"}, m.left_out);
}

template <class Visitor>
void visit(Visitor& v, run::HostFigures& h) {
  v.value("wall_seconds", {"s", kCount, "that the simulation took"}, h.wall_seconds);
  v.value("simulated_clocks_per_second", {"1/s", kFormula, "pixel clocks simulated a second"},
          h.simulated_clocks_per_second);
  v.value("peak_memory_bytes", {"bytes", kCount, "of the simulator's process"}, h.peak_memory_bytes);
}

template <class Visitor, class T>
void visit_list(Visitor& v, const char* key, const char* description, std::vector<T>& list) {
  v.list(key, description, list, [](Visitor& inner, T& element) { visit(inner, element); });
}

template <class Visitor>
void visit(Visitor& v, Contents& contents) {
  run::Result& r = contents.result;
  v.derived("schema", {"", kSetting, "version of these keys"}, kSchema);
  v.value("platform", {"", kSetting, "the kind of machine"}, r.platform);
  const Kinds kinds(r.platform);
  v.value("config_digest", {"", kFormula, "SHA-256 of the resolved machine, without origins"}, r.config_digest);
  v.value("scene_digest", {"", kFormula, "SHA-256 of the scene and of its mesh files"}, r.scene_digest);
  v.value("frames", {"frames", kSetting, "displayed frames that were simulated"}, r.frame_count);
  if (kinds.spans)
    v.value("simulated_frames", {"frames", kFormula, "that cycles, links and fragments are of: at least three"},
            r.simulated_frames);
  v.object("video", "the picture", [&](Visitor& o) {
    o.value("columns", {"pixels", kSetting, "of a line"}, r.columns);
    o.value("lines", {"lines", kSetting, "of a frame"}, r.lines);
    o.value("obtained_refresh_hz", {"Hz", kFormula, "display rate in whole pixel clocks"}, r.obtained_refresh_hz);
    o.value("interlaced", {"", kSetting, "whether a frame is two fields, and rates are of fields"}, r.interlaced);
  });
  v.object("answer", "does the machine show the scene at its rate", [&](Visitor& o) { visit(o, r.answer, kinds); });
  visit_list(v, "units", "where the cycles of each unit go, over the whole run", r.units);
  visit_list(v, "budgets", "what is needed beside what there is", r.budgets);
  if (kinds.boards)
    v.object("deadlines", "what is left of the display's deadlines", [&](Visitor& o) { visit(o, r.deadlines); });
  visit_list(v, "links", "bandwidth", r.links);
  visit_list(v, "memories", "bits", r.memories);
  visit_list(v, "logic", "adders, comparators, pins", r.logic);
  v.list("images", "the displayed frames", r.frames,
         [&](Visitor& inner, run::FrameFigures& frame) { visit(inner, frame, kinds); });
  v.object("modelled", "what was simulated", [&](Visitor& o) { visit(o, r.modelled, kinds); });
  visit_blame(v, contents.blame);
  v.texts("warnings", {"", kFormula, "what may not be meant"}, r.warnings);
  v.optional_object("host", "of the simulation itself; only with --host-figures", contents.host_figures,
                    [&](Visitor& o) { visit(o, r.host); });
}

}  // namespace schema
}  // namespace rastertlm::report
