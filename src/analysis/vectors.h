// Stimulus and expected response of one displayed frame, for an RTL test bench.
#pragma once

#include <cstdint>
#include <optional>

#include "src/analysis/processor_vectors.h"
#include "src/report/output_directory.h"
#include "src/report/vectors_manifest.h"
#include "src/run/simulate.h"

namespace rastertlm::analysis {

struct VectorsOptions {
  std::uint64_t frame = 0;                   // displayed frame, from 0
  std::uint64_t field = 0;                   // of it, where the video is interlaced: 0 even lines, 1 odd lines
  std::optional<ProcessorRange> processors;  // whose words are written; empty: of all
};

// Simulates to the frame and writes its vectors into the directory, which is then ready to be committed; gives what
// manifest.json holds. Once a process, for SystemC allows one simulation. Throws InputError where the machine cannot
// take the scene, where it has no such field or processors or too many of them hold an object, and where the tables
// change while the frame is shown; ModelError where a rule of the model is broken, or a cycle is not the closed form's;
// OutputError where a file cannot be written.
report::VectorsManifest write_vectors(const run::Inputs& inputs, const VectorsOptions& options,
                                      const report::OutputDirectory& directory);

}  // namespace rastertlm::analysis
