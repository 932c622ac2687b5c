// A document, presets and overrides into a checked configuration.
#pragma once

#include <vector>

#include "src/base/errors.h"
#include "src/config/document.h"
#include "src/config/origins.h"
#include "src/config/overrides.h"
#include "src/config/presets.h"
#include "src/parameter/table.h"

namespace rastertlm::config {

// Sets the parameters that `table` views; precedence: default < preset < document < overrides, of which the last wins.
// A text parameter whose path is "<table>.preset" names the preset of that table; "" is none. The first mention of a
// list in the document removes the default elements of that list.
//
// Everything that is wrong goes to `diagnostics`, the document's mistakes in the order of its lines, then those of
// overrides and presets, then required keys that nobody gives: wrong type, arity or range, a number that is not finite,
// an unknown key, preset or choice, a key that the chosen type does not have. Where there is any, the configuration is
// not to be used.
Origins read(const Document& document, parameter::Table& table, const std::vector<Override>& overrides,
             Diagnostics& diagnostics, const Presets& presets = Presets::compiled_in());

}  // namespace rastertlm::config
