// Compares an image with a stored one, tests/golden/NAME; MOLAR_WRITE_GOLDEN stores it instead.
#pragma once

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include <gtest/gtest.h>

#include "render/image.h"

namespace app::test {

/// `mean`: largest accepted difference, of all channels, of 255.
inline void expectGolden(const render::Image& image, const std::string& name, double mean_limit) {
  const std::string stored = std::string(MOLAR_GOLDEN_DIR) + "/" + name;
  cv::Mat is(image.h, image.w, CV_8UC3);
  for (int y = 0; y < image.h; ++y)
    for (int x = 0; x < image.w; ++x) {
      const std::uint8_t* c = &image.rgba[4 * static_cast<std::size_t>(y * image.w + x)];
      is.at<cv::Vec3b>(y, x) = {c[2], c[1], c[0]};
    }
  if (std::getenv("MOLAR_WRITE_GOLDEN") != nullptr) {
    ASSERT_TRUE(cv::imwrite(stored, is));
    return;
  }
  const cv::Mat should = cv::imread(stored);
  ASSERT_EQ(is.size(), should.size()) << stored;
  cv::Mat difference;
  cv::absdiff(is, should, difference);
  const cv::Scalar mean = cv::mean(difference);
  EXPECT_LE((mean[0] + mean[1] + mean[2]) / 3.0, mean_limit) << name;
}

}  // namespace app::test
