#include "src/cli/vectors_command.h"

#include <fmt/format.h>

#include <cstdio>

#include "src/analysis/vectors.h"
#include "src/cli/usage.h"
#include "src/report/file_names.h"
#include "src/report/number_text.h"
#include "src/report/output_directory.h"
#include "src/run/simulate.h"

namespace rastertlm::cli {
namespace {

void print_summary(const report::VectorsManifest& manifest, const std::string& directory) {
  using report::grouped;
  const report::VectorsTiming& t = manifest.timing;
  std::string text = fmt::format(
      "Frame {}{}: {} of {} processors show an object; words of {} are written.\n"
      "First and last pixel, in cycles of the pixel clock from the frame's first microinstruction: {} and {} at the "
      "decision unit's output, {} and {} at the RGB output.\n",
      manifest.frame, manifest.machine.fields == 1 ? std::string() : fmt::format(", field {}", manifest.field),
      grouped(manifest.processors_with_object),
      grouped(manifest.machine.boards * manifest.machine.processors_per_board), grouped(manifest.processors_listed),
      grouped(t.first_pixel_decision_cycle), grouped(t.last_pixel_decision_cycle), grouped(t.first_pixel_rgb_cycle),
      grouped(t.last_pixel_rgb_cycle));
  if (manifest.words_ahead > 0)
    text +=
        fmt::format("{} words belong to an update that the computation units had not finished: the picture is torn.\n",
                    grouped(manifest.words_ahead));
  if (manifest.machine.carry_clock != "clock1")
    text += "Warning: ep1.carry_clock = \"clock2\" loses carries: the words of pixels are not A x + B (y + 1) + C'.\n";
  text += fmt::format("{}/{}, {}: {} files and their digests\n", directory, report::kVectorsPage,
                      report::kVectorsManifest, grouped(manifest.files.size()));
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void VectorsCommand::declare(CLI::App& app) {
  const auto validated = [](CLI::Option* option, std::string (*check)(const std::string&)) {
    return option->check(CLI::Validator([check](std::string& text) { return check(text); }, "", ""));
  };
  app.add_option("MACHINE", machine_, "machine file")->capture_default_str();
  app.add_option("SCENE", scene_, "scene file")->capture_default_str();
  app.add_option("--set", overrides_,
                 "path=value: set a parameter of the machine, or of the scene; of a list's element\n"
                 "as object[0].radius=2")
      ->type_name("path=value")
      ->allow_extra_args(false);
  validated(app.add_option("--frame", frame_, "displayed frame, from 0")->capture_default_str()->type_name("N"),
            frame_number);
  validated(app.add_option("--field", field_, "of interlaced video: 0 even lines, 1 odd lines")
                ->capture_default_str()
                ->type_name("0|1"),
            field_number);
  validated(app.add_option("--out", out_, "directory of the files")->type_name("DIR"), not_empty)->required();
  validated(app.add_option("--processors", processors_, "write the words of these alone, both included")
                ->type_name("FROM-TO"),
            whole_range);
}

ExitCode VectorsCommand::run() {
  report::OutputDirectory::remove_on_signals();
  const run::Inputs inputs = run::read_inputs(machine_, scene_, overrides_);
  analysis::VectorsOptions options{frame_, field_, {}};
  if (!processors_.empty()) {
    const auto [first, last] = range_of(processors_);
    options.processors = analysis::ProcessorRange{first, last};
  }
  report::OutputDirectory directory(out_);
  const report::VectorsManifest manifest = analysis::write_vectors(inputs, options, directory);
  directory.commit();
  print_summary(manifest, out_);
  return ExitCode::kDone;
}

}  // namespace rastertlm::cli
