#include "src/report/vectors_manifest.h"

#include <nlohmann/json.hpp>

#include "src/report/number_text.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "rastertlm";
constexpr const char* kKind = "vectors";

Json machine_json(const VectorsMachine& m) {
  return {{"columns", m.columns},
          {"lines", m.lines},
          {"fields", m.fields},
          {"boards", m.boards},
          {"processors_per_board", m.processors_per_board},
          {"topology", m.topology},
          {"word_bits", m.word_bits},
          {"slice_bits", m.slice_bits},
          {"slices", m.slices},
          {"carry_clock", m.carry_clock},
          {"normal_bits", m.normal_bits},
          {"material_bits", m.material_bits},
          {"edges", m.edges},
          {"edge_fraction_bits", m.edge_fraction_bits},
          {"depth_fraction_bits", m.depth_fraction_bits},
          {"normal_fraction_bits", m.normal_fraction_bits},
          {"near_depth", m.near_depth},
          {"far_depth", m.far_depth},
          {"background_depth", m.background_depth}};
}

Json shading_json(const VectorsShading& s) {
  return {{"arithmetic", s.arithmetic},
          {"lights", s.lights},
          {"materials", s.materials},
          {"normaliser_address_bits", s.normaliser_address_bits},
          {"normaliser_output_bits", s.normaliser_output_bits},
          {"dot_table_address_bits", s.dot_table_address_bits},
          {"dot_table_output_bits", s.dot_table_output_bits},
          {"index_bits", s.index_bits},
          {"level_bits", s.level_bits},
          {"specular_tables", s.specular_tables}};
}

Json timing_json(const VectorsTiming& t) {
  return {{"pixel_clock_ns", to_stored(t.pixel_clock_ns)},
          {"frame_cycles", t.frame_cycles},
          {"vertical_retrace_cycles", t.vertical_retrace_cycles},
          {"line_cycles", t.line_cycles},
          {"horizontal_blanking_cycles", t.horizontal_blanking_cycles},
          {"frame_start_cycles", t.frame_start_cycles},
          {"line_start_cycles", t.line_start_cycles},
          {"prenormalisation_cycles", t.prenormalisation_cycles},
          {"decision_cycles", t.decision_cycles},
          {"skew_cycles", t.skew_cycles},
          {"shading_cycles", t.shading_cycles},
          {"first_pixel_word_cycle", t.first_pixel_word_cycle},
          {"last_pixel_word_cycle", t.last_pixel_word_cycle},
          {"first_pixel_decision_cycle", t.first_pixel_decision_cycle},
          {"last_pixel_decision_cycle", t.last_pixel_decision_cycle},
          {"first_pixel_rgb_cycle", t.first_pixel_rgb_cycle},
          {"last_pixel_rgb_cycle", t.last_pixel_rgb_cycle}};
}

}  // namespace

std::string vectors_manifest_text(const VectorsManifest& manifest) {
  Json json = {{"schema", kVectorsSchema},
               {"program", kProgram},
               {"kind", kKind},
               {"platform", manifest.platform},
               {"config_digest", manifest.config_digest},
               {"scene_digest", manifest.scene_digest},
               {"frame", manifest.frame},
               {"field", manifest.field},
               {"animation_frame", manifest.animation_frame},
               {"words_ahead", manifest.words_ahead},
               {"machine", machine_json(manifest.machine)},
               {"shading", shading_json(manifest.shading)},
               {"timing", timing_json(manifest.timing)},
               {"first_processor", manifest.first_processor},
               {"last_processor", manifest.last_processor},
               {"processors_with_object", manifest.processors_with_object},
               {"processors_listed", manifest.processors_listed}};
  Json files = Json::array();
  for (const VectorsFile& file : manifest.files)
    files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  json["files"] = std::move(files);
  return json.dump(2) + '\n';
}

bool is_vectors_manifest(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  const auto is = [&](const char* key, const char* value) { return json.contains(key) && json[key] == value; };
  return json.is_object() && json.contains("schema") && json["schema"].is_number_integer() && is("program", kProgram) &&
         is("kind", kKind);
}

}  // namespace rastertlm::report
