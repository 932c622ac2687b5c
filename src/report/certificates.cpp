#include "src/report/certificates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::report {
namespace {

using Json = nlohmann::ordered_json;

std::string figure(double value) { return std::isinf(value) ? "none" : fmt::format("{:.4g}", value); }

// How much of the proof was seen.
std::string ratio(const Certificate& c) {
  if (c.proved == 0.0) return c.holds() ? "exact" : "BROKEN";
  if (std::isinf(c.proved)) return "-";
  return c.holds() ? fmt::format("{:.3g} %", 100 * c.seen / c.proved) : "BROKEN";
}

Json number(double value) { return std::isfinite(value) ? Json(to_stored(value)) : Json(nullptr); }

Json step_json(const Certificate& c) {
  return {{"step", c.step},           {"decides", c.decides}, {"range", c.range},           {"proof", name_of(c.proof)},
          {"source", c.source},       {"unit", c.unit},       {"proved", number(c.proved)}, {"seen", number(c.seen)},
          {"inputs_tried", c.inputs}, {"holds", c.holds()}};
}

Json bits_json(const GuardBits& bits, const std::vector<std::string>& quantities) {
  Json shares = Json::array();
  for (std::size_t i = 0; i < bits.shares.size(); ++i) {
    const GuardBits::Share& share = bits.shares[i];
    shares.push_back({{"of", quantities[i]},
                      {"proved_levels", number(share.proved)},
                      {"least_bits", share.least ? Json(*share.least) : Json(nullptr)}});
  }
  return {{"parameter", bits.parameter}, {"bits", bits.bits}, {"alone", std::move(shares)}};
}

std::string guard_bits_text(const Certificates& all) {
  std::vector<Column> columns{{"alone, every other step exact", Align::left}, {"bits", Align::right}};
  for (const std::string& quantity : all.quantities) {
    columns.push_back({quantity, Align::right});
    columns.push_back({"least", Align::right});
  }
  TextTable table(columns, "  ");
  for (const GuardBits& bits : all.guard_bits) {
    std::vector<std::string> cells{bits.parameter, std::to_string(bits.bits)};
    for (const GuardBits::Share& share : bits.shares) {
      cells.push_back(figure(share.proved));
      cells.push_back(share.least ? std::to_string(*share.least) : "-");
    }
    table.row(std::move(cells));
  }
  return fmt::format("proved error of each width in levels, and the fewest bits for {} levels\n{}\n",
                     figure(all.wanted_levels), table.text());
}

}  // namespace

const char* name_of(ProofKind kind) {
  switch (kind) {
    case ProofKind::exhaustive:
      return "exhaustive";
    case ProofKind::interval:
      return "interval";
    case ProofKind::formula:
      break;
  }
  return "formula";
}

bool Certificates::hold() const {
  return std::all_of(steps.begin(), steps.end(), [](const Certificate& c) { return c.holds(); });
}

std::string certificates_text(const Certificates& certificates) {
  TextTable table({{"step", Align::left},
                   {"of every", Align::left},
                   {"proof", Align::left},
                   {"proved", Align::right},
                   {"seen", Align::right},
                   {"of it", Align::right},
                   {"unit", Align::left},
                   {"decides", Align::left}},
                  "  ");
  for (const Certificate& c : certificates.steps)
    table.row({c.step, c.range, name_of(c.proof), figure(c.proved), figure(c.seen), ratio(c), c.unit, c.decides});
  std::string text = fmt::format("{}, seed {}\n\n{}\n", certificates.machine, certificates.seed, table.text());
  if (!certificates.guard_bits.empty()) text += guard_bits_text(certificates);
  return text;
}

std::string certificates_json(const std::vector<Certificates>& machines) {
  Json list = Json::array();
  for (const Certificates& all : machines) {
    Json steps = Json::array();
    for (const Certificate& c : all.steps) steps.push_back(step_json(c));
    Json bits = Json::array();
    for (const GuardBits& width : all.guard_bits) bits.push_back(bits_json(width, all.quantities));
    list.push_back({{"schema", kCertificatesSchema},
                    {"program", "rastertlm"},
                    {"kind", "certificates"},
                    {"machine", all.machine},
                    {"platform", all.platform},
                    {"seed", all.seed},
                    {"holds", all.hold()},
                    {"steps", std::move(steps)},
                    {"wanted_levels", number(all.wanted_levels)},
                    {"guard_bits", std::move(bits)}});
  }
  return list.dump(2) + '\n';
}

}  // namespace rastertlm::report
