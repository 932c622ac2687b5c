#include "src/report/text_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "src/report/blame_section.h"
#include "src/report/error_image.h"
#include "src/report/error_section.h"
#include "src/report/merged_rows.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

constexpr const char* kIndent = "  ";

std::string heading(const std::string& title) { return '\n' + title + '\n' + std::string(title.size(), '=') + '\n'; }
std::string sentence_line(const std::string& sentence) { return kIndent + sentence + '\n'; }

std::string percent_of(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

bool has_boards(const run::Result& result) { return result.platform == "imogene"; }

std::string limits_section(const run::Result& result) {
  const run::Answer& a = result.answer;
  std::string text = heading("What is in the way of the rate");
  if (a.limits.empty()) text += sentence_line("Nothing: every unit keeps up.");
  for (const std::string& limit : a.limits) text += sentence_line(limit);
  TextTable table({{"rate"}, {"Hz", Align::right}, {"meaning"}}, kIndent);
  table.row({"required", rate(a.required_rate_hz), "video.refresh_hz"});
  table.row({"display", fmt::format("{:.6g}", a.display_rate_hz), "frames scanned out, in whole pixel clocks"});
  table.row({"update", fmt::format("{:.6g}", a.update_rate_hz), "new pictures"});
  text += table.text();
  text += sentence_line(fmt::format(
      "From the start of an animation frame to the first line of its picture: {}; {} us to its first pixel, "
      "{} us to its last.",
      counted(a.latency_frames, "frame", "frames"), quantity(a.latency_first_pixel_us),
      quantity(a.latency_last_pixel_us)));
  if (has_boards(result))
    text += sentence_line(fmt::format(
        "First picture after {} of loading: {} us, {} bytes of meshes, which stay with the hosts. What follows is "
        "without it.",
        counted(a.initial_load_frames, "frame", "frames"), quantity(a.initial_load_us), grouped(a.initial_load_bytes)));
  if (a.torn_frames > 0)
    text += sentence_line(
        fmt::format("{} of {} displayed frames are torn: {}.", grouped(a.torn_frames), grouped(result.frame_count),
                    has_boards(result) ? "they have words or light of two animation frames"
                                       : "their screens do not show them as they were when they were whole"));
  return text;
}

std::string units_section(const run::Result& result) {
  if (result.units.empty()) return "";
  TextTable table({{"unit"},
                   {"clock", Align::right},
                   {"cycles", Align::right},
                   {"busy", Align::right},
                   {"", Align::right},
                   {"starved", Align::right},
                   {"", Align::right},
                   {"blocked", Align::right},
                   {"", Align::right},
                   {"idle", Align::right},
                   {"", Align::right}},
                  kIndent);
  std::vector<std::vector<std::string>> rows;
  for (const run::UnitFigures& u : result.units)
    rows.push_back({u.name, frequency(u.clock_hz), grouped(u.cycles), grouped(u.busy), percent_of(u.busy, u.cycles),
                    grouped(u.starved), percent_of(u.starved, u.cycles), grouped(u.blocked),
                    percent_of(u.blocked, u.cycles), grouped(u.idle), percent_of(u.idle, u.cycles)});
  for (auto& row : merged_rows(rows)) table.row(std::move(row));
  return heading(fmt::format("Where the cycles go ({}, cycles of each unit's own clock)",
                             has_boards(result) ? counted(result.frame_count, "displayed frame", "displayed frames")
                                                : counted(result.simulated_frames, "frame", "frames"))) +
         table.text();
}

std::string fits_text(const run::Budget& budget) {
  const std::string text = budget.fits ? "yes" : "NO";
  return budget.applies ? text : '(' + text + ')';
}

std::string budgets_section(const run::Result& result) {
  if (result.budgets.empty()) return "";
  TextTable table({{"budget"},
                   {"used", Align::right},
                   {"available", Align::right},
                   {"unit"},
                   {"of it", Align::right},
                   {"fits"},
                   {"source"}},
                  kIndent);
  for (const run::Budget& b : result.budgets)
    table.row({b.name, quantity(b.used), quantity(b.available), b.unit,
               b.available > 0.0 ? percent(b.used / b.available) : "-", fits_text(b), b.source});
  return heading("Budgets") + table.text() +
         sentence_line("In brackets: this machine does not depend on it; stated for comparison.");
}

std::string deadlines_section(const run::Result& result) {
  const run::Deadlines& d = result.deadlines;
  TextTable table({{"deadline"},
                   {"worst"},
                   {"available", Align::right},
                   {"needed", Align::right},
                   {"left", Align::right},
                   {"left, us", Align::right},
                   {"of"},
                   {"for"}},
                  kIndent);
  const auto in_clocks = [](std::int64_t cycles) { return quantity(static_cast<double>(cycles)); };
  const auto in_us = [](double us) { return fmt::format("{:.6g}", us); };
  const run::Deadlines::Lines::Worst& line = d.lines.worst;
  table.row({"scan line", fmt::format("frame {}, line {}", line.frame, line.line), grouped(line.available_cycles),
             grouped(line.needed_cycles), in_clocks(line.slack_cycles), in_us(line.slack_us),
             "pixel clocks before its first pixel", line.needs});
  table.row({"vertical retrace", fmt::format("frame {}", d.retrace.frame), grouped(d.retrace.available_cycles),
             in_clocks(static_cast<std::int64_t>(d.retrace.available_cycles) - d.retrace.slack_cycles),
             in_clocks(d.retrace.slack_cycles), in_us(d.retrace.slack_us), "pixel clocks", d.retrace.needs});
  table.row({"hosts' update", d.host.shown ? fmt::format("frame {}", d.host.frame) : "the next one",
             in_clocks(static_cast<std::int64_t>(d.host.used_cycles) + d.host.slack_cycles),
             grouped(d.host.used_cycles), in_clocks(d.host.slack_cycles), in_us(d.host.slack_us),
             fmt::format("host cycles of a video frame; it takes {}",
                         counted(d.host.video_frames, "video frame", "video frames")),
             "links, arithmetic and bus of the slowest unit"});
  return heading("Deadlines") + table.text() +
         sentence_line(
             "The worst of all frames; of equal ones the first. The first line of a retrace has the retrace "
             "too. Every frame's are in its row of " +
             std::string(kFramesCsv) + ".");
}

std::string links_section(const run::Result& result) {
  if (result.links.empty()) return "";
  TextTable table({{"link"},
                   {"width", Align::right},
                   {"clock", Align::right},
                   {"moved", Align::right},
                   {"peak", Align::right},
                   {"while active", Align::right},
                   {"over the run", Align::right},
                   {"used", Align::right}},
                  kIndent);
  std::vector<std::vector<std::string>> rows;
  for (const run::LinkFigures& l : result.links)
    rows.push_back({l.name, counted(l.bits, "bit", "bits"), frequency(l.clock_hz), grouped(l.bytes) + " B",
                    bytes_per_second(l.peak_bytes_per_s), bytes_per_second(l.active_bytes_per_s),
                    bytes_per_second(l.achieved_bytes_per_s), percent(l.utilisation)});
  for (auto& row : merged_rows(rows)) table.row(std::move(row));
  return heading("Bandwidth") + table.text();
}

std::string memory_section(const run::Result& result) {
  std::string text;
  if (!result.memories.empty()) {
    TextTable table({{"memory"},
                     {"instances", Align::right},
                     {"words", Align::right},
                     {"bits a word", Align::right},
                     {"total", Align::right}},
                    kIndent);
    std::uint64_t total = 0;
    for (const run::Memory& m : result.memories) {
      table.row({m.name, grouped(m.instances), grouped(m.words), grouped(m.bits_per_word), bits(m.total_bits())});
      total += m.total_bits();
    }
    table.row({"together", "", "", "", bits(total)});
    text += heading("Memory that the machine has") + table.text();
  }
  if (!result.logic.empty()) {
    TextTable table({{"logic"}, {"count", Align::right}, {"unit"}}, kIndent);
    for (const run::Logic& l : result.logic) table.row({l.name, grouped(l.count), l.unit});
    text += heading("Logic that the machine has") + table.text();
  }
  return text;
}

void add_solids(const run::Result& result, TextTable& table) {
  const run::FrameFigures& f = result.frames.front();
  table.row({"made", grouped(result.modelled.solids_made), "solids"});
  table.row({"drawn", grouped(f.solids_drawn), "solids"});
  table.row({"outside the view", grouped(f.solids_outside), "solids"});
  table.row({"left out, of words that cannot show them", grouped(f.solids_refused), "solids"});
}

std::string pictures_section(const run::Result& result) {
  if (result.frames.empty()) return "";
  const run::FrameFigures& f = result.frames.front();
  TextTable table({{fmt::format("frame {}", f.frame)}, {"", Align::right}, {"unit"}}, kIndent);
  const auto add = [&](const char* what, std::uint64_t count, const char* unit) {
    table.row({what, grouped(count), unit});
  };
  add("made", result.modelled.objects_made, "triangles");
  add("drawn", f.drawn, "triangles");
  add("face the viewer", f.facing, "triangles");
  add("face away", f.back_faces, "triangles");
  add("of zero area", f.degenerate, "triangles");
  add("outside the view", f.outside, "triangles");
  if (has_boards(result)) {
    add("more processors for clipped pieces", f.pieces, "processors");
    add("pieces dropped", f.pieces_dropped, "pieces");
    if (result.modelled.solids_made > 0) add_solids(result, table);
  } else {
    add("more pieces by clipping", f.pieces, "triangles");
    add("handed to the span unit, children included", f.span.drawn_pieces, "triangles");
    add("split by the highlight test", f.span.splits, "triangles");
    if (f.span.splits > 0)
      table.row({"largest step of colour beside a split triangle", fmt::format("{:.4g}", f.span.largest_step_levels),
                 "levels"});
    if (f.highlight.tested > 0) {
      add("may hold a highlight", f.highlight.potentially, "triangles");
      add("lie beside one that may", f.highlight.neighbours, "triangles");
      if (f.highlight.recall)
        table.row({"hold a true centre of a highlight, of those that may",
                   fmt::format("{:.3g}", 100.0 * f.highlight.precision.value_or(0.0)), "%"});
      if (f.highlight.recall)
        table.row({"true centres in such triangles", fmt::format("{:.4g}", 100.0 * *f.highlight.recall), "%"});
      add("cut up, of these", f.highlight.divided, "triangles");
      add("parts of them", f.highlight.parts, "triangles");
    }
    add("in one colour", f.span.flat, "triangles");
    add("light evaluated at points of triangles", f.span.lighting_evaluations, "times");
    if (f.span.shaded_pixels > 0) {
      add("lit one by one", f.span.shaded_pixels, "pixels");
      add("operations of the pixel unit for them", f.span.shading_flops, "flop");
    }
  }
  add("fraction bits of snapped vertices", static_cast<std::uint64_t>(std::max(f.snap_fraction_bits, 0)), "bits");
  add("covered", f.covered_pixels, "pixels");
  add("fragments, hidden ones included", f.fragments, "pixels");
  add("host operations", f.host_flops, "flop");
  add("words sent to the hardware", f.words_sent, "words");
  if (has_boards(result)) add("shaded from half-written tables", f.late_table_lines, "lines");
  if (!has_boards(result)) add("stepped over off the screen", f.span.off_screen_pixels, "pixels");
  if (f.span.torn_lines > 0) add("of the screen, not as the frame was when it was whole", f.span.torn_lines, "lines");
  std::string text = heading("What the picture is made of") + table.text();
  if (result.frames.size() > 1) text += sentence_line(fmt::format("Every frame is a row of {}.", kFramesCsv));
  if (result.interlaced)
    text += sentence_line(
        "A frame is two fields: figures of triangles are those of the even lines' pose, operations and words of both.");
  return text;
}

std::string boards_modelled(const run::Modelled& m) {
  std::string text;
  text += sentence_line(fmt::format("Object processors: {} in the machine, {} hold an object, {} simulated.",
                                    grouped(m.processors_available), grouped(m.processors_used),
                                    grouped(m.processors_instantiated)));
  if (m.quadrics_available > 0)
    text += sentence_line(
        fmt::format("Quadric processors: {} in the machine, {} hold a solid, {} simulated{}.",
                    grouped(m.quadrics_available), grouped(m.quadrics_used), grouped(m.quadrics_instantiated),
                    m.solids_dropped > 0 ? fmt::format("; {} solids without one", m.solids_dropped) : std::string()));
  text += sentence_line(fmt::format("Scan lines of boards: {} of {} had something to do.", grouped(m.lines_evaluated),
                                    grouped(m.lines_total)));
  text += sentence_line(fmt::format("Coefficient words: {} sent of {} that there are.", grouped(m.coefficients_sent),
                                    grouped(m.coefficients_total)));
  return text;
}

std::string modelled_section(const run::Result& result) {
  const run::Modelled& m = result.modelled;
  std::string text = heading("What was modelled");
  if (has_boards(result)) text += boards_modelled(m);
  text += sentence_line(fmt::format(
      "Triangles: {} made, {} of them of zero area{}.", grouped(m.objects_made), grouped(m.objects_degenerate),
      has_boards(result) ? fmt::format(", {} without a processor", grouped(m.objects_dropped)) : std::string()));
  text += sentence_line(fmt::format("Fragments: {} into the {} = {} kept + {} hidden.", grouped(m.fragments_in),
                                    has_boards(result) ? "decision unit" : "depth test", grouped(m.fragments_kept),
                                    grouped(m.fragments_hidden)));
  if (m.exact_wanted > 0)
    text += sentence_line(fmt::format("Exact pictures: {} compared with, {} of them of a view that was not at hand.",
                                      grouped(m.exact_wanted), grouped(m.exact_made)));
  for (const std::string& sentence : m.left_out) text += sentence_line("Left out: " + sentence);
  return text;
}

std::string host_section(const Contents& contents) {
  if (!contents.host_figures) return "";
  const run::HostFigures& h = contents.result.host;
  return heading("The simulation itself") +
         sentence_line(fmt::format("{:.3g} s, {} simulated pixel clocks a second, {:.4g} MB at most.", h.wall_seconds,
                                   quantity(std::floor(h.simulated_clocks_per_second)),
                                   static_cast<double>(h.peak_memory_bytes) / 1e6)) +
         sentence_line(fmt::format("Apart from that: {:.3g} s for exact pictures, {:.3g} s for the figures of errors.",
                                   h.exact_seconds, h.figures_seconds));
}

std::string warnings_section(const run::Result& result) {
  if (result.warnings.empty()) return "";
  std::string text = heading("Warnings");
  for (const std::string& warning : result.warnings) text += sentence_line(warning);
  return text;
}

std::string inputs_section(const run::Result& result) {
  return heading("Inputs") + sentence_line("machine  " + result.config_digest) +
         sentence_line("scene    " + result.scene_digest) +
         sentence_line(fmt::format("SHA-256; the values are in {} and {}.", kResolvedMachine, kResolvedScene));
}

}  // namespace

