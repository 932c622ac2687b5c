// report.html of a sweep: the answer in one line; all points over two objectives that the reader chooses, with the
// front; filters by parameter; thumbnails; the table of all points; how objectives move with parameters.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/explore/front.h"
#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

inline constexpr std::size_t kMostOtherThumbnails = 100;       // beside the front's and the baseline's
inline constexpr std::size_t kMostThumbnailBytes = 3'600'000;  // of the page, which stays below 5 MB with 1,000 points

// Rows whose thumbnails a page has, in the table's order: the baseline, the front and, evenly spread over the others
// that have one, at most kMostOtherThumbnails; as far as kMostThumbnailBytes reach, in that order. Equal pictures are
// embedded once.
std::vector<std::size_t> rows_with_thumbnail(const SweepTable& table, const Front& front);

// One file that asks nothing of a network; the same bytes for the same table. Throws as find_front does.
std::string sweep_page(const SweepTable& table);

}  // namespace rastertlm::explore
