#include "calibration/fit/touches_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "tests/mutants.h"
#include "tests/refusal.h"

namespace calibration {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kByHand = R"(%YAML:1.0
---
device_model: "omni"
observations:
  - { id: 3, joints_rad: [0.1, 0.2, -0.3, 0.4, 0.5, 0.6], p_W_mm: [1, 2.5, -3e1], used: 0 }
  - { id: 4, joints_rad: [0, 0, 0, 0, 0, 0], p_W_mm: [10., 20., 30.] }
)";

class TouchesFile : public testing::Test {
 protected:
  std::string path_ =
      (std::filesystem::path(testing::TempDir()) /
       (std::string("touches_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml"))
          .string();
  void TearDown() override { std::filesystem::remove(path_); }

  std::string write(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }
  std::string refusal(const std::string& text) {
    const std::string refused = tests::refusalOf<CalibrationError>([&] { readTouches(write(text)); });
    EXPECT_THAT(refused, testing::AnyOf("accepted", HasSubstr(path_)));
    return refused;
  }
  std::string refusalWith(const std::string& from, const std::string& to) {
    std::string text = kByHand;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return refusal(text.replace(at, from.size(), to));
  }
};

TouchSet anySet(std::uint32_t seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  TouchSet set{"premium", "60623200012", "right", "visual25", {0.1 + 1e-17, 1.0 / 3.0}, {}};
  for (int i = 0; i < 40; ++i) {
    Touch touch{i * 7, {}, {{150.0 * unit(rng), 1e-9 * unit(rng), unit(rng) / 3.0}}, unit(rng) > 0.0};
    for (double& angle_rad : touch.joints_rad) angle_rad = 12.0 * unit(rng);
    set.touches.push_back(touch);
  }
  return set;
}

TEST_F(TouchesFile, ReadsAFileTypedByHand) {
  const TouchSet set = readTouches(write(kByHand));
  EXPECT_EQ(set.device_model, "omni");
  EXPECT_TRUE(set.serial.empty() && set.mount.empty() && set.method.empty());
  EXPECT_EQ(set.precision.in_plane_mm, kPitPrecision.in_plane_mm);
  ASSERT_EQ(set.touches.size(), 2u);
  EXPECT_EQ(set.touches[0].id, 3);
  EXPECT_EQ(set.touches[0].joints_rad[2], -0.3);
  EXPECT_EQ(set.touches[0].target_W.mm, glm::dvec3(1.0, 2.5, -30.0));
  EXPECT_FALSE(set.touches[0].used);
  EXPECT_TRUE(set.touches[1].used) << "where nothing is said, a touch is used";
}

TEST_F(TouchesFile, ReadsBackEveryBitOfWhatItWrites) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const TouchSet set = anySet(seed), back = readTouches(write(touchesText(set)));
    EXPECT_EQ(back.device_model, set.device_model);
    EXPECT_EQ(back.serial, set.serial);
    EXPECT_EQ(back.mount, set.mount);
    EXPECT_EQ(back.method, set.method);
    EXPECT_EQ(back.precision.in_plane_mm, set.precision.in_plane_mm);
    EXPECT_EQ(back.precision.along_sight_mm, set.precision.along_sight_mm);
    ASSERT_EQ(back.touches.size(), set.touches.size());
    for (std::size_t i = 0; i < set.touches.size(); ++i) {
      EXPECT_EQ(back.touches[i].id, set.touches[i].id);
      EXPECT_EQ(back.touches[i].joints_rad, set.touches[i].joints_rad);
      EXPECT_EQ(back.touches[i].target_W.mm, set.touches[i].target_W.mm);
      EXPECT_EQ(back.touches[i].used, set.touches[i].used);
    }
  }
}

TEST_F(TouchesFile, OmitsUnknownFields) {
  TouchSet set = anySet(1);
  set.serial = set.mount = set.method = "";
  EXPECT_THAT(touchesText(set), testing::Not(testing::ContainsRegex("serial|mount|method")));
  EXPECT_TRUE(readTouches(write(touchesText(set))).serial.empty());
}

