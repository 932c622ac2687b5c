#include "src/cli/render_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "src/analysis/blame.h"
#include "src/cli/progress.h"
#include "src/cli/usage.h"
#include "src/report/error_section.h"
#include "src/report/error_summaries.h"
#include "src/report/file_names.h"
#include "src/report/number_text.h"
#include "src/report/output_directory.h"
#include "src/report/result_writer.h"
#include "src/report/text_report.h"

namespace rastertlm::cli {
namespace {

// The frames go to their files as they are shown; an error of writing one is the error of the run, whatever became of
// it on its way through the simulation.
// `blame`, where asked for, gets what made each frame's pixels wrong.
run::Result simulate(const run::Inputs& inputs, const run::Options& options, report::ResultWriter& writer,
                     report::BlameContents* blame) {
  Progress progress(options.frames);
  const auto labels = [&](const run::FramePixels& pixels) -> std::optional<report::LabelledPicture> {
    if (blame == nullptr) return std::nullopt;
    analysis::FrameBlame found = analysis::blame(inputs, pixels);
    blame->frames.push_back(found.figures);
    blame->legend = found.legend;
    return report::LabelledPicture{"blame.step", report::blame_name(pixels.figures.frame), std::move(found.step),
                                   std::move(found.legend)};
  };
  const auto sink = [&](const run::FramePixels& pixels) {
    writer.write_frame(pixels, [&] { return labels(pixels); });
    progress.frame_done();
  };
  try {
    run::Result result = run::simulate(inputs, options, sink);
    writer.rethrow();
    return result;
  } catch (...) {
    writer.rethrow();
    throw;
  }
}

void print_summary(const run::Result& result, const std::string& directory, bool timeline) {
  std::string text = report::answer_sentence(result) + '\n';
  if (const auto ideal = report::worst_of(result, "ideal"))
    text += fmt::format(
        "Against the ideal picture: {} missing, {} extra pixels; largest error {} levels, PSNR with outlines {}.\n",
        report::grouped(ideal->covered_missing), report::grouped(ideal->covered_extra), ideal->max_level,
        report::decibels(ideal->psnr_outline_db, ideal->compared + ideal->covered_missing + ideal->covered_extra));
  for (const std::string& warning : result.warnings) text += "Warning: " + warning + '\n';
  text += fmt::format("{}/{}, {}, {}{}\n", directory, report::kReportText, report::kReportJson,
                      result.frames.empty() ? report::kFramesCsv : report::picture_name(result.frames.front().frame),
                      timeline ? fmt::format(", {}", report::kTimeline) : std::string());
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void RenderCommand::declare(CLI::App& app) {
  const auto validated = [](CLI::Option* option, std::string (*check)(const std::string&)) {
    option->check(CLI::Validator([check](std::string& text) { return check(text); }, "", ""));
  };
  app.add_option("MACHINE", machine_, "machine file")->capture_default_str();
  app.add_option("SCENE", scene_, "scene file")->capture_default_str();
  app.add_option("--set", overrides_,
                 "path=value: set a parameter of the machine, or of the scene; of a list's element\n"
                 "as object[0].radius=2")
      ->type_name("path=value")
      ->allow_extra_args(false);
  validated(app.add_option("--frames", frames_, "displayed frames")->capture_default_str()->type_name("N"),
            whole_from_one);
  validated(
      app.add_option("--out", out_, "directory of the results (default: out/<scene>_<machine>)")->type_name("DIR"),
      not_empty);
  validated(app.add_option("--require-rate", require_rate_, "exit code 1 where fewer pictures a second are new")
                ->type_name("HZ"),
            finite_and_positive);
  validated(
      app.add_option("--require-psnr", require_psnr_, "exit code 1 where a frame is farther from the ideal picture")
          ->type_name("DB"),
      finite_and_positive);
  app.add_flag("--model-everything", model_everything_,
               "simulate also what the scene does not need: of the figures, modelled alone changes");
  app.add_flag("--host-figures", host_figures_, "report time and memory of the simulation itself");
  app.add_flag("--no-reference", no_reference_, "do not render the exact pictures, measure no error");
  app.add_flag("--blame", blame_, "find the step that made each wrong pixel wrong: a table, a channel and a picture");
  CLI::Option* perceptual = app.add_flag("--perceptual", perceptual_,
                                         "measure FLIP and CIEDE2000 too, against every reference: it takes long");
  validated(app.add_option("--pixels-per-degree", pixels_per_degree_, "how near the eye is, for FLIP, 1 to 1000")
                ->capture_default_str()
                ->type_name("N")
                ->needs(perceptual),
            pixels_a_degree);
  validated(app.add_option("--timeline-frames", timeline_frames_, "write timeline.json, of these displayed frames")
                ->type_name("A..B"),
            dotted_range);
  validated(app.add_option("--timeline-lines", timeline_lines_, "write timeline.json, of these scan lines")
                ->type_name("A..B"),
            dotted_range);
}

run::Options RenderCommand::run_options() const {
  run::Options options{frames_, model_everything_, !no_reference_, host_figures_};
  const auto range = [](const std::string& text) {
    if (text.empty()) return run::NumberRange();
    const auto [first, last] = dotted_range_of(text);
    return run::NumberRange{first, last};
  };
  if (perceptual_) options.perceptual_pixels_per_degree = pixels_per_degree_;
  if (!timeline_frames_.empty() || !timeline_lines_.empty())
    options.timeline = run::TimelineRange{range(timeline_frames_), range(timeline_lines_)};
  return options;
}

std::string RenderCommand::output_directory() const {
  if (!out_.empty()) return out_;
  return fmt::format("out/{}_{}", std::filesystem::path(scene_).stem().string(),
                     std::filesystem::path(machine_).stem().string());
}

ExitCode RenderCommand::run() {
  if (require_psnr_ > 0.0 && no_reference_)
    throw InputError(Diagnostic{"--require-psnr", 0, "", "nothing is measured with --no-reference"});
  if (blame_ && no_reference_)
    throw InputError(Diagnostic{"--blame", 0, "", "nothing is compared with --no-reference"});
  if (perceptual_ && no_reference_)
    throw InputError(Diagnostic{"--perceptual", 0, "", "nothing is measured with --no-reference"});
  report::OutputDirectory::remove_on_signals();
  const run::Inputs inputs = run::read_inputs(machine_, scene_, overrides_);
  if (blame_) inputs.content->refuse_solids("--blame");
  report::OutputDirectory directory(output_directory());
  report::ResultWriter writer(directory);
  report::BlameContents blame;
  run::Result result = simulate(inputs, run_options(), writer, blame_ ? &blame : nullptr);
  const report::Contents contents =
      writer.write_reports({std::move(result), host_figures_, std::move(blame)}, run::resolved_machine_toml(inputs),
                           run::resolved_scene_toml(inputs));
  directory.commit();
  print_summary(contents.result, output_directory(), !timeline_frames_.empty() || !timeline_lines_.empty());
  const std::vector<std::string> missed = missed_requirements(contents.result, require_rate_, require_psnr_);
  for (const std::string& sentence : missed) std::fputs((sentence + '\n').c_str(), stdout);
  return missed.empty() ? ExitCode::kDone : ExitCode::kRequirementMissed;
}

std::vector<std::string> missed_requirements(const run::Result& result, double rate_hz, double psnr_db) {
  std::vector<std::string> missed;
  const run::Answer& answer = result.answer;
  const bool rate_met = answer.frame_rate_hz >= rate_hz || (answer.sustained && rate_hz <= answer.required_rate_hz);
  if (rate_hz > 0.0 && !answer.display_works)
    missed.push_back(fmt::format("Requirement missed: the machine does not show the scene at {:.6g} Hz: {}.", rate_hz,
                                 fmt::join(answer.limits, "; ")));
  else if (rate_hz > 0.0 && !rate_met)
    missed.push_back(
        fmt::format("Requirement missed: {:.6g} Hz is below the required {:.6g} Hz.", answer.frame_rate_hz, rate_hz));
  if (psnr_db <= 0.0) return missed;
  for (const run::FrameFigures& frame : result.frames)
    for (const reference::ErrorFigures& e : frame.errors) {
      if (e.reference != "ideal") continue;
      if (e.psnr_outline_db && *e.psnr_outline_db < psnr_db)
        missed.push_back(
            fmt::format("Requirement missed: frame {} has {:.6g} dB over the pixels that either picture covers, below "
                        "the required {:.6g} dB.",
                        frame.frame, *e.psnr_outline_db, psnr_db));
    }
  return missed;
}

}  // namespace rastertlm::cli
