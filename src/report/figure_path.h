// A figure of report.json by its path, as sweeps name objectives:
//   answer.frame_rate_hz                 a key of an object
//   budgets[line_start].used             of a list, the element of that name (of errors: of that reference)
//   images[0].error.rmse_level           the element at that place, from 0
//   sum(memories[].total_bits)           over all elements; sum, mean, min or max
//   sum(logic[unit=pins].count)          over the elements whose key has that value
// A truth is 1 or 0; the PSNR of equal pictures, null in the file, is infinite. min and max leave out what is null; sum
// and mean are none where anything is.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "src/report/schema.h"

namespace rastertlm::report {

// What is wrong with a path, known before there is any report: a sentence that names the nearest figure; "" if nothing.
// Names of elements depend on the machine: see Figures::absent().
std::string figure_mistake(const std::string& text);

// Of a path without figure_mistake(): whether it is true or false, and whether it is measured against a reference.
bool is_truth_figure(const std::string& text);
bool is_error_figure(const std::string& text);

// The unit that the figure always has; "" where it has none, or where each element of the list names its own.
std::string figure_unit(const std::string& text);

class Figures {
 public:
  // Throws InputError, naming `file`, where the text is no report.json of this program.
  Figures(const std::string& json, const std::string& file);
  explicit Figures(const Contents& contents);
  Figures(Figures&&) noexcept;
  ~Figures();

  // The report.json that they are of.
  std::string json() const;
  // None where the report has no such figure, or null. The path is one without figure_mistake().
  std::optional<double> value(const std::string& text) const;
  // With the unit that stands beside the figure, where its elements name their own.
  std::string unit(const std::string& text) const;
  // Why the report cannot have the figure: no element of that name (the nearest is named), or it is text; "" where it
  // has it, were it null.
  std::string absent(const std::string& text) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace rastertlm::report
