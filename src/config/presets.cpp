#include "src/config/presets.h"

namespace rastertlm::config {

const Presets& Presets::compiled_in() {
  static const Presets presets(compiled_preset_texts());
  return presets;
}

std::vector<std::string> Presets::tables() const {
  std::vector<std::string> result;
  for (const auto& [table, texts] : texts_) result.push_back(table);
  return result;
}

std::vector<std::string> Presets::names(const std::string& table) const {
  std::vector<std::string> result;
  if (const auto found = texts_.find(table); found != texts_.end())
    for (const auto& [name, text] : found->second) result.push_back(name);
  return result;
}

const std::string* Presets::find(const std::string& table, const std::string& name) const {
  const auto of_table = texts_.find(table);
  if (of_table == texts_.end()) return nullptr;
  const auto text = of_table->second.find(name);
  return text == of_table->second.end() ? nullptr : &text->second;
}

}  // namespace rastertlm::config
