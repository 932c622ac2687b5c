// What a sweep found, for a reader: the answer in one line, then the objectives, the front, the baseline, what the
// front beats, how objectives move with parameters, and what one step does.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "src/explore/front.h"
#include "src/explore/sensitivity.h"
#include "src/explore/sweep_table.h"
#include "src/explore/what_if.h"

namespace rastertlm::explore {

struct TextOptions {
  std::optional<std::size_t> from;  // start_of_steps' choice
  double tolerance = 0.0;           // find_what_if's
  std::size_t most_rows = 40;       // of a table; the rest is counted
};

// The point that answers the sweep's question, in the baseline's case where axes are given: the best in the first
// objective of those that were compared, of equal ones the best in the second, and so on, then the first. It is on the
// front. None where no point was compared.
std::optional<std::size_t> answer_row(const SweepTable& table, const Front& front);

// The row from which a step is taken: `chosen`, else the baseline if it is done, else the answer, where there is one.
std::optional<std::size_t> start_of_steps(const SweepTable& table, const Front& front,
                                          const std::optional<std::size_t>& chosen);

// All sections. Throws as find_front, find_sensitivity and find_what_if do.
std::string sweep_text(const SweepTable& table, const TextOptions& options = {});

// Its sections, each with its heading; the answer has none.
std::string answer_section(const SweepTable& table, const Front& front);
std::string objectives_section(const SweepTable& table, const Front& front);
std::string front_section(const SweepTable& table, const Front& front, std::size_t most_rows);
std::string beaten_section(const SweepTable& table, const Front& front, std::size_t most_rows);
std::string failures_section(const SweepTable& table, std::size_t most_rows);
std::string sensitivity_section(const SweepTable& table, const std::vector<ObjectiveSensitivity>& sensitivity);
std::string what_if_section(const SweepTable& table, const WhatIf& what_if, double tolerance);

}  // namespace rastertlm::explore
