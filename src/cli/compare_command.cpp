#include "src/cli/compare_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "src/cli/usage.h"

namespace rastertlm::cli {
namespace {

std::string map_name(const std::string& text) {
  return report::is_error_map_name(text) ? "" : fmt::format("'{}' is neither a .png nor an .exr", text);
}

bool same_file(const std::string& first, const std::string& second) {
  std::error_code ignored;
  return std::filesystem::equivalent(first, second, ignored);
}

}  // namespace

void CompareCommand::declare(CLI::App& app) {
  const auto validated = [](CLI::Option* option, std::string (*check)(const std::string&)) {
    option->check(CLI::Validator([check](std::string& text) { return check(text); }, "", ""));
  };
  app.add_option("A", first_.path, "picture: PNG, EXR, PPM, or what else OpenImageIO reads")->required();
  app.add_option("B", second_.path, "picture of the same size")->required();
  app.add_option("--layer-a", first_.layer,
                 "of A, an EXR, compare the channels NAME.R, NAME.G, NAME.B: a frame_*.exr has reference")
      ->type_name("NAME");
  app.add_option("--layer-b", second_.layer, "likewise of B")->type_name("NAME");
  validated(app.add_option("--pixels-per-degree", pixels_per_degree_, "how near the eye is, for FLIP, 1 to 1000")
                ->capture_default_str()
                ->type_name("N"),
            pixels_a_degree);
  validated(app.add_option("--error-map", error_map_,
                           "write the differences of pixels: .png, levels times 32; .exr, with FLIP and CIEDE2000")
                ->type_name("FILE"),
            map_name);
}

ExitCode CompareCommand::run() {
  for (const report::PictureFile& picture : {first_, second_})
    if (!error_map_.empty() && same_file(error_map_, picture.path))
      throw InputError(Diagnostic{"--error-map", 0, "", fmt::format("{} is one of the pictures", error_map_)});
  const report::Comparison comparison = report::compare_pictures(first_, second_, pixels_per_degree_);
  if (!error_map_.empty()) report::write_error_map(error_map_, comparison);
  std::fputs(report::comparison_text(comparison).c_str(), stdout);
  return ExitCode::kDone;
}

}  // namespace rastertlm::cli
