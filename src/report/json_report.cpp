#include "src/report/json_report.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>

#include "src/base/errors.h"
#include "src/report/json_value.h"
#include "src/report/number_text.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kMetricDigits = 6;

class Writer {
 public:
  explicit Writer(Json& object) : object_(object) { object_ = Json::object(); }

  template <class T>
  void value(const char* key, const Field&, const T& what) {
    object_[key] = what;
  }
  void value(const char* key, const Field&, double what) { put(key, to_stored(what)); }
  void metric(const char* key, const Field&, double what) { put(key, to_significant(what, kMetricDigits)); }
  void metric(const char* key, const Field& field, const std::optional<double>& what) {
    if (what) return metric(key, field, *what);
    object_[key] = nullptr;
  }
  template <class T>
  void derived(const char* key, const Field&, const T& what) {
    object_[key] = what;
  }
  void texts(const char* key, const Field&, const std::vector<std::string>& strings) { object_[key] = strings; }
  void integers(const char* key, const Field&, const std::vector<std::int64_t>& numbers) { object_[key] = numbers; }
  template <class Inside>
  void object(const char* key, const char*, const Inside& inside) {
    Writer writer(object_[key]);
    inside(writer);
  }
  template <class T, class Inside>
  void list(const char* key, const char*, std::vector<T>& elements, const Inside& inside) {
    Json array = Json::array();
    for (T& element : elements) {
      Json json;
      Writer writer(json);
      inside(writer, element);
      array.push_back(std::move(json));
    }
    object_[key] = std::move(array);
  }
  template <class T, class Inside>
  void derived_object(const char* key, const char*, T* what, const Inside& inside) {
    object_[key] = nullptr;
    if (what == nullptr) return;
    Writer writer(object_[key]);
    inside(writer, *what);
  }
  template <class T, class Inside>
  void derived_list(const char* key, const char* description, std::vector<T>& elements, const Inside& inside) {
    list(key, description, elements, inside);
  }
  template <class Inside>
  void optional_object(const char* key, const char* description, bool there, const Inside& inside) {
    if (there) object(key, description, inside);
  }
  template <class Inside>
  void later_object(const char* key, const char* description, const Inside& inside) {
    object(key, description, inside);
  }

 private:
  void put(const char* key, double number) {
    if (std::isfinite(number))
      object_[key] = number;
    else
      object_[key] = nullptr;
  }
  Json& object_;
};

class Reader {
 public:
  Reader(const Json& object, std::string path, const std::string& file, Diagnostics& diagnostics)
      : object_(object), path_(std::move(path)), file_(file), diagnostics_(diagnostics) {}

