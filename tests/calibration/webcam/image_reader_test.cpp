#include "calibration/webcam/image_reader.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/mutants.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

class ImageReader : public testing::Test {
 protected:
  ImageReader() {
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) grey_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(3 * x + y);
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Bytes encoded(const char* ending, const std::vector<int>& how = {}) const {
    Bytes bytes;
    cv::imencode(ending, grey_, bytes, how);
    return bytes;
  }
  GreyImage read(const Bytes& bytes) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return readGreyImage(path_);
  }
  std::string refusal(const Bytes& bytes) {
    return tests::refusalOf<CalibrationError>([&] { read(bytes); });
  }

  std::string path_ =
      testing::TempDir() + "image_reader_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".bin";
  cv::Mat grey_ = cv::Mat(48, 64, CV_8U);
};

TEST_F(ImageReader, ReadsPngExactlyAndJpegClosely) {
  const GreyImage png = read(encoded(".png"));
  EXPECT_EQ(png.size_px, glm::ivec2(64, 48));
  EXPECT_EQ(0, std::memcmp(png.grey.data(), grey_.data, png.grey.size()));
  for (const int progressive : {0, 1}) {
    const GreyImage jpeg =
        read(encoded(".jpg", {cv::IMWRITE_JPEG_QUALITY, 95, cv::IMWRITE_JPEG_PROGRESSIVE, progressive}));
    EXPECT_EQ(jpeg.size_px, glm::ivec2(64, 48));
    for (std::size_t i = 0; i < jpeg.grey.size(); ++i) EXPECT_NEAR(jpeg.grey[i], grey_.data[i], 6);
  }
}

TEST_F(ImageReader, RefusesEveryTruncatedFile) {
  for (const char* ending : {".png", ".jpg"}) {
    const Bytes whole = encoded(ending);
    for (std::size_t length = 0; length < whole.size(); length += 7)
      EXPECT_THAT(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))),
                  testing::StartsWith("image "))
          << ending << " " << length << " of " << whole.size();
  }
}

TEST_F(ImageReader, RefusesHugeDeclaredSizes) {
  // Offset of height and width in a JPEG's frame header.
  const Bytes whole = encoded(".jpg");
  const auto frame = std::ranges::search(whole, Bytes{0xff, 0xc0}).begin() - whole.begin();
  Bytes tall = whole;
  tall[static_cast<std::size_t>(frame + 5)] = 0xff;
  EXPECT_THAT(refusal(tall), HasSubstr("16384"));
  Bytes wide = whole;
  wide[static_cast<std::size_t>(frame + 5)] = wide[static_cast<std::size_t>(frame + 7)] = 0x30;  // 12,352 x 12,336
  EXPECT_THAT(refusal(wide), HasSubstr("64 megapixels"));
  Bytes png = encoded(".png");
  png[17] = 0x40;
  EXPECT_THAT(refusal(png), HasSubstr("not a complete PNG")) << "its checksum is wrong";
  grey_ = cv::Mat(8, 64, CV_8U, cv::Scalar(9));
  EXPECT_THAT(refusal(encoded(".png")), HasSubstr("under 16"));
}

TEST_F(ImageReader, RefusesWhatIsNotAnImage) {
  EXPECT_THAT(refusal({}), HasSubstr("empty"));
  EXPECT_THAT(refusal(Bytes(2000, 'a')), HasSubstr("not a complete PNG or JPEG"));
  EXPECT_THAT(refusal(encoded(".bmp")), HasSubstr("not a complete PNG or JPEG"));
  EXPECT_THROW(readGreyImage(testing::TempDir()), CalibrationError);
  EXPECT_THROW(readGreyImage("/nonexistent.png"), CalibrationError);
}

TEST_F(ImageReader, DamagedBytesAreRefusedOrReadAtTheirSize) {
  std::vector<std::string> whole;
  for (const char* ending : {".png", ".jpg"}) {
    const Bytes bytes = encoded(ending);
    whole.emplace_back(bytes.begin(), bytes.end());
  }
  mutants::forEachMutant(whole, 1600, [&](const std::string& spoilt, std::size_t, std::uint64_t) {
    try {
      const GreyImage image = read(Bytes(spoilt.begin(), spoilt.end()));
      EXPECT_EQ(image.grey.size(),
                static_cast<std::size_t>(image.size_px.x) * static_cast<std::size_t>(image.size_px.y));
    } catch (const CalibrationError&) {
    }
  });
}

}  // namespace
}  // namespace calibration