TEST_F(TouchesFile, NamesTheWrongTouchAndWhy) {
  EXPECT_THAT(refusalWith("id: 4,", ""), AllOf(HasSubstr("observation 2"), HasSubstr("'id'")));
  EXPECT_THAT(refusalWith("id: 4", "id: -4"), HasSubstr("'id'"));
  EXPECT_THAT(refusalWith("used: 0", "used: 2"), AllOf(HasSubstr("observation 1"), HasSubstr("'used'")));
  EXPECT_THAT(refusalWith("0.6]", "0.6, 0.7]"), AllOf(HasSubstr("observation 1"), HasSubstr("list of 6 numbers")));
  EXPECT_THAT(refusalWith("0.2,", ".Nan,"), AllOf(HasSubstr("joints_rad"), HasSubstr("not finite")));
  EXPECT_THAT(refusalWith("2.5", ".Inf"), AllOf(HasSubstr("p_W_mm"), HasSubstr("not finite")));
  EXPECT_THAT(refusalWith("2.5", "\"2.5\""), HasSubstr("not a number"));
  EXPECT_THAT(refusalWith("0.2,", "20,"), AllOf(HasSubstr("beyond two turns"), HasSubstr("radians")));
  EXPECT_THAT(refusalWith("2.5", "2500"), AllOf(HasSubstr("beyond 2 m"), HasSubstr("mm in frame W")));
  EXPECT_THAT(refusalWith("p_W_mm: [10., 20., 30.]", "p_mm: [1, 2, 3]"),
              AllOf(HasSubstr("p_W_mm"), HasSubstr("missing")));
  EXPECT_THAT(refusalWith("{ id: 4, joints_rad: [0, 0, 0, 0, 0, 0], p_W_mm: [10., 20., 30.] }", "7"),
              AllOf(HasSubstr("observation 2"), HasSubstr("not a map")));
}

TEST_F(TouchesFile, NamesWhatIsWrongWithTheFile) {
  EXPECT_THAT(refusalWith("omni", "novint"), AllOf(HasSubstr("novint"), HasSubstr("omni, touch, desktop, premium")));
  EXPECT_THAT(refusalWith("device_model", "device"), HasSubstr("device_model"));
  EXPECT_THAT(refusalWith("observations", "touches"), HasSubstr("'observations' is missing"));
  EXPECT_THAT(refusalWith("observations:", "precision_mm: [0.3, -1]\nobservations:"), HasSubstr("precision_mm"));
  EXPECT_THAT(refusalWith("observations:", "precision_mm: [0.3]\nobservations:"), HasSubstr("list of 2 numbers"));
  EXPECT_THAT(refusalWith("observations:", "serial: 5\nobservations:"), HasSubstr("'serial'"));
  EXPECT_THAT(refusal("%YAML:1.0\n---\ndevice_model: \"omni\"\nobservations: []\n"), HasSubstr("observations"));
  EXPECT_THAT(refusal(""), HasSubstr("its size is not that"));
  EXPECT_THAT(refusal("no yaml at all"), HasSubstr("not OpenCV FileStorage YAML"));
  EXPECT_THAT(refusal("%YAML:1.0\n---\n- 1\n- 2\n"), HasSubstr("no keys"));
  EXPECT_THROW(readTouches(path_ + ".missing"), CalibrationError);
}

TEST_F(TouchesFile, RefusesMoreTouchesThanAnyProcedureHas) {
  TouchSet set = anySet(1);
  while (set.touches.size() <= 10'000) set.touches.push_back({1, {}, {}, true});
  EXPECT_THAT(refusal(touchesText(set)), testing::AnyOf(HasSubstr("more than 10000"), HasSubstr("its size")));
}

TEST_F(TouchesFile, ReadsOrRefusesAnyFile) {
  TouchSet small = anySet(2);
  small.touches.resize(4);
  int read = 0;
  mutants::forEachMutant({touchesText(small)}, 800, [&](const std::string& text, std::size_t, std::uint64_t) {
    try {
      const TouchSet set = readTouches(write(text));
      ++read;
      for (const Touch& touch : set.touches) {
        EXPECT_LE(glm::length(touch.target_W.mm), 3500.0);
        for (const double angle_rad : touch.joints_rad) EXPECT_TRUE(std::abs(angle_rad) <= 13.0);
      }
    } catch (const CalibrationError&) {
    }
  });
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace calibration
