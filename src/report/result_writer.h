// Everything that a run leaves behind, written as it comes.
#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "src/report/labelled_picture.h"
#include "src/report/output_directory.h"
#include "src/report/schema.h"
#include "src/run/result.h"

namespace rastertlm::report {

class ResultWriter {
 public:
  explicit ResultWriter(const OutputDirectory& directory) : directory_(directory) {}

  // The files of a frame: picture, channels, and error where there is a reference. What it throws is kept as well, for
  // a simulation kernel between here and who asked for the frames may turn it into an error of its own.
  void write_frame(const run::FramePixels& pixels) {
    write_frame(pixels, [] { return std::nullopt; });
  }
  // `labels`, if it gives any, become a channel and a picture more; it may throw likewise.
  void write_frame(const run::FramePixels& pixels, const std::function<std::optional<LabelledPicture>()>& labels);
  // Throws what write_frame() threw, if anything.
  void rethrow() const;

  // The reports and the resolved configuration. Gives what report.json holds: the reports' figures.
  Contents write_reports(const Contents& contents, const std::string& machine_toml, const std::string& scene_toml);

 private:
  const OutputDirectory& directory_;
  std::exception_ptr failure_;
};

// report.txt, frames.csv and report.html of an earlier run made again from its report.json and its pictures; gives the
// text. A file that has its bytes already is not touched. Throws InputError where there is no report.json of ours, or a
// picture cannot be read; OutputError where a file cannot be written: then `text` is set all the same.
void rebuild_reports(const std::string& directory, std::string& text);

}  // namespace rastertlm::report
