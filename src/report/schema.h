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
//   derived_list(key, description, vector, function(Visitor&, element))   follows from others
//   later_object(key, description, function(Visitor&))   an object that reports of schema 1 had not from the start
#pragma once

#include <string>
#include <vector>

#include "src/report/blame_schema.h"
#include "src/report/error_summaries.h"
#include "src/report/schema_errors.h"
#include "src/report/schema_field.h"
#include "src/report/schema_frames.h"
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

template <class Visitor>
void visit_initial_load(Visitor& v, run::Answer& a) {
  v.value("initial_load_frames", {"frames", kFormula, "video frames before the first picture"}, a.initial_load_frames);
  v.value("initial_load_us", {"us", kCount, "until the last computation unit has finished the first frame"},
          a.initial_load_us);
  v.value("initial_load_bytes",
          {"bytes", kCount, "of meshes and solids that cross the links once, each to the unit that keeps it"},
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
    o.value("boards_cycles",
            {"pixel clocks", kFormula, "of it that pipeline skew, frame start and the early start of quadrics take"},
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
void visit_boards(Visitor& v, run::Modelled& m) {
  v.object("object_processors", "of the machine", [&](Visitor& o) {
    o.value("available", {"processors", kSetting, "that the machine has"}, m.processors_available);
    o.value("used", {"processors", kCount, "that hold an object"}, m.processors_used);
    o.value("instantiated", {"processors", kCount, "that were simulated"}, m.processors_instantiated);
  });
  v.later_object("quadric_processors", "of the machine", [&](Visitor& o) {
    o.value("available", {"processors", kSetting, "that the machine has"}, m.quadrics_available);
    o.value("used", {"processors", kCount, "that hold a solid"}, m.quadrics_used);
    o.value("instantiated", {"processors", kCount, "that were simulated"}, m.quadrics_instantiated);
  });
  v.later_object("solids", "of the scene", [&](Visitor& o) {
    o.value("made", {"solids", kCount, "of the scene"}, m.solids_made);
    o.value("dropped", {"solids", kCount, "that found no processor"}, m.solids_dropped);
  });
  v.object("lines", "scan lines of the boards", [&](Visitor& o) {
    o.value("total", {"lines", kFormula, "scan lines * boards"}, m.lines_total);
    o.value("evaluated", {"lines", kCount, "on which a board had something to do"}, m.lines_evaluated);
  });
  v.object("coefficients", "words written to the boards", [&](Visitor& o) {
    o.value(
        "total",
        {"words", kFormula,
         "of every slot that holds an object, an update: 22 of a triangle, 31 and 9 a cap of a solid; slots that show "
         "nothing are parked with 3 words, of a solid 13, or none"},
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
  v.later_object("exact_pictures", "that the machine's were compared with", [&](Visitor& o) {
    o.value("wanted", {"pictures", kCount, "of each displayed pose and reference"}, m.exact_wanted);
    o.value("made", {"pictures", kCount, "of them, whose scene, view and options were not those of one at hand"},
            m.exact_made);
  });
}

template <class Visitor>
void visit(Visitor& v, run::HostFigures& h) {
  v.value("wall_seconds", {"s", kCount, "that the simulation took"}, h.wall_seconds);
  v.value("simulated_clocks_per_second", {"1/s", kFormula, "pixel clocks simulated a second"},
          h.simulated_clocks_per_second);
  v.value("peak_memory_bytes", {"bytes", kCount, "of the simulator's process"}, h.peak_memory_bytes);
  v.value("exact_seconds", {"s", kCount, "that exact pictures took, beside wall_seconds", kLater}, h.exact_seconds);
  v.value("figures_seconds", {"s", kCount, "that the figures of their differences took, likewise", kLater},
          h.figures_seconds);
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
  v.metric("flip_pixels_per_degree", {"pixels/degree", kSetting, "for FLIP; null without --perceptual", kLater},
           r.flip_pixels_per_degree);
  v.list("images", "the displayed frames", r.frames,
         [&](Visitor& inner, run::FrameFigures& frame) { visit(inner, frame, kinds); });
  std::vector<reference::ErrorSummary> summaries = summaries_of(r);
  v.derived_list("errors", "of all frames, the distance from each exact picture", summaries,
                 [](Visitor& inner, reference::ErrorSummary& summary) { visit(inner, summary); });
  v.object("modelled", "what was simulated", [&](Visitor& o) { visit(o, r.modelled, kinds); });
  visit_blame(v, contents.blame);
  v.texts("warnings", {"", kFormula, "what may not be meant"}, r.warnings);
  v.optional_object("host", "of the simulation itself; only with --host-figures", contents.host_figures,
                    [&](Visitor& o) { visit(o, r.host); });
}

}  // namespace schema
}  // namespace rastertlm::report
