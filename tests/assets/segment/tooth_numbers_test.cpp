#include "assets/segment/tooth_numbers.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "assets/segment/jaw_verdict.h"

namespace {

using assets::FoundTooth;

/// A circle of 25 mm as the arch, and teeth on it with the distances and volumes of a normal row.
struct Row {
  Row() {
    arch.radius_mm.fill(25.0);
    constexpr std::array<double, 9> kAlong_mm = {0, 2.5, 7.75, 14, 21, 28, 37, 47.75, 58};
    constexpr std::array<double, 9> kVolume_mm3 = {0, 260, 290, 440, 430, 480, 980, 940, 800};
    for (int place = 0; place < 16; ++place) {
      const int fdi = place < 8 ? 48 - place : 23 + place;
      const auto position = static_cast<std::size_t>(fdi % 10);
      const double angle = (fdi > 40 ? -1.0 : 1.0) * kAlong_mm[position] / 25.0;
      FoundTooth tooth;
      tooth.part = fdi;
      tooth.volume_mm3 = kVolume_mm3[position];
      tooth.centre_P_mm = {25.0 * std::sin(angle), -25.0 * std::cos(angle), 0.0};
      tooth.extent_mm = {10.0, 10.0, 20.0};
      tooth.crown_P_mm = {0.0, 0.0, 5.0};
      teeth.push_back(tooth);
    }
  }
  void lose(std::initializer_list<int> lost) {
    for (const int fdi : lost) std::erase_if(teeth, [=](const FoundTooth& tooth) { return tooth.part == fdi; });
  }
  void expectRight() {
    assets::numberTeeth(arch, teeth);
    for (const FoundTooth& tooth : teeth) EXPECT_EQ(tooth.fdi, tooth.part);
  }
  assets::JawArch arch;
  std::vector<FoundTooth> teeth;
};

TEST(ToothNumbers, AWholeRowHasItsNumbersFromRightToLeft) {
  Row row;
  std::ranges::reverse(row.teeth);
  row.expectRight();
  EXPECT_EQ(row.teeth.front().fdi, 48);
  EXPECT_EQ(row.teeth.back().fdi, 38);
}

TEST(ToothNumbers, MissingTeethLeaveTheirNumbersFree) {
  for (const auto& lost : std::vector<std::initializer_list<int>>{
           {46}, {38, 48}, {36, 46}, {37, 38}, {45, 44}, {31, 41}, {34, 35, 44, 48}, {36, 37, 46, 47}}) {
    Row row;
    row.lose(lost);
    row.expectRight();
  }
}

TEST(ToothNumbers, OneSideIsEnough) {
  Row row;
  row.arch.is_one_sided = true;
  std::erase_if(row.teeth, [](const FoundTooth& tooth) { return tooth.part < 40; });
  row.expectRight();
}

TEST(ToothNumbers, SizesMayBeAFifthOff) {
  std::mt19937 random(7);
  std::normal_distribution<double> share(0.0, 0.15);
  for (int n = 0; n < 20; ++n) {
    Row row;
    if (n % 2 == 1) row.lose({38, 45});
    for (FoundTooth& tooth : row.teeth) {
      tooth.volume_mm3 *= std::exp(share(random));
      tooth.centre_P_mm.x += 4.0 * share(random);
    }
    row.expectRight();
  }
}

TEST(ToothNumbers, ASparePieceHasNone) {
  Row row;
  FoundTooth spare = row.teeth[1];
  spare.part = 0;
  spare.volume_mm3 = 100.0;
  spare.centre_P_mm.z = -12.0;
  row.teeth.push_back(spare);
  row.expectRight();
}

/// A crown of 37 and a root below it that touch.
struct DividedTooth {
  DividedTooth() {
    jaw.grid = {{20, 20, 40}, 0.5, {0, 0, 0}};
    regions.box = {{0, 0, 0}, jaw.grid.size};
    regions.count = 2;
    regions.part.resize(jaw.grid.voxelCount(), 0);
    assets::forVoxels(jaw.grid, [&](glm::ivec3 p, std::size_t v) {
      if (p.x > 4 && p.x < 15 && p.y > 4 && p.y < 15) regions.part[v] = p.z < 20 ? 2 : 1;
    });
  }
  bool joins(double crown_mm3, double root_mm3) {
    FoundTooth crown, root;
    crown.part = 1, crown.fdi = 37, crown.volume_mm3 = crown_mm3;
    root.part = 2, root.volume_mm3 = root_mm3;
    return assets::joinSpareParts(jaw, {crown, root}, regions);
  }
  assets::Mandible jaw;
  assets::ToothRegions regions;
};

TEST(ToothNumbers, ASparePieceJoinsTheToothWhoseVolumeItMends) {
  DividedTooth tooth;
  EXPECT_TRUE(tooth.joins(390.0, 310.0));
  EXPECT_EQ(std::ranges::count(tooth.regions.part, 2), 0);
  EXPECT_EQ(std::ranges::count(tooth.regions.part, 1), 4000);
  DividedTooth whole;
  EXPECT_FALSE(whole.joins(940.0, 310.0)) << "a whole tooth needs no more";
  EXPECT_EQ(std::ranges::count(whole.regions.part, 2), 2000);
}

std::string verdictOn(const std::vector<FoundTooth>& teeth, int width = 300) {
  const auto refusal = assets::judgeJaw({{width, 200, 200}, 0.4, {0, 0, 0}}, teeth);
  return refusal ? refusal->code : "";
}

TEST(JawVerdict, ARowOfTeethIsALowerJaw) {
  Row row;
  EXPECT_EQ(verdictOn(row.teeth), "");
  EXPECT_EQ(verdictOn(row.teeth, 400), "J4") << "as wide as a skull";
  EXPECT_EQ(verdictOn({}), "J2");
}

TEST(JawVerdict, CrownsThatPointDownAreAnUpperArch) {
  Row row;
  for (FoundTooth& tooth : row.teeth) tooth.crown_P_mm.z = -5.0;
  EXPECT_EQ(verdictOn(row.teeth), "J1");
}

TEST(JawVerdict, TooManyPiecesOrPiecesOfNoToothsSizeAreNone) {
  Row row;
  EXPECT_FALSE(assets::judgeCount(row.teeth));
  row.teeth.insert(row.teeth.end(), row.teeth.begin(), row.teeth.begin() + 3);
  EXPECT_EQ(verdictOn(row.teeth), "") << "they may be parts of teeth";
  ASSERT_TRUE(assets::judgeCount(row.teeth));
  EXPECT_EQ(assets::judgeCount(row.teeth)->code, "J3");
  row.teeth.resize(10);
  for (std::size_t n = 0; n < 5; ++n) row.teeth[n].volume_mm3 = 5000.0;
  EXPECT_EQ(verdictOn(row.teeth), "J3");
}

}  // namespace
