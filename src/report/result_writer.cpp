#include "src/report/result_writer.h"

#include <optional>

#include "src/base/errors.h"
#include "src/image/image_files.h"
#include "src/report/error_image.h"
#include "src/report/exr_frame.h"
#include "src/report/file_names.h"
#include "src/report/frames_csv.h"
#include "src/report/json_report.h"
#include "src/report/run_page.h"
#include "src/report/text_file.h"
#include "src/report/text_report.h"
#include "src/report/timeline_json.h"

namespace rastertlm::report {

void ResultWriter::write_frame(const run::FramePixels& pixels,
                               const std::function<std::optional<LabelledPicture>()>& labels) {
  try {
    const std::optional<LabelledPicture> labelled = labels();
    const std::uint64_t frame = pixels.figures.frame;
    const frame::Frame& shown = pixels.shown;
    image::write_png(directory_.path(picture_name(frame)), shown.columns, shown.lines, shown.rgb);
    write_exr_frame(directory_.path(channels_name(frame)), shown, pixels.ideal, labelled ? &*labelled : nullptr);
    if (labelled) image::write_png(directory_.path(labelled->file), shown.columns, shown.lines, painted(*labelled));
    if (pixels.ideal != nullptr)
      image::write_png(directory_.path(error_name(frame)), shown.columns, shown.lines,
                       error_image(shown, *pixels.ideal));
  } catch (...) {
    failure_ = std::current_exception();
    throw;
  }
}

void ResultWriter::rethrow() const {
  if (failure_) std::rethrow_exception(failure_);
}

Contents ResultWriter::write_reports(const Contents& contents, const std::string& machine_toml,
                                     const std::string& scene_toml) {
  const std::string json = json_text(contents);
  Contents stored = read_json(json, kReportJson);
  write_text_file(directory_.path(kResolvedMachine), machine_toml);
  write_text_file(directory_.path(kResolvedScene), scene_toml);
  write_text_file(directory_.path(kFramesCsv), frames_csv(stored.result));
  write_text_file(directory_.path(kReportText), text_report(stored));
  write_text_file(directory_.path(kReportPage),
                  run_page(stored, [&](const std::string& name) { return directory_.path(name); }));
  if (contents.result.timeline) write_text_file(directory_.path(kTimeline), timeline_json(*contents.result.timeline));
  write_text_file(directory_.path(kReportJson), json);
  return stored;
}

void rebuild_reports(const std::string& directory, std::string& text) {
  const std::string file = directory + '/' + kReportJson;
  const std::optional<std::string> json = read_text_file(file);
  if (!json) throw InputError(Diagnostic{file, 0, "", "cannot be read: not the directory of a run"});
  const Contents contents = read_json(*json, file);
  text = text_report(contents);
  const auto bring_up_to_date = [&](const char* name, const std::string& wanted) {
    const std::string path = directory + '/' + name;
    if (read_text_file(path) != wanted) write_text_file(path, wanted);
  };
  bring_up_to_date(kReportText, text);
  bring_up_to_date(kFramesCsv, frames_csv(contents.result));
  bring_up_to_date(kReportPage, run_page(contents, [&](const std::string& name) { return directory + '/' + name; }));
}

}  // namespace rastertlm::report
