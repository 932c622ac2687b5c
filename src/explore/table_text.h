// A sweep's table for a reader, and for other programs.
#pragma once

#include <cstddef>
#include <string>

#include "src/explore/front.h"
#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

// Name, question, how many points are done, and the first `most_rows` of them.
std::string table_text(const SweepTable& table, std::size_t most_rows);

// A line a point, after a line of names: number, state, allowed, baseline, front (1 or 0), beaten_by (a point of the
// front), the axes, the objectives, the further figures, the digest of the resolved machine, the error. What is missing
// is empty, as front is of points that were not compared. RFC 4180, with line feeds alone.
std::string table_csv(const SweepTable& table, const Front& front);

// A figure with six significant digits; "-" where there is none.
std::string figure_text(const std::optional<double>& figure);
// A cell of CSV, in quotes where it needs them.
std::string csv_cell(const std::string& text);

}  // namespace rastertlm::explore
