// The section "blame" of report.json (schema.h).
#pragma once

#include "src/report/blame_figures.h"
#include "src/report/file_names.h"
#include "src/report/schema_field.h"

namespace rastertlm::report::schema {

template <class Visitor>
void visit(Visitor& v, LegendEntry& e) {
  v.value("value", {"", kSetting, "of a pixel of the channel blame.step"}, e.value);
  v.value("name", {"", kSetting, "of the step that it stands for"}, e.name);
  v.value("meaning", {"", kSetting, "what the step does to a level"}, e.meaning);
  v.value("colour", {"", kSetting, "in the picture, #rrggbb"}, e.colour);
}

template <class Visitor>
void visit(Visitor& v, StepFigures& s) {
  v.value("step", {"", kSetting, "name"}, s.step);
  v.value("blamed_pixels", {"pixels", kCount, "wrong ones that are blamed on it"}, s.blamed_pixels);
  v.value("blamed_max_level", {"levels", kFormula, "largest difference of them"}, s.blamed_max_level);
  v.metric("removed_share",
           {"fraction", kFormula, "of the squares of the differences, that goes where it alone is made exact"},
           s.removed_share);
  v.value("left_max_level", {"levels", kFormula, "largest difference that is then left"}, s.left_max_level);
  v.metric("left_rmse_level", {"levels", kFormula, "root mean square that is then left, not rounded"},
           s.left_rmse_level);
  v.metric("alone_share", {"fraction", kFormula, "of the squares, that it makes where all others are exact"},
           s.alone_share);
  v.metric("interaction_share", {"fraction", kFormula, "removed_share - alone_share"}, s.interaction_share);
  v.metric("alone_max_level", {"levels", kFormula, "largest difference that it makes alone, not rounded"},
           s.alone_max_level);
  v.metric("alone_p999_level", {"levels", kFormula, "that 999 pixels in 1000 do not exceed, in steps of 1/64"},
           s.alone_p999_level);
  v.metric("of_largest_level", {"levels", kFormula, "its share of largest_level: the shares add up to that"},
           s.of_largest_level);
  v.metric("alone_mean_level", {"levels", kFormula, "of each pixel's largest channel"}, s.alone_mean_level);
}

template <class Visitor>
void visit(Visitor& v, FrameBlameFigures& f) {
  v.value("frame", {"", kCount, "the displayed frame"}, f.frame);
  v.derived("file", {"", kFormula, "the picture of the steps"}, blame_name(f.frame));
  v.value("pixels", {"pixels", kCount, "that either picture covers"}, f.pixels);
  v.value("wrong", {"pixels", kCount, "of them, with a level that is not the ideal one, rounded"}, f.wrong);
  v.value("other_words", {"pixels", kCount, "of the wrong, with words that are not the pose's; in no share"},
          f.other_words);
  v.metric("rmse_level", {"levels", kFormula, "root mean square of the differences, not rounded"}, f.rmse_level);
  v.value("max_level", {"levels", kFormula, "largest difference"}, f.max_level);
  v.metric("largest_level",
           {"levels", kFormula, "largest difference of pixels that show the right triangle, not rounded"},
           f.largest_level);
  v.value("largest_column", {"pixels", kFormula, "where that is"}, f.largest_column);
  v.value("largest_line", {"pixels", kFormula, "where that is"}, f.largest_line);
  v.metric("interaction_share", {"fraction", kFormula, "1 - the sum of alone_share"}, f.interaction_share);
  v.list("steps", "in the order of the data", f.steps, [](Visitor& inner, StepFigures& step) { visit(inner, step); });
}

template <class Visitor>
void visit_blame(Visitor& v, BlameContents& blame) {
  bool there = !blame.frames.empty();
  v.optional_object("blame", "which step made pixels wrong, against the ideal picture; only with --blame", there,
                    [&](Visitor& o) {
                      o.list("legend", "of the channel blame.step and of the pictures", blame.legend,
                             [](Visitor& inner, LegendEntry& entry) { visit(inner, entry); });
                      o.list("frames", "the displayed frames", blame.frames,
                             [](Visitor& inner, FrameBlameFigures& frame) { visit(inner, frame); });
                    });
}

}  // namespace rastertlm::report::schema
