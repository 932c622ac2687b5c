// manifest.json, schema 1: what the vectors of a frame belong to, what a test bench needs to know of the machine, and
// every file with its digest. No key is used twice, so that a program without a JSON reader finds each by its name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rastertlm::report {

inline constexpr std::int64_t kVectorsSchema = 1;

// Cycles of the pixel clock. Those of pixels count from the frame's first microinstruction, which is cycle 0: the first
// step of the frame-start microprogram in processor 0, when the vertical retrace begins.
struct VectorsTiming {
  double pixel_clock_ns = 0.0;
  std::uint64_t frame_cycles = 0;
  std::uint64_t vertical_retrace_cycles = 0;     // at the start of a frame
  std::uint64_t line_cycles = 0;                 // horizontal blanking and pixels
  std::uint64_t horizontal_blanking_cycles = 0;  // at the start of a line
  std::uint64_t frame_start_cycles = 0;          // steps of the microprograms; the line start runs once a line
                                                 // that it goes on by
  std::uint64_t line_start_cycles = 0;
  std::uint64_t prenormalisation_cycles = 0;
  std::uint64_t decision_cycles = 0;
  std::uint64_t skew_cycles = 0;  // by which the last processor works later than processor 0
  std::uint64_t shading_cycles = 0;

  std::uint64_t first_pixel_word_cycle = 0;  // in which the elementary processors of processor 0 show the first pixel
  std::uint64_t last_pixel_word_cycle = 0;
  std::uint64_t first_pixel_decision_cycle = 0;  // at the decision unit's output
  std::uint64_t last_pixel_decision_cycle = 0;
  std::uint64_t first_pixel_rgb_cycle = 0;  // at the shading processor's output
  std::uint64_t last_pixel_rgb_cycle = 0;
};

struct VectorsMachine {
  std::uint64_t columns = 0;
  std::uint64_t lines = 0;   // of a displayed frame
  std::uint64_t fields = 1;  // of a displayed frame: 2 where it is interlaced
  std::uint64_t boards = 0;
  std::uint64_t processors_per_board = 0;
  std::string topology;
  std::uint64_t word_bits = 0;
  std::uint64_t slice_bits = 0;
  std::uint64_t slices = 0;
  std::string carry_clock;
  std::uint64_t normal_bits = 0;
  std::uint64_t material_bits = 0;
  std::string edges;                    // how the host fits them
  std::int64_t edge_fraction_bits = 0;  // -1: every edge has a scale of its own
  std::int64_t depth_fraction_bits = 0;
  std::int64_t normal_fraction_bits = 0;
  std::uint64_t near_depth = 0;  // words
  std::uint64_t far_depth = 0;
  std::uint64_t background_depth = 0;
};

struct VectorsShading {
  std::string arithmetic;
  std::uint64_t lights = 0;
  std::uint64_t materials = 0;
  std::uint64_t normaliser_address_bits = 0;
  std::uint64_t normaliser_output_bits = 0;
  std::uint64_t dot_table_address_bits = 0;
  std::uint64_t dot_table_output_bits = 0;
  std::uint64_t index_bits = 0;
  std::uint64_t level_bits = 0;
  std::uint64_t specular_tables = 0;
};

struct VectorsFile {
  std::string name;
  std::uint64_t bytes = 0;
  std::string sha256;
};

struct VectorsManifest {
  std::string platform;
  std::string config_digest;
  std::string scene_digest;
  std::uint64_t frame = 0;
  std::uint64_t field = 0;           // of it, where it has two: 0 even lines, 1 odd lines
  std::int64_t animation_frame = 0;  // the pose that was last shown whole
  std::uint64_t words_ahead = 0;     // of an update that the units have not finished: the objects are torn
  VectorsMachine machine;
  VectorsShading shading;
  VectorsTiming timing;
  std::uint64_t first_processor = 0;  // of those that were asked for
  std::uint64_t last_processor = 0;
  std::uint64_t processors_with_object = 0;  // of the whole machine
  std::uint64_t processors_listed = 0;       // of them, those that have files
  std::vector<VectorsFile> files;            // all but the manifest itself
};

// The same bytes for the same contents.
std::string vectors_manifest_text(const VectorsManifest& manifest);

// Whether the text is a manifest.json of this program, of any schema.
bool is_vectors_manifest(const std::string& text);

}  // namespace rastertlm::report
