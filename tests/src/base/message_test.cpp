#include "src/base/message.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace rastertlm {
namespace {

RC_GTEST_PROP(Message, IsTakenAsItWasPut,
              (std::int64_t number, const std::string& text, const std::vector<std::uint32_t>& numbers)) {
  std::string message;
  put(message, number);
  put(message, text);
  put(message, numbers);
  put(message, true);
  Unpacker unpacker(message);
  RC_ASSERT(unpacker.number<std::int64_t>() == number);
  RC_ASSERT(unpacker.text() == text);
  RC_ASSERT(unpacker.numbers<std::uint32_t>() == numbers);
  RC_ASSERT(unpacker.number<bool>());
  RC_ASSERT_THROWS_AS(unpacker.number<char>(), std::out_of_range);
}

RC_GTEST_PROP(Message, CutAnywhereItIsShort, (const std::vector<double>& numbers)) {
  std::string message;
  put(message, numbers);
  const std::string cut = message.substr(0, *rc::gen::inRange<std::size_t>(0, message.size()));
  Unpacker unpacker(cut);
  RC_ASSERT_THROWS_AS(unpacker.numbers<double>(), std::out_of_range);
}

TEST(Message, CountsThatNoMemoryHoldsAreShort) {
  std::string message;
  put(message, ~std::uint64_t{0});
  EXPECT_THROW(Unpacker(message).text(), std::out_of_range);
  EXPECT_THROW(Unpacker(message).numbers<std::uint64_t>(), std::out_of_range);
}

}  // namespace
}  // namespace rastertlm
