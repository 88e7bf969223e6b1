#include "assets/import/dicom/burnt_in_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <string_view>

namespace {

constexpr std::int16_t kNoText = -32768;
constexpr glm::ivec3 kSize(220, 120, 8);

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

/// Digits `height` pixels high, the nearest of their 5 x 7 dots.
void writeHigh(std::string_view digits, int height, int slices, std::int16_t bright, std::vector<std::int16_t>& grey) {
  const int width = 5 * height / 7;
  for (int z = 0; z < slices; ++z)
    for (std::size_t d = 0; d < digits.size(); ++d)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          if ((kDigits[static_cast<std::size_t>(digits[d] - '0')][static_cast<std::size_t>(7 * y / height)] >>
                   (4 - 5 * x / width) &
               1) != 0)
            grey[indexOf(2 + static_cast<int>(d) * (width + height / 7 + 1) + x, 5 + y, z)] = bright;
}
void write(std::string_view digits, int scale, int slices, std::int16_t bright, std::vector<std::int16_t>& grey) {
  writeHigh(digits, 7 * scale, slices, bright, grey);
}

// Numbers of eight digits at six sizes: of a hundred and twenty at least nineteen of twenty are found and blanked.
TEST(BurntInText, IsFoundAtEverySizeAndBlankedInEverySlice) {
  std::mt19937 random(20);
  int written = 0, found = 0;
  for (const int height : {7, 9, 12, 14, 21, 28})
    for (int round = 0; round < 20; ++round) {
      std::vector<std::int16_t> grey = clean(static_cast<unsigned>(height + 100 * round));
      std::string digits;
      while (digits.size() < 8) digits += "023456789"[random() % 9];  // a 1 is too narrow to count
      writeHigh(digits, height, kSize.z, 3000, grey);
      ++written;
      const auto boxes = assets::burntInText(kSize, grey, kNoText);
      if (boxes.size() != 1 || boxes[0].low.y != 5 || boxes[0].end.y != 5 + height) continue;
      assets::blankText(kSize, boxes, kNoText, grey);
      found += std::ranges::count(grey, std::int16_t{3000}) == 0 ? 1 : 0;
    }
  EXPECT_GE(found, written * 95 / 100) << "of " << written;
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
