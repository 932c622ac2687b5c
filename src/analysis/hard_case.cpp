#include "src/analysis/hard_case.h"

#include <algorithm>
#include <filesystem>

#include "src/base/errors.h"
#include "src/config/document.h"
#include "src/config/header.h"
#include "src/config/reader.h"

namespace rastertlm::analysis {
namespace {

constexpr std::int64_t kSchema = 1;
enum class Kind : std::size_t {};  // an index into case_kinds()

// What every case's file says.
struct Head {
  std::int64_t schema = kSchema;
  std::string stresses;
  Kind kind{};

  void declare(parameter::Table& table) {
    std::vector<std::string> names;
    for (const NamedKind& known : case_kinds()) names.emplace_back(known.name);
    table.integer("schema", schema, {kSchema, kSchema}, {"", "Version of this file's form.", "", std::nullopt, true});
    table.text("stresses", stresses, {"", "What it stresses, one line.", "the printed table", std::nullopt, true});
    table.choice("kind", kind, std::move(names),
                 {"", "The core that is measured.", "the catalogue's figures", std::nullopt, true});
  }
};

// Of the document's kind; null where it names none that is known.
std::unique_ptr<CaseKind> kind_of(const config::Document& document) {
  const config::Entry* entry = document.find("kind");
  if (entry == nullptr) return nullptr;
  const auto* name = std::get_if<std::string>(&entry->value.value);
  for (const NamedKind& known : case_kinds())
    if (name != nullptr && *name == known.name) return known.make();
  return nullptr;
}

HardCase read(const std::string& file, Diagnostics& diagnostics) {
  HardCase hard_case;
  hard_case.name = std::filesystem::path(file).stem().string();
  config::Document document = config::Document::from_file(file);
  if (!config::check_schema(document, kSchema, diagnostics)) return hard_case;
  Head head;
  parameter::Table table = parameter::view(head);
  std::unique_ptr<CaseKind> kind = kind_of(document);
  // Which keys a case may have depends on its kind: of one that has none, they are not looked at.
  if (kind != nullptr)
    kind->declare(table);
  else
    document = document.only([&](const config::Entry& entry) { return table.find(entry.path) != nullptr; });
  config::read(document, table, {}, diagnostics);
  if (kind != nullptr) kind->check(file, diagnostics);
  hard_case.stresses = head.stresses;
  hard_case.kind = case_kinds()[static_cast<std::size_t>(head.kind)].name;
  hard_case.core = std::move(kind);
  return hard_case;
}

}  // namespace

HardCase read_hard_case(const std::string& file) {
  Diagnostics diagnostics;
  HardCase hard_case = read(file, diagnostics);
  diagnostics.throw_if_any();
  return hard_case;
}

std::vector<HardCase> read_hard_cases(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  if (files.empty()) throw InputError({folder, 0, "", "holds no case; a folder of .toml files is expected"});
  std::sort(files.begin(), files.end());
  Diagnostics diagnostics;
  std::vector<HardCase> cases;
  cases.reserve(files.size());
  for (const std::string& file : files) cases.push_back(read(file, diagnostics));
  diagnostics.throw_if_any();
  return cases;
}

}  // namespace rastertlm::analysis
