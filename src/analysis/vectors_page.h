// The README.md beside the vectors: tells an RTL designer what each file is and how to use it, with this machine's
// widths and cycles.
#pragma once

#include <string>

#include "src/report/vectors_manifest.h"

namespace rastertlm::analysis {

// The manifest's files are not looked at.
std::string vectors_page(const report::VectorsManifest& manifest);

}  // namespace rastertlm::analysis
