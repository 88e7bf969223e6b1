#include "calibration/png_file.h"

#include <fstream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"

namespace calibration {
namespace {

TEST(PngFile, WritesAPngOfTheSizeAsked) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("pixels.png");
  writePng(path, {3, 2}, std::vector<std::uint8_t>(24, 200));
  std::ifstream file(path, std::ios::binary);
  std::vector<unsigned char> head(24);
  file.read(reinterpret_cast<char*>(head.data()), 24);
  EXPECT_EQ(head[1], 'P');
  EXPECT_EQ(head[19], 3);
  EXPECT_EQ(head[23], 2);
}

TEST(PngFile, NamesAPathItCannotWrite) {
  EXPECT_THROW(writePng("/nonexistent/a.png", {1, 1}, std::vector<std::uint8_t>(4)), CalibrationError);
}

}  // namespace
}  // namespace calibration