  void value(const char* key, const Field& field, std::string& what) {
    if (is_of_later(key, field)) return;
    if (const Json* json = find(key, &Json::is_string, "text")) what = json->get<std::string>();
  }
  void value(const char* key, const Field& field, bool& what) {
    if (is_of_later(key, field)) return;
    if (const Json* json = find(key, &Json::is_boolean, "true or false")) what = json->get<bool>();
  }
  template <class T>
  void value(const char* key, const Field& field, T& what) requires std::is_integral_v<T> {
    if (is_of_later(key, field)) return;
    const bool is_signed = std::is_signed_v<T>;
    if (const Json* json = find(key, is_signed ? &Json::is_number_integer : &Json::is_number_unsigned, "an integer"))
      what = json->get<T>();
  }
  void value(const char* key, const Field& field, double& what) { metric(key, field, what); }
  void metric(const char* key, const Field& field, double& what) {
    if (!is_of_later(key, field)) number(key, what);
  }
  void metric(const char* key, const Field& field, std::optional<double>& what) {
    what.reset();
    if (is_of_later(key, field)) return;
    if (object_.contains(key) && object_[key].is_null()) return;
    double read = 0.0;
    if (number(key, read)) what = read;
  }
  template <class T>
  void derived(const char*, const Field&, const T&) {}
  void texts(const char* key, const Field&, std::vector<std::string>& strings) {
    const Json* json = find(key, &Json::is_array, "a list");
    if (json == nullptr) return;
    for (const Json& text : *json) {
      if (text.is_string())
        strings.push_back(text.get<std::string>());
      else
        wrong(key, "a list of text");
    }
  }
  void integers(const char* key, const Field&, std::vector<std::int64_t>& numbers) {
    const Json* json = find(key, &Json::is_array, "a list");
    if (json == nullptr) return;
    for (const Json& number : *json) {
      if (!number.is_number_integer()) return wrong(key, "a list of integers");
      numbers.push_back(number.get<std::int64_t>());
    }
  }
  template <class Inside>
  void object(const char* key, const char*, const Inside& inside) {
    const Json* json = find(key, &Json::is_object, "an object");
    if (json == nullptr) return;
    Reader reader(*json, path_ + key + '.', file_, diagnostics_);
    inside(reader);
  }
  template <class T, class Inside>
  void list(const char* key, const char*, std::vector<T>& elements, const Inside& inside) {
    const Json* json = find(key, &Json::is_array, "a list");
    if (json == nullptr) return;
    for (const Json& element : *json) {
      if (!element.is_object()) return wrong(key, "a list of objects");
      Reader reader(element, path_ + key + '[' + std::to_string(elements.size()) + "].", file_, diagnostics_);
      inside(reader, elements.emplace_back());
    }
  }
  template <class T, class Inside>
  void derived_object(const char*, const char*, T*, const Inside&) {}
  template <class T, class Inside>
  void derived_list(const char*, const char*, std::vector<T>&, const Inside&) {}
  template <class Inside>
  void optional_object(const char* key, const char* description, bool& there, const Inside& inside) {
    there = object_.contains(key);
    if (there) object(key, description, inside);
  }
  template <class Inside>
  void later_object(const char* key, const char* description, const Inside& inside) {
    if (object_.contains(key)) object(key, description, inside);
  }

 private:
  // The report was written before there was such a key.
  bool is_of_later(const char* key, const Field& field) const { return field.later && !object_.contains(key); }
  // A null number is one that is not finite.
  bool number(const char* key, double& what) {
    if (object_.contains(key) && object_[key].is_null()) {
      what = std::numeric_limits<double>::infinity();
      return true;
    }
    const Json* json = find(key, &Json::is_number, "a number");
    if (json != nullptr) what = json->get<double>();
    return json != nullptr;
  }
  const Json* find(const char* key, bool (Json::*is_right)() const noexcept, const char* kind) {
    if (!object_.contains(key)) {
      diagnostics_.add({file_, 0, path_ + key, "is missing"});
      return nullptr;
    }
    const Json& json = object_[key];
    if ((json.*is_right)()) return &json;
    wrong(key, kind);
    return nullptr;
  }
  void wrong(const char* key, const char* kind) {
    diagnostics_.add({file_, 0, path_ + key, std::string("is not ") + kind});
  }

  const Json& object_;
  std::string path_;
  const std::string& file_;
  Diagnostics& diagnostics_;
};

Json parse(const std::string& text) { return Json::parse(text, nullptr, false); }

}  // namespace

Json json_value(const Contents& contents) {
  Contents copy = contents;
  Json json;
  Writer writer(json);
  schema::visit(writer, copy);
  return json;
}

std::string text_of_json(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

std::string json_text(const Contents& contents) { return text_of_json(json_value(contents)); }

Contents read_json(const std::string& text, const std::string& file) {
  const Json json = parse(text);
  if (!is_report(text)) throw InputError(Diagnostic{file, 0, "", "is not a report.json of rastertlm"});
  if (json["schema"] != kSchema)
    throw InputError(
        Diagnostic{file, 0, "schema",
                   json["schema"].dump() + " is not the schema that this program reads, " + std::to_string(kSchema)});
  Diagnostics diagnostics;
  Contents contents;
  Reader reader(json, "", file, diagnostics);
  schema::visit(reader, contents);
  diagnostics.throw_if_any();
  return contents;
}

bool is_report(const std::string& text) {
  const Json json = parse(text);
  return json.is_object() && json.contains("schema") && json["schema"].is_number_integer() &&
         json.contains("platform") && json["platform"].is_string();
}

}  // namespace rastertlm::report
