#include "assets/import/dicom/burnt_in_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string_view>

namespace {

constexpr std::int16_t kNoText = -32768;
constexpr glm::ivec3 kSize(200, 120, 8);

/// 5 x 7 digits, a row of bits each.
constexpr std::array<std::array<int, 7>, 10> kDigits = {{{14, 17, 19, 21, 25, 17, 14},
                                                         {4, 12, 4, 4, 4, 4, 14},
                                                         {14, 17, 1, 2, 4, 8, 31},
                                                         {31, 2, 4, 2, 1, 17, 14},
                                                         {2, 6, 10, 18, 31, 2, 2},
                                                         {31, 16, 30, 1, 1, 17, 14},
                                                         {6, 8, 16, 30, 17, 17, 14},
                                                         {31, 1, 2, 4, 8, 8, 8},
                                                         {14, 17, 17, 14, 17, 17, 14},
                                                         {14, 17, 17, 15, 1, 2, 12}}};

std::size_t indexOf(int x, int y, int z) { return static_cast<std::size_t>((z * kSize.y + y) * kSize.x + x); }

std::vector<std::int16_t> clean(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 60.0);
  std::vector<std::int16_t> grey(static_cast<std::size_t>(kSize.x * kSize.y * kSize.z));
  for (std::size_t n = 0; n < grey.size(); ++n) {
    const int x = static_cast<int>(n) % kSize.x;
    grey[n] = static_cast<std::int16_t>((x % 40 < 12 ? 1300.0 : 40.0) + noise(random));
    grey[n] = std::min<std::int16_t>(grey[n], 1450);  // clipped in many places
  }
  return grey;
}

/// The line's height.
int write(std::string_view digits, int scale, int slices, std::int16_t bright, std::vector<std::int16_t>& grey) {
  for (int z = 0; z < slices; ++z)
    for (std::size_t d = 0; d < digits.size(); ++d)
      for (int y = 0; y < 7 * scale; ++y)
        for (int x = 0; x < 5 * scale; ++x)
          if ((kDigits[static_cast<std::size_t>(digits[d] - '0')][static_cast<std::size_t>(y / scale)] >>
                   (4 - x / scale) &
               1) != 0)
            grey[indexOf(4 + static_cast<int>(d) * 6 * scale + x, 5 + y, z)] = bright;
  return 7 * scale;
}

TEST(BurntInText, IsFoundAtEverySizeAndBlankedInEverySlice) {
  for (const int scale : {1, 2, 3, 4}) {
    std::vector<std::int16_t> grey = clean(static_cast<unsigned>(scale));
    const int height = write("20481957", scale, kSize.z, 3000, grey);
    const auto boxes = assets::burntInText(kSize, grey, kNoText);
    ASSERT_EQ(boxes.size(), 1U) << scale;
    EXPECT_EQ(boxes[0].low.y, 5);
    EXPECT_EQ(boxes[0].end.y, 5 + height);
    assets::blankText(kSize, boxes, kNoText, grey);
    EXPECT_EQ(std::ranges::count(grey, std::int16_t{3000}), 0);
  }
}

TEST(BurntInText, RaisesNoAlarmOnPicturesWithout) {
  for (unsigned seed = 1; seed <= 8; ++seed)
    EXPECT_TRUE(assets::burntInText(kSize, clean(seed), kNoText).empty()) << seed;
  // In two slices only, or too few letters.
  std::vector<std::int16_t> grey = clean(9);
  write("20481957", 2, 2, 3000, grey);
  EXPECT_TRUE(assets::burntInText(kSize, grey, kNoText).empty());
  grey = clean(9);
  write("2048", 2, kSize.z, 3000, grey);
  EXPECT_TRUE(assets::burntInText(kSize, grey, kNoText).empty());
}

}  // namespace