std::string answer_sentence(const run::Result& result) {
  const run::Answer& a = result.answer;
  std::string text = fmt::format("{}x{}{} at {} Hz: {}, {:.1f} updates/s", result.columns, result.lines,
                                 result.interlaced ? " interlaced" : "", rate(a.required_rate_hz),
                                 a.sustained ? "sustained" : "NOT sustained", a.update_rate_hz);
  if (a.update_rate_hz < 0.999 * a.display_rate_hz)
    text += fmt::format(" on a display that scans out {:.1f} times a second", a.display_rate_hz);
  if (a.bottleneck.unit.empty()) return text + "; nothing limits it.";
  text += fmt::format("; limited by {}: {}, {} used", a.bottleneck.unit, a.bottleneck.resource,
                      percent(a.bottleneck.utilisation));
  if (!a.display_works) return text + ". The picture is not whole: " + a.limits.back() + ".";
  if (a.headroom >= 0.0) return text + fmt::format("; headroom {}.", percent(a.headroom));
  return text + fmt::format("; it allows {} less than the required rate.", percent(-a.headroom));
}

std::string text_report(const Contents& contents) {
  const run::Result& result = contents.result;
  std::string text = answer_sentence(result) + '\n';
  text += fmt::format("Machine: {}. {} simulated.\n", result.platform,
                      counted(result.frame_count, "displayed frame", "displayed frames"));
  if (!has_boards(result) && result.simulated_frames > result.frame_count)
    text += fmt::format("Its rate is that of {}; cycles, links and fragments are of all of them.\n",
                        counted(result.simulated_frames, "frame", "frames"));
  text += warnings_section(result);
  text += limits_section(result);
  text += units_section(result);
  text += budgets_section(result);
  if (has_boards(result)) text += deadlines_section(result);
  text += links_section(result);
  text += error_section(result);
  text += blame_section(contents.blame);
  text += memory_section(result);
  text += pictures_section(result);
  text += modelled_section(result);
  text += inputs_section(result);
  text += host_section(contents);
  return text;
}

}  // namespace rastertlm::report
