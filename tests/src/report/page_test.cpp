// Is a page one file whose texts stay texts, and the same file every time?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "src/report/json_report.h"
#include "src/report/page_assets.h"
#include "src/report/page_document.h"
#include "src/report/run_page.h"
#include "tests/src/report/example_result.h"

namespace rastertlm::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const FileOfRun kNoFile = [](const std::string&) { return std::string("no_such_folder/file"); };

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find("</script>", from) - from);
}

// RFC 4648, section 10.
TEST(Page, Base64) {
  const std::vector<std::pair<std::string, std::string>> vectors{{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64(std::string("\xfb\xff\xbf", 3)), "+/+/");
}

TEST(Page, TextsStayTexts) {
  const std::string page = page_text({"<t>&\"", "<h>", "a < b", "<p>", R"({"x":"</script><script>"})", {}});
  EXPECT_THAT(page, HasSubstr("<title>&lt;t&gt;&amp;&quot;</title>"));
  EXPECT_THAT(page, HasSubstr("<h1>&lt;h&gt;</h1>"));
  EXPECT_THAT(page, HasSubstr("a &lt; b"));
  EXPECT_THAT(page, HasSubstr("<pre>&lt;p&gt;</pre>"));
  EXPECT_EQ(count_of(page, "</script>"), 3U) << "Chart.js, what is common, the data";
  EXPECT_EQ(nlohmann::json::parse(data_of(page))["x"], "</script><script>");
}

// By another program: printf 'let x = 1;' | openssl dgst -sha256 -binary | base64
TEST(Page, PolicyNamesItsScripts) {
  const std::string page = page_text({"", "", "", "", "{}", {"let x = 1;"}});
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("'sha256-qtc3jf64UXA5J6U02kfQ0Cvn9Uz4wXUaN3NNUVgR2v4='"));
  EXPECT_THAT(page, Not(HasSubstr("unsafe")));
  EXPECT_THAT(std::string(kChartScript.substr(0, 200)), HasSubstr("MIT License")) << "its licence goes with it";
}

TEST(Page, OfARunHoldsItsReportAndIsTheSameTwice) {
  run::Result result = example_result();
  result.warnings = {"</script><script>alert(1)</script>"};
  const Contents contents{result, false};
  const std::string page = run_page(contents, kNoFile);
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  EXPECT_EQ(run_page(contents, kNoFile), page);
  const nlohmann::json data = nlohmann::json::parse(data_of(page));
  EXPECT_EQ(data["report"], nlohmann::json::parse(json_text(contents)));
  EXPECT_EQ(data["left_out"], result.frames.size()) << "no picture is there";
  EXPECT_EQ(count_of(page, "</script>"), 5U);
  EXPECT_LT(page.size(), 400'000U);
}

}  // namespace
}  // namespace rastertlm::report
