// Are figures of two pictures those that OpenImageIO finds? In a program of its own: the library takes 0.3 s to load.
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include "src/reference/picture_metrics.h"
#include "tests/src/reference/flip_pictures.h"

namespace rastertlm::image {
namespace {

std::vector<std::uint8_t> bytes_of(const reference::FlipPicture& picture) {
  return {picture.levels.begin(), picture.levels.end()};
}

// Larger than a block, and not a whole number of them.
TEST(OpenImageIo, FindsThePsnrOfThePictureMetrics) {
  for (const reference::FlipPair& pair : reference::flip_pairs(173, 149)) {
    const OIIO::ImageSpec spec(pair.reference.columns, pair.reference.lines, 3, OIIO::TypeDesc::UINT8);
    std::vector<std::uint8_t> a = bytes_of(pair.reference);
    std::vector<std::uint8_t> b = bytes_of(pair.test);
    const OIIO::ImageBuf first(spec, a.data());
    const OIIO::ImageBuf second(spec, b.data());
    const auto wanted = OIIO::ImageBufAlgo::compare(first, second, 2.5F / 255.0F, 1.5F / 255.0F);
    const reference::LevelFigures figures = reference::compare_levels(a, b);
    ASSERT_TRUE(figures.psnr_db.has_value());
    EXPECT_NEAR(*figures.psnr_db, wanted.PSNR, 1e-5) << pair.name;
    EXPECT_NEAR(figures.rmse_level / 255.0, wanted.rms_error, 1e-7) << pair.name;
    EXPECT_NEAR(figures.max_level, 255.0 * wanted.maxerror, 1e-4) << pair.name;
    const double pixels = static_cast<double>(spec.width) * spec.height;
    EXPECT_NEAR(figures.over_one_level_percent, 100.0 * static_cast<double>(wanted.nwarn) / pixels, 1e-9) << pair.name;
    EXPECT_NEAR(figures.over_two_levels_percent, 100.0 * static_cast<double>(wanted.nfail) / pixels, 1e-9) << pair.name;
  }
}

}  // namespace
}  // namespace rastertlm::image
