#include "src/report/page_document.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "src/base/digest.h"
#include "src/report/page_assets.h"

namespace rastertlm::report {
namespace {

std::string escaped(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

// Outside of strings JSON has no '<'; inside, the escape means the same and no element ends or begins.
std::string for_script_element(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

// As a content security policy names an inline script or style: 'sha256-...'.
std::string policy_hash(std::string_view text) {
  const std::string hex = sha256_hex(text);
  constexpr int kHex = 16;
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, kHex)));
  return fmt::format("'sha256-{}'", base64(bytes));
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr unsigned kDigitBits = 6;
  constexpr unsigned kDigitMask = (1U << kDigitBits) - 1;
  constexpr std::size_t kGroup = 3;
  std::string text;
  text.reserve((bytes.size() + kGroup - 1) / kGroup * (kGroup + 1));
  for (std::size_t i = 0; i < bytes.size(); i += kGroup) {
    const std::size_t there = std::min(kGroup, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < kGroup; ++k) group = group << 8U | (k < there ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k <= kGroup; ++k)
      text += k <= there ? kDigits[group >> (kDigitBits * (kGroup - k)) & kDigitMask] : '=';
  }
  return text;
}

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string base64(std::string_view bytes) {
  return base64(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

std::string page_text(const PageDocument& document) {
  std::vector<std::string_view> scripts{kChartScript, kCommonScript};
  scripts.insert(scripts.end(), document.scripts.begin(), document.scripts.end());
  std::string hashes;
  std::string elements;
  for (const std::string_view script : scripts) {
    hashes += ' ' + policy_hash(script);
    elements += fmt::format("<script>{}</script>\n", script);
  }
  return fmt::format(
      R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data: blob:; style-src {}; script-src{}; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{}</title>
<style>{}</style>
</head>
<body>
<main id="page">
<header><h1>{}</h1><p class="answer">{}</p></header>
<noscript><pre>{}</pre></noscript>
</main>
<script type="application/json" id="data">{}</script>
{}</body>
</html>
)",
      policy_hash(kPageStyle), hashes, escaped(document.title), kPageStyle, escaped(document.heading),
      escaped(document.answer), escaped(document.plain_text), for_script_element(document.data), elements);
}

}  // namespace rastertlm::report
