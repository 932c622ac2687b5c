// A result with something in every field, for tests of the reports.
#pragma once

#include <string>

#include "src/report/blame_figures.h"
#include "src/run/result.h"

namespace rastertlm::report {

// Of a region of so many pixels.
inline reference::RegionFigures example_part(std::uint64_t compared) {
  reference::RegionFigures e;
  e.compared = compared;
  e.covered_missing = 1;
  e.wrong_order = 1;
  e.max_level = 3;
  e.rmse_level = 0.25;
  e.psnr_db = 60.5;
  e.over_two_levels_percent = 0.75;
  e.edges_measured = 31;
  e.edge_jump_rms_level = 0.8125;
  e.edge_jump_max_level = 2.0;
  e.flip_mean = 0.0123;
  e.flip_p95 = 0.0456;
  e.ciede2000_mean = 0.111;
  e.ciede2000_p99 = 1.222;
  return e;
}

inline reference::ErrorFigures example_error(const std::string& reference, int largest) {
  reference::ErrorFigures e;
  e.reference = reference;
  e.compared = 52'001;
  e.covered_missing = 2;
  e.covered_extra = 3;
  e.wrong_object = 4;
  e.max_level = largest;
  e.max_level_same_object = largest - 1;
  e.rmse_level = 0.123456789;
  e.rmse_unrounded_level = 0.3333333333;
  e.psnr_db = 66.30123456;
  e.over_one_level_percent = 0.0123456789;
  e.over_two_levels_percent = 0.00456;
  e.wrong_order = 2;
  e.edges_measured = 77;
  e.edge_jump_rms_level = 0.625;
  e.still_pixels = 51'000;
  e.flicker_rms_level = 0.4375;
  e.flicker_max_level = 2.0;
  e.inside = example_part(51'000);
  e.silhouettes = example_part(881);
  e.highlights = example_part(120);
  return e;
}

inline run::FrameFigures example_frame(std::uint64_t frame) {
  run::FrameFigures f;
  f.frame = frame;
  f.animation_frame = static_cast<std::int64_t>(frame) - 1;
  f.last_animation_frame = static_cast<std::int64_t>(frame) + 2;
  f.first_pixel_ps = 10'000'000'000 + frame;
  f.last_pixel_ps = 19'999'980'000;
  f.drawn = 885;
  f.facing = 431;
  f.back_faces = 449;
  f.degenerate = 16;
  f.outside = 5;
  f.pieces = 6;
  f.pieces_dropped = 7;
  f.snap_fraction_bits = 5;
  f.covered_pixels = 52'003;
  f.fragments = 61'234;
  f.host_flops = 123'456;
  f.words_sent = 19'712;
  f.late_table_lines = 11;
  f.line_slack_cycles = -12;
  f.retrace_slack_cycles = 10'253;
  f.host_slack_us = 1960.98345;
  f.errors = {example_error("ideal", 9), example_error("snapped", 8), example_error("true", 17)};
  return f;
}

inline run::Answer example_answer() {
  run::Answer a;
  a.frame_rate_hz = a.update_rate_hz = 50.00005;
  a.display_rate_hz = 50.00005;
  a.required_rate_hz = 50.0;
  a.sustained = true;
  a.headroom = 0.1934567;
  a.bottleneck = {"computation unit 3", "floating-point operations", 0.838};
  a.latency_frames = 2;
  a.initial_load_frames = 7;
  a.limits = {"The host needs 84 % of a frame."};
  return a;
}

inline run::Deadlines example_deadlines() {
  run::Deadlines d;
  d.retrace = {10'261, 8, 17, 1, 10'253, 615.18, "frame start"};
  d.lines.available_cycles = 119;
  d.lines.worst = {1, 347, 229'337, 229'349, -12, -0.72, "table load"};
  d.lines.slack_cycles = {10'363, 110, -12};
  d.host = {true, 1, 2, 360'780, 39'219, 1960.98345};
  return d;
}

// Sustained at 512x512, 50 Hz, with two frames.
inline run::Result example_result() {
  run::Result r;
  r.platform = "imogene";
  r.config_digest = std::string(64, 'a');
  r.scene_digest = std::string(64, 'b');
  r.frame_count = 2;
  r.columns = 512;
  r.lines = 512;
  r.obtained_refresh_hz = 50.00005;
  r.answer = example_answer();
  r.units = {{"shading", 1e9 / 60.0, 666'666, 524'288, 100'000, 42'000, 378, "pixel clock"}};
  r.budgets = {{"line_start", 21.0, 119.0, "cycles", true, true, "004, section 4.2", "object_processor.slice_bits"},
               {"dot_table.load_68000", 650.25, 600.0, "us", false, false, "004, table 5.3", "loader.kind"}};
  r.deadlines = example_deadlines();
  r.links = {{"boards to decision unit", 32, 33'333'333.3333, 18'446'744'073'709'551'615U, 133'333'333.333,
              27'340'000.0, 30'000'000.0, 0.20505}};
  r.memories = {{"specular table", 16, 4096, 8}};
  r.logic = {{"decision unit", 1023, "comparators"}};
  r.modelled = {1024, 896, 431, 8192,   2048,   43'008, 19'712,
                896,  16,  1,   61'234, 52'003, 9'231,  {"second light: none in the scene"},
                6,    3};
  r.flip_pixels_per_degree = 67.0;
  r.frames = {example_frame(0), example_frame(1)};
  r.warnings = {"Nothing moves."};
  r.host = {1.25, 266'666.4, 123'456'789, 0.75, 0.125};
  return r;
}

inline BlameContents example_blame() {
  FrameBlameFigures f;
  f.frame = 1;
  f.pixels = 52'000;
  f.wrong = 5'200;
  f.other_words = 3;
  f.rmse_level = 0.4123456;
  f.max_level = 9;
  f.largest_level = 8.75;
  f.largest_column = 17;
  f.largest_line = 18;
  f.interaction_share = -0.125;
  f.steps = {{"coverage", 12, 9, 0.5, 4, 0.25, 0.4, 0.1, 200.5, 0.5, 0.01, 0.0},
             {"dot product", 5'185, 7, 0.25, 3, 0.125, 0.725, -0.475, 6.5, 2.25, 0.11, 8.75}};
  return {{{0, "right", "as it should be", "#000000"},
           {1, "coverage", "the edges", "#ffffff"},
           {6, "dot product", "the sum", "#d53c00"}},
          {f}};
}

}  // namespace rastertlm::report
