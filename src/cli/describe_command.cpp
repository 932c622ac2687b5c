#include "src/cli/describe_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "src/base/shading_method.h"
#include "src/cli/usage.h"
#include "src/config/parameter_list.h"
#include "src/config/presets.h"
#include "src/report/statistics.h"
#include "src/report/text_table.h"
#include "src/run/simulate.h"

namespace rastertlm::cli {
namespace {

using report::TextTable;

// What a TOML text says about itself: the first sentence of the comment that it begins with. It ends where a full stop
// is followed by a capital, for abbreviations have full stops too.
std::string first_comment(const std::string& text) {
  std::string comment;
  for (std::size_t begin = 0; begin < text.size() && text[begin] == '#';) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::size_t start = std::min(text.find_first_not_of("# ", begin), end);
    if (start < end) comment += (comment.empty() ? "" : " ") + text.substr(start, end - start);
    begin = end + 1;
  }
  for (std::size_t stop = comment.find(". "); stop != std::string::npos; stop = comment.find(". ", stop + 1))
    if (stop + 2 < comment.size() && comment[stop + 2] >= 'A' && comment[stop + 2] <= 'Z')
      return comment.substr(0, stop);
  return comment;
}

// The files of a folder below the working directory.
std::string files_text(const std::string& folder, const std::string& what) {
  std::error_code error;
  std::vector<std::string> paths;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".toml") paths.push_back(entry->path().string());
  if (paths.empty()) return fmt::format("no {} files in {} (run in the folder of the sources)\n", what, folder);
  std::sort(paths.begin(), paths.end());
  TextTable table({{what}, {"what it is"}});
  for (const std::string& path : paths) {
    std::ifstream file(path);
    table.row({path, first_comment(std::string(std::istreambuf_iterator<char>(file), {}))});
  }
  return table.text();
}

std::string machines_text() { return files_text("configs/machines", "machine"); }
std::string scenes_text() { return files_text("configs/scenes", "scene"); }

std::string sweeps_text() { return files_text("configs/sweeps", "sweep"); }

std::string presets_text() {
  const config::Presets& presets = config::Presets::compiled_in();
  TextTable rows({{"preset"}, {"what it is"}});
  for (const std::string& table : presets.tables())
    for (const std::string& name : presets.names(table))
      rows.row({fmt::format("{}.preset = \"{}\"", table, name), first_comment(*presets.find(table, name))});
  return rows.text();
}

std::string parameters_text() {
  std::string text;
  for (const auto& [name, table] : run::described_tables()) {
    if (!text.empty()) text += '\n';
    text += name + '\n' + std::string(name.size(), '=') + '\n' + config::parameter_list_text(table);
  }
  return text;
}

std::string methods_text() {
  TextTable table(
      {{"method"}, {"inside a triangle"}, {"lit at"}, {"highlight test"}, {"subdivides"}, {"platform"}, {"paper"}});
  for (const ShadingMethodTraits& m : kShadingMethods)
    table.row({std::string(m.name), std::string(m.across), std::string(m.lit_at), m.highlight_test ? "yes" : "no",
               m.subdivides ? "yes" : "no", std::string(m.platform), std::string(m.source)});
  return table.text();
}

struct Topic {
  const char* name;
  const char* meaning;
  std::string (*text)();
};

constexpr std::array<Topic, 7> kTopics{{
    {"machines", "machine files in configs/machines", machines_text},
    {"scenes", "scene files in configs/scenes", scenes_text},
    {"sweeps", "sweep files in configs/sweeps", sweeps_text},
    {"presets", "named sets of values, compiled into the program", presets_text},
    {"parameters", "every key of machine and scene files", parameters_text},
    {"methods", "shading methods, and the platform that offers each", methods_text},
    {"statistics", "every figure of report.json", report::statistics_text},
}};

}  // namespace

void DescribeCommand::declare(CLI::App& app) {
  app.add_option("TOPIC", topic_, "machines, scenes, sweeps, presets, parameters, methods or statistics");
}

ExitCode DescribeCommand::run() {
  std::vector<std::string> names;
  TextTable overview({{"topic"}, {"what it lists"}});
  for (const Topic& topic : kTopics) {
    if (topic_ == topic.name) {
      std::fputs(topic.text().c_str(), stdout);
      return ExitCode::kDone;
    }
    names.emplace_back(topic.name);
    overview.row({topic.name, topic.meaning});
  }
  if (!topic_.empty()) throw InputError(Diagnostic{"", 0, "", unknown_word("topic", topic_, names)});
  std::fputs(overview.text().c_str(), stdout);
  return ExitCode::kDone;
}

}  // namespace rastertlm::cli
