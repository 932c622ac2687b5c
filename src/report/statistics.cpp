#include "src/report/statistics.h"

#include <optional>
#include <string_view>
#include <type_traits>

#include "src/report/schema.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

using parameter::StatisticValue;

template <class T>
constexpr StatisticValue type_of() {
  if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::optional<bool>>) return StatisticValue::truth;
  if constexpr (std::is_convertible_v<T, std::string_view> || std::is_same_v<T, std::optional<std::string>>)
    return StatisticValue::text;
  return StatisticValue::number;
}

class Describer {
 public:
  Describer(std::string path, std::vector<parameter::Statistic>& found) : path_(std::move(path)), found_(found) {}

  template <class T>
  void value(const char* key, const Field& field, const T&) {
    add(key, field, type_of<T>());
  }
  template <class T>
  void metric(const char* key, const Field& field, const T&) {
    add(key, field);
  }
  template <class T>
  void derived(const char* key, const Field& field, const T&) {
    add(key, field, type_of<T>());
  }
  void texts(const char* key, const Field& field, const std::vector<std::string>&) {
    add(std::string(key) + "[]", field, StatisticValue::text);
  }
  void integers(const char* key, const Field& field, const std::vector<std::int64_t>&) {
    add(std::string(key) + "[]", field);
  }
  template <class Inside>
  void object(const char* key, const char*, const Inside& inside) {
    Describer describer(path_ + key + '.', found_);
    inside(describer);
  }
  template <class T, class Inside>
  void list(const char* key, const char*, std::vector<T>&, const Inside& inside) {
    T element{};
    Describer describer(path_ + key + "[].", found_);
    inside(describer, element);
  }
  // What follows from others of the file is described there.
  template <class T, class Inside>
  void derived_object(const char* key, const char* description, T*, const Inside& inside) {
    add(key, {"", parameter::StatisticKind::formula, description}, StatisticValue::table);
    T element{};
    Describer describer(path_ + key + '.', found_);
    inside(describer, element);
  }
  template <class T, class Inside>
  void derived_list(const char* key, const char* description, std::vector<T>& elements, const Inside& inside) {
    list(key, description, elements, inside);
  }
  template <class Inside>
  void later_object(const char* key, const char* description, const Inside& inside) {
    object(key, description, inside);
  }
  template <class Inside>
  void optional_object(const char* key, const char* description, bool, const Inside& inside) {
    object(key, description, inside);
  }

 private:
  void add(const std::string& key, const Field& field, StatisticValue value = StatisticValue::number) {
    found_.push_back({path_ + key, field.unit, field.kind, field.description, value});
  }
  std::string path_;
  std::vector<parameter::Statistic>& found_;
};

const char* kind_text(parameter::StatisticKind kind) {
  switch (kind) {
    case parameter::StatisticKind::count:
      return "count";
    case parameter::StatisticKind::formula:
      return "formula";
    case parameter::StatisticKind::setting:
      return "setting";
  }
  return "";
}

}  // namespace

std::vector<parameter::Statistic> statistics() {
  std::vector<parameter::Statistic> found;
  Contents contents;
  Describer describer("", found);
  schema::visit(describer, contents);
  return found;
}

std::string statistics_text() {
  TextTable table({{"name in report.json"}, {"unit"}, {"kind"}, {"meaning"}});
  for (const parameter::Statistic& s : statistics())
    table.row({s.name, s.unit.empty() ? "-" : s.unit, kind_text(s.kind), s.description});
  return table.text();
}

}  // namespace rastertlm::report
