#include "src/analysis/vectors.h"

#include <fmt/format.h>

#include <memory>

#include "modules/object_processor/microprogram.h"
#include "modules/set_up/word_format.h"
#include "platforms/imogene/imogene.h"
#include "src/analysis/frame_recorder.h"
#include "src/analysis/microprogram_vectors.h"
#include "src/analysis/pixel_vectors.h"
#include "src/analysis/table_vectors.h"
#include "src/analysis/vector_files.h"
#include "src/analysis/vectors_page.h"
#include "src/base/errors.h"
#include "src/config/writer.h"
#include "src/report/file_names.h"
#include "src/report/text_file.h"
#include "src/run/inputs.h"

namespace rastertlm::analysis {
namespace {

std::uint64_t count(std::int64_t value) { return static_cast<std::uint64_t>(value); }

report::VectorsTiming timing_of(const imogene::Imogene& platform) {
  const imogene::Machine& machine = platform.machine();
  const video::Timing& video = platform.timing();
  report::VectorsTiming t;
  t.pixel_clock_ns = video.clock.period_ns();
  t.frame_cycles = video.frame.count();
  t.vertical_retrace_cycles = video.vertical_retrace.count();
  t.line_cycles = video.line.count();
  t.horizontal_blanking_cycles = video.horizontal_blanking.count();
  const imogene::BoardNeeds needs = imogene::board_needs(machine);
  t.frame_start_cycles = object_processor::frame_start_cycles().count();  // of what the microprogram lists
  t.line_start_cycles = needs.line_start.count();
  t.prenormalisation_cycles = count(machine.object_processor.prenormalisation_cycles);
  t.decision_cycles = platform.decision_latency().count();
  t.skew_cycles = needs.skew.count();
  t.shading_cycles = machine.shading.total_latency().count();
  const std::uint64_t lines = count(machine.video.lines) / video.fields;
  const std::uint64_t to_last = (video.line * (lines - 1) + Cycles(count(machine.video.columns) - 1)).count();
  t.first_pixel_word_cycle = video.first_pixel(0).count();
  t.first_pixel_decision_cycle = t.first_pixel_word_cycle + t.prenormalisation_cycles + t.decision_cycles;
  t.first_pixel_rgb_cycle = t.first_pixel_decision_cycle + t.shading_cycles;
  t.last_pixel_word_cycle = t.first_pixel_word_cycle + to_last;
  t.last_pixel_decision_cycle = t.first_pixel_decision_cycle + to_last;
  t.last_pixel_rgb_cycle = t.first_pixel_rgb_cycle + to_last;
  return t;
}

// What the simulation did must be what the closed forms say.
void check_cycles(const report::VectorsTiming& t, const video::Timing& video, std::uint64_t columns,
                  const FrameRecorder& recorder) {
  const auto check = [&](const char* what, std::uint64_t picoseconds, std::uint64_t expected) {
    const std::uint64_t simulated = video.clock.cycles_round(static_cast<double>(picoseconds) * 1e-12).count();
    if (simulated != expected)
      throw ModelError("vectors", simulated, fmt::format("{}: cycle {} was expected", what, expected));
  };
  const FrameRecorder::Passage& decided = recorder.decided_passage();
  const FrameRecorder::Passage& shaded = recorder.shaded_passage();
  const std::uint64_t to_last_column = columns - 1;
  check("first pixel at the decision unit's output", decided.first_line_ps, t.first_pixel_decision_cycle);
  check("last line at the decision unit's output", decided.last_line_ps, t.last_pixel_decision_cycle - to_last_column);
  check("first pixel at the RGB output", shaded.first_line_ps, t.first_pixel_rgb_cycle);
  check("last line at the RGB output", shaded.last_line_ps, t.last_pixel_rgb_cycle - to_last_column);
}

report::VectorsMachine machine_of(const imogene::Machine& machine, const BinaryPoints& points) {
  const object_processor::ObjectProcessorParameters& p = machine.object_processor;
  const set_up::WordFormat format{static_cast<int>(p.word_bits), static_cast<std::size_t>(machine.video.columns),
                                  static_cast<std::size_t>(machine.video.lines), p.edges};
  report::VectorsMachine m;
  m.columns = count(machine.video.columns);
  m.lines = count(machine.video.lines);
  m.fields = machine.video.interlaced ? 2 : 1;
  m.boards = count(machine.host.computation_units);
  m.processors_per_board = count(machine.host.processors_per_unit);
  m.topology = machine.decision_unit.topology == decision_unit::Topology::tree ? "tree" : "pipeline";
  m.word_bits = count(p.word_bits);
  m.slice_bits = count(p.slice_bits);
  m.slices = p.slices();
  m.carry_clock = p.carry_clock == object_processor::CarryClock::clock1 ? "clock1" : "clock2";
  m.normal_bits = count(p.normal_bits);
  m.material_bits = machine.material_bits();
  m.edges = points.scaled ? "scaled" : "snapped";
  m.edge_fraction_bits = points.scaled ? -1 : points.edge;
  m.depth_fraction_bits = points.depth;
  m.normal_fraction_bits = points.normal;
  m.near_depth = static_cast<std::uint64_t>(set_up::near_depth(format));
  m.far_depth = static_cast<std::uint64_t>(set_up::far_depth(format));
  m.background_depth = low_mask(static_cast<unsigned>(p.word_bits));
  return m;
}

report::VectorsShading shading_of(const shading::ShadingParameters& p) {
  report::VectorsShading s;
  s.arithmetic = p.arithmetic == shading::Arithmetic::literal ? "literal" : "centred";
  s.lights = count(p.lights);
  s.materials = count(p.materials);
  s.normaliser_address_bits = count(p.normaliser_address_bits);
  s.normaliser_output_bits = count(p.normaliser_output_bits);
  s.dot_table_address_bits = count(p.dot_table_address_bits);
  s.dot_table_output_bits = count(p.dot_table_output_bits);
  s.index_bits = count(p.index_bits);
  s.level_bits = count(p.level_bits);
  s.specular_tables = count(p.specular_tables);
  return s;
}

void check_field(std::uint64_t field, bool interlaced) {
  if (field > 0 && !interlaced)
    throw InputError(Diagnostic{"--field", 0, "", "a frame of this machine has no fields: video.interlaced is false"});
}

// Their times are those of triangles that wait for nothing.
void check_alignment(const imogene::Machine& machine) {
  if (imogene::quadric_delay(machine) > Cycles(0))
    throw InputError({"", 0, "quadric_processor.alignment",
                      "vectors knows no triangles that wait for quadrics; quadric_processor.per_unit = 0 or "
                      "\"early_start\" would do"});
}

ProcessorRange range_of(const std::optional<ProcessorRange>& asked, std::uint64_t processors) {
  if (!asked) return {0, processors - 1};
  if (asked->last >= processors)
    throw InputError(Diagnostic{
        "--processors", 0, "",
        fmt::format("there is no processor {}: the machine has {}, numbered from 0", asked->last, processors)});
  return *asked;
}

// Everything of the frame but the manifest itself, while the machine still holds it.
report::VectorsManifest write_frame(imogene::Imogene& platform, const run::Inputs& inputs, const ProcessorRange& range,
                                    const FrameRecorder& recorder, const imogene::ShownFrame& shown,
                                    const frame::Frame& pixels, VectorFiles& files) {
  const imogene::Machine& machine = platform.machine();
  const auto word_bits = static_cast<unsigned>(machine.object_processor.word_bits);
  const geometry::SnapGrid& grid = shown.guarded ? platform.grids().guarded : platform.grids().on_screen;
  const BinaryPoints points = binary_points(word_bits, pixels.columns, pixels.lines, grid.fraction_bits,
                                            machine.object_processor.edges == object_processor::EdgeForm::scaled);
  report::VectorsManifest manifest;
  manifest.platform = "imogene";
  imogene::Machine resolved = machine;
  parameter::Table table = parameter::view(resolved);
  manifest.config_digest = config::digest(table);
  manifest.scene_digest = inputs.content->scene->digest;
  manifest.frame = shown.frame;
  manifest.field = shown.field;
  manifest.animation_frame = shown.animation_frame;
  manifest.words_ahead = shown.words_ahead;
  manifest.machine = machine_of(machine, points);
  manifest.shading = shading_of(machine.shading);
  manifest.timing = timing_of(platform);
  manifest.first_processor = range.first;
  manifest.last_processor = range.last;
  check_cycles(manifest.timing, platform.timing(), pixels.columns, recorder);
  if (!tables_shade(platform.shader(), recorder.lines(), pixels))
    throw InputError({"", 0, "loader.when",
                      fmt::format("the shading tables change while frame {} is shown, so that no one content of them "
                                  "gives its levels; choose a loader that is done in time",
                                  shown.frame)});

  const ProcessorCounts counts = write_processors(platform.boards(), word_bits, points, range, files);
  manifest.processors_with_object = counts.with_object;
  manifest.processors_listed = counts.listed;
  write_microprogram(machine.object_processor.slices(), files);
  write_tables(platform.shader(), static_cast<unsigned>(machine.object_processor.normal_bits), files);
  write_decision(recorder.lines(), static_cast<std::uint32_t>(manifest.machine.background_depth), files);
  write_rgb(pixels, shown.field, platform.timing().fields, files);
  files.write(report::kResolvedMachine, run::resolved_machine_toml(inputs));
  files.write(report::kResolvedScene, run::resolved_scene_toml(inputs));
  files.write(report::kVectorsPage, vectors_page(manifest));
  manifest.files = files.list();
  return manifest;
}

}  // namespace

report::VectorsManifest write_vectors(const run::Inputs& inputs, const VectorsOptions& options,
                                      const report::OutputDirectory& directory) {
  const imogene::Machine& machine = inputs.content->object_machine("vectors");
  inputs.content->refuse_solids("vectors");
  const ProcessorRange range = range_of(options.processors, machine.triangle_processors());
  check_alignment(machine);
  check_field(options.field, machine.video.interlaced);
  FrameRecorder recorder(options.frame, {options.field, machine.video.interlaced ? 2U : 1U},
                         static_cast<std::size_t>(machine.video.lines));
  VectorFiles files(directory);
  report::VectorsManifest manifest;
  std::unique_ptr<imogene::Imogene> platform;
  const auto show = [&](const imogene::ShownFrame& shown, const frame::Frame& pixels) {
    if (shown.frame == options.frame && shown.field == options.field)
      manifest = write_frame(*platform, inputs, range, recorder, shown, pixels, files);
  };
  imogene::Options simulated;
  simulated.frames = options.frame + 1;
  simulated.decided = recorder.decided();
  simulated.shaded = recorder.shaded();
  try {
    platform = std::make_unique<imogene::Imogene>(machine, *inputs.content->scene, simulated, show);
    platform->run();
  } catch (const InputError& error) {
    throw inputs.content->located(error);
  }
  report::write_text_file(directory.path(report::kVectorsManifest), report::vectors_manifest_text(manifest));
  return manifest;
}

}  // namespace rastertlm::analysis
