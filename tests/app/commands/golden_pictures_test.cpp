// The built-in patient against stored images, drawn by the program on the CPU, so independent of drivers: the whole
// view in 240x150 pixels, the site at work scale in crops of 300 pixels. After an intended change, inspected by eye:
//   MOLAR_WRITE_GOLDEN=1 build/release/tests/app/commands/app_commands_test --gtest_filter='GoldenPicture.*'
#include <glm/glm.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

/// Largest accepted difference from the golden image.
struct Tolerance {
  double mean;       ///< of all channels, of 255
  double far_share;  ///< of the pixels whose worst channel is more than 8 of 255 away
};

/// At fast pace every run makes the same ticks; up to ten edge pixels differ by the rounding of other processors.
constexpr Tolerance kStill{0.01, 0.0003};
class GoldenPicture : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
  }

  void expectGolden(const std::string& picture, const std::string& golden, Tolerance tolerance) const {
    const std::string stored = std::string(MOLAR_GOLDEN_DIR) + "/" + golden;
    if (std::getenv("MOLAR_WRITE_GOLDEN") != nullptr) {
      std::filesystem::copy_file(at(picture), stored, std::filesystem::copy_options::overwrite_existing);
      return;
    }
    const cv::Mat is = cv::imread(at(picture)), should = cv::imread(stored);
    ASSERT_FALSE(should.empty()) << stored << ": missing";
    ASSERT_EQ(is.size(), should.size());
    cv::Mat difference;
    cv::absdiff(is, should, difference);
    double sum = 0.0;
    int far = 0;
    for (int y = 0; y < difference.rows; ++y)
      for (int x = 0; x < difference.cols; ++x) {
        const cv::Vec3b d = difference.at<cv::Vec3b>(y, x);
        sum += d[0] + d[1] + d[2];
        far += std::max({d[0], d[1], d[2]}) > 8 ? 1 : 0;
      }
    const double pixels = static_cast<double>(difference.total());
    RecordProperty(golden + "_mean", std::to_string(sum / (3.0 * pixels)));
    RecordProperty(golden + "_far_share", std::to_string(far / pixels));
    EXPECT_LE(sum / (3.0 * pixels), tolerance.mean) << golden;
    EXPECT_LE(far / pixels, tolerance.far_share) << golden;
  }
};

constexpr char kRun[] =
    "rehearse --headless --pace fast --device scripted --voxel 0.5 --renderer cpu --snapshot-size 240x150 ";

TEST_F(GoldenPicture, PatientBeforeAndAfterTheTrough) {
  const ProgramOutput said =
      molar(kRun + std::string("--first-snapshot ") + at("before.png") + " --snapshot " + at("after.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  expectGolden("before_left.png", "before_left.png", kStill);
  expectGolden("before_right.png", "before_right.png", kStill);
  expectGolden("after_left.png", "after_left.png", kStill);
}

TEST_F(GoldenPicture, TranslucentBoneWithTheCanalUnderAFadedFace) {
  const ProgramOutput said =
      molar(kRun + std::string("--seconds 0.1 --mode dvr --layers canal --face-opacity 0.3 --first-snapshot ") +
            at("clear.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  expectGolden("clear_left.png", "translucent_left.png", kStill);
}

TEST_F(GoldenPicture, TheSiteAtWorkScaleBeforeAndAfterTheTrough) {
  // Flap, moist bone and the arch; then open marrow with blood and water, and the enamel of the crown.
  const auto crop = [&](const std::string& picture, glm::ivec2 at_px) {
    const cv::Mat whole = cv::imread(at(picture));
    const cv::Rect around(at_px.x, at_px.y, 300, 300);
    ASSERT_EQ((around & cv::Rect({0, 0}, whole.size())).area(), around.area());
    ASSERT_TRUE(cv::imwrite(at("crop_" + picture), whole(around)));
  };
  constexpr char kWork[] =
      "rehearse --headless --pace fast --device scripted --renderer cpu --snapshot-size 1280x800 --position ";
  for (const auto& [position, at_px] :
       {std::pair{"seated", glm::ivec2(500, 240)}, std::pair{"left", glm::ivec2(530, 280)}}) {
    const std::string from = position;
    const ProgramOutput said = molar(kWork + from + " --first-snapshot " + at(from + "_before.png") + " --snapshot " +
                                     at(from + "_after.png"));
    ASSERT_EQ(said.status, 0) << said.err;
    for (const std::string when : {"before", "after"}) {
      crop(from + "_" + when + "_left.png", at_px);
      expectGolden("crop_" + from + "_" + when + "_left.png", "site_" + from + "_" + when + ".png", kStill);
    }
  }
}

TEST_F(GoldenPicture, TheSiteOfOnePictureMoistAndDry) {
  constexpr char kSite[] =
      "see --case usual --size 300x300 --renderer cpu --camera "
      "'{\"eye_mm\":[-115,-387,217],\"look_at_mm\":[-30,37,-8],\"up\":[0,0,1],\"fov_y_deg\":4.5}' --out ";
  for (const auto& [golden, option] : {std::pair{"see_moist.png", ""}, std::pair{"see_dry.png", " --dry"}}) {
    const ProgramOutput said = molar(kSite + at(golden) + option);
    ASSERT_EQ(said.status, 0) << said.err;
    expectGolden(golden, golden, kStill);
  }
}

TEST_F(GoldenPicture, ThePlannedCutAndTheSlices) {
  const ProgramOutput said =
      molar(kRun + std::string("--seconds 0.1 --layers plan,clearance,slices --first-snapshot ") + at("plan.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  expectGolden("plan_left.png", "plan_left.png", kStill);
}

}  // namespace
}  // namespace app
