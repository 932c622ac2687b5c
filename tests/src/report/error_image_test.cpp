#include "src/report/error_image.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rastertlm::report {
namespace {

TEST(ErrorImage, AmplifiesTheDifferenceOfRoundedLevels) {
  frame::Frame shown;
  shown.resize(2, 1);
  frame::ExactFrame exact;
  exact.resize(2, 1);
  shown.rgb = {10, 10, 10, 200, 0, 255};
  exact.rgb.assign({10.49, 10.5, 8.0, 0.0, 255.0, 255.0});
  // 10.49 is shown as 10, 10.5 as 11: one level off; 2, 200 and 255 levels off; none.
  EXPECT_EQ(error_image(shown, exact), (std::vector<std::uint8_t>{0, 32, 64, 255, 255, 0}));
}

TEST(ErrorImage, RefusesPicturesOfDifferentSizes) {
  frame::Frame shown;
  shown.resize(2, 2);
  frame::ExactFrame exact;
  exact.resize(2, 1);
  EXPECT_THROW(error_image(shown, exact), std::invalid_argument);
}

}  // namespace
}  // namespace rastertlm::report
