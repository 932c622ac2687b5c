#include "src/report/blame_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/report/file_names.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

std::string share(double fraction) {
  const std::string text = fmt::format("{:.1f} %", 100.0 * fraction);
  return text == "-0.0 %" ? "0.0 %" : text;
}

std::string levels(double value) { return fmt::format("{:.3g}", value); }

std::string table_of(const FrameBlameFigures& frame) {
  TextTable table({{"step"},
                   {"pixels", Align::right},
                   {"largest", Align::right},
                   {"removes", Align::right},
                   {"left: largest", Align::right},
                   {"RMSE", Align::right},
                   {"alone", Align::right},
                   {"alone: largest", Align::right},
                   {"99.9 %", Align::right},
                   {"mean", Align::right},
                   {"interaction", Align::right},
                   {"of worst", Align::right}},
                  "  ");
  for (const StepFigures& s : frame.steps)
    table.row({s.step, grouped(s.blamed_pixels), std::to_string(s.blamed_max_level), share(s.removed_share),
               std::to_string(s.left_max_level), levels(s.left_rmse_level), share(s.alone_share),
               levels(s.alone_max_level), levels(s.alone_p999_level), levels(s.alone_mean_level),
               share(s.interaction_share), fmt::format("{:.2f}", s.of_largest_level)});
  return table.text();
}

}  // namespace

std::string blame_section(const BlameContents& blame) {
  if (blame.frames.empty()) return "";
  const auto farther = [](const FrameBlameFigures& a, const FrameBlameFigures& b) {
    return a.rmse_level < b.rmse_level;
  };
  const FrameBlameFigures& frame = *std::max_element(blame.frames.begin(), blame.frames.end(), farther);
  std::string title = "What made pixels wrong";
  if (blame.frames.size() > 1)
    title += fmt::format(" (frame {}, the farthest from the ideal picture of {})", frame.frame, blame.frames.size());
  std::string text = '\n' + title + '\n' + std::string(title.size(), '=') + '\n';
  text += fmt::format("  {} of {} pixels have a level that is not the ideal one", grouped(frame.wrong),
                      grouped(frame.pixels));
  if (frame.other_words > 0)
    text += fmt::format(
        ".\n  {} of them show words or tables that are not this pose's: late, torn, half-written, or of objects "
        "without "
        "a processor.\n  No step is to blame for these; all that follows is of the other pixels",
        grouped(frame.other_words));
  text += fmt::format("; RMSE {} levels, not rounded; largest {}.\n", levels(frame.rmse_level), frame.max_level);
  text += table_of(frame);
  text += fmt::format(
      "  Shares are of the squares of the differences. Removes: what goes where the step alone is made exact. Alone: "
      "what it makes\n  where all others are. Interaction: the difference of both; of all steps together {} of the "
      "squares are no step's alone.\n",
      share(frame.interaction_share));
  text += fmt::format(
      "  Of worst: shares of the largest difference of pixels that show the right triangle, {:.2f} levels at column "
      "{}, "
      "line {}.\n",
      frame.largest_level, frame.largest_column, frame.largest_line);
  return text + fmt::format("  {} and the channel blame.step of {} have the step of every pixel.\n",
                            blame_name(frame.frame), channels_name(frame.frame));
}

}  // namespace rastertlm::report
