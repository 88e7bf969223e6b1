#include "app/evaluation/console/page_pictures.h"

#include <unistd.h>

#include <atomic>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace app {
namespace {

render::Image plainImage(int w, int h, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  render::Image image{w, h, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(w * h), 255)};
  for (std::size_t n = 0; n < image.rgba.size(); n += 4)
    image.rgba[n] = red, image.rgba[n + 1] = green, image.rgba[n + 2] = blue;
  return image;
}

TEST(PagePictures, FitWithTheirShapeAndAreNeverEnlarged) {
  const SmallPicture wide = scaledToFit(plainImage(1920, 1080, 1, 2, 3), 960, 540);
  EXPECT_EQ(wide.w, 960);
  EXPECT_EQ(wide.h, 540);
  const SmallPicture high = scaledToFit(plainImage(1280, 1024, 1, 2, 3), 960, 540);
  EXPECT_EQ(high.w, 675);
  EXPECT_EQ(high.h, 540);
  const SmallPicture small = scaledToFit(plainImage(64, 48, 1, 2, 3), 960, 540);
  EXPECT_EQ(small.w, 64);
  EXPECT_EQ(small.rgb.size(), 3u * 64 * 48);
  EXPECT_TRUE(scaledToFit({}, 960, 540).rgb.empty());
}

TEST(PagePictures, EachPointIsTheMeanOfThoseItCovers) {
  // Twice as wide and as high, in four values: their mean by hand.
  render::Image image = plainImage(4, 2, 0, 0, 0);
  const std::uint8_t values[] = {10, 20, 100, 120, 30, 40, 140, 160};
  for (std::size_t n = 0; n < 8; ++n) image.rgba[4 * n] = values[n];
  const SmallPicture half = scaledToFit(image, 2, 1);
  ASSERT_EQ(half.rgb.size(), 6u);
  EXPECT_EQ(half.rgb[0], 25);
  EXPECT_EQ(half.rgb[3], 130);
}

TEST(PagePictures, OfAnySizeAllPointsOfAPlainImageAreAlike) {
  std::mt19937 random(3);
  for (int n = 0; n < 50; ++n) {
    const render::Image image =
        plainImage(1 + static_cast<int>(random() % 1500), 1 + static_cast<int>(random() % 200), 9, 99, 199);
    const SmallPicture small = scaledToFit(image, 960, 540);
    for (std::size_t at = 0; at < small.rgb.size(); at += 3) {
      ASSERT_EQ(small.rgb[at], 9);
      ASSERT_EQ(small.rgb[at + 2], 199);
    }
  }
}

TEST(PagePictures, TheNewestIsReadAndAskedForAgain) {
  PicturesOut out;
  PicturesIn in(::dup(out.memory()));
  EXPECT_FALSE(out.isWanted());
  EXPECT_FALSE(in.newer(0));
  in.ask();
  EXPECT_TRUE(out.isWanted());
  for (std::uint8_t n = 1; n <= 5; ++n) out.write(plainImage(32, 16, n, 0, 0), n);
  EXPECT_FALSE(out.isWanted());
  const auto newest = in.newer(0);
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->serial, 5u);
  EXPECT_EQ(newest->t_ns, 5);
  EXPECT_EQ(newest->rgb[0], 5);
  EXPECT_FALSE(in.newer(5));
}

TEST(PagePictures, AReaderNeverSeesHalfOfOne) {
  PicturesOut out;
  PicturesIn in(::dup(out.memory()));
  std::atomic<bool> is_over{false};
  std::thread writer([&] {
    for (int n = 0; n < 400; ++n) {
      const auto value = static_cast<std::uint8_t>(n % 251);
      out.write(plainImage(200, 100, value, value, value), n);
    }
    is_over = true;
  });
  std::uint32_t seen = 0;
  while (!is_over) {
    const auto picture = in.newer(seen);
    if (!picture) continue;
    EXPECT_GT(picture->serial, seen);
    seen = picture->serial;
    for (const std::uint8_t value : picture->rgb) ASSERT_EQ(value, picture->rgb[0]);
  }
  writer.join();
  EXPECT_GT(seen, 0u);
}

}  // namespace
}  // namespace app
