#include "src/report/run_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/image/image_files.h"
#include "src/report/error_image.h"
#include "src/report/json_report.h"
#include "src/report/page_assets.h"
#include "src/report/page_document.h"
#include "src/report/text_file.h"
#include "src/report/text_report.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;

// Of embedded pictures together, after the first frame's: with everything else a page of 512 x 512 stays below 3 MB.
constexpr std::size_t kMostPictureBytes = 2'300'000;

struct ChosenFrame {
  std::size_t index = 0;  // of Result::frames
  const char* why = "";
};

std::vector<ChosenFrame> chosen_frames(const run::Result& result) {
  const std::vector<run::FrameFigures>& frames = result.frames;
  std::vector<ChosenFrame> chosen;
  const auto choose = [&](std::size_t index, const char* why) {
    const auto same = [&](const ChosenFrame& frame) { return frame.index == index; };
    if (std::none_of(chosen.begin(), chosen.end(), same)) chosen.push_back({index, why});
  };
  if (frames.empty()) return chosen;
  choose(0, "first");
  const auto distance = [](const run::FrameFigures& frame) {
    for (const reference::ErrorFigures& e : frame.errors)
      if (e.reference == "ideal" && e.psnr_outline_db) return -*e.psnr_outline_db;
    return -std::numeric_limits<double>::infinity();
  };
  const auto farthest = std::max_element(frames.begin(), frames.end(),
                                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (std::isfinite(distance(*farthest)))
    choose(static_cast<std::size_t>(farthest - frames.begin()), "farthest from the ideal");
  choose(frames.size() - 1, "last");
  return chosen;
}

// The exact frame of a channels' file as PNG; empty where it has none.
std::vector<std::uint8_t> exact_png(const std::string& path) {
  constexpr float kLevels = 255.0F;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  const image::Image image = image::read_image(path);
  std::vector<std::uint8_t> levels(3 * image.columns * image.lines);
  const char* names[] = {"reference.R", "reference.G", "reference.B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const image::ReadChannel* channel = image.find(names[c]);
    if (channel == nullptr || channel->f32.size() != image.columns * image.lines) return {};
    for (std::size_t i = 0; i < channel->f32.size(); ++i)
      levels[3 * i + c] =
          static_cast<std::uint8_t>(std::clamp(std::floor(channel->f32[i] * kLevels + 0.5F), 0.0F, kLevels));
  }
  return image::encode_png(image.columns, image.lines, levels);
}

Json pictures_of(const run::Result& result, const FileOfRun& file) {
  Json pictures = Json::array();
  std::size_t bytes = 0;
  for (const ChosenFrame& frame : chosen_frames(result)) {
    const std::uint64_t number = result.frames.at(frame.index).frame;
    const std::optional<std::string> shown = read_text_file(file(picture_name(number)));
    if (!shown) continue;
    Json picture{{"frame", number}, {"why", frame.why}, {"shown", base64(*shown)}};
    if (const std::vector<std::uint8_t> exact = exact_png(file(channels_name(number))); !exact.empty())
      picture["exact"] = base64(exact);
    if (const std::optional<std::string> blame = read_text_file(file(blame_name(number))))
      picture["blame"] = base64(*blame);
    const std::size_t size = picture.dump().size();
    if (!pictures.empty() && bytes + size > kMostPictureBytes) continue;
    bytes += size;
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace

std::string run_page(const Contents& contents, const FileOfRun& file) {
  const run::Result& result = contents.result;
  const std::string answer = answer_sentence(result);
  Json data{{"report", Json::parse(json_text(contents))},
            {"amplification", kErrorAmplification},
            {"pictures", pictures_of(result, file)},
            {"machine", read_text_file(file(kResolvedMachine)).value_or("")},
            {"scene", read_text_file(file(kResolvedScene)).value_or("")}};
  data["left_out"] = result.frames.size() - std::min(result.frames.size(), data["pictures"].size());
  return page_text({"rastertlm: " + result.platform + ": " + answer,
                    "rastertlm: machine " + result.platform,
                    answer,
                    text_report(contents),
                    data.dump(-1, ' ', false, Json::error_handler_t::replace),
                    {kPicturesScript, kRunScript}});
}

}  // namespace rastertlm::report
