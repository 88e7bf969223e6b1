#include "assets/segment/jaw_segmentation.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/quaternion.hpp>

#include "assets/scan/image_file.h"
#include "assets/segment/cell_masks.h"
#include "assets/tissue.h"
#include "assets/trilinear.h"
#include "tests/assets/segment/arch_phantom.h"
#include "tests/assets/segment/head_phantom.h"
#include "tests/assets/segment/overlap.h"
#include "tests/shared_data.h"

namespace {

assets::JawSegmentation segmented(const tests::ArchPhantom& phantom) {
  return assets::segmentJaw(phantom.grid, phantom.hounsfield);
}

std::string codeOf(const assets::JawSegmentation& jaw) { return jaw.refusal ? jaw.refusal->code : ""; }

double jawDice(const assets::JawSegmentation& jaw, const std::vector<std::uint8_t>& truth) {
  return tests::diceOf(
      truth.size(), [&](std::size_t v) { return jaw.label[v] != 0; }, [&](std::size_t v) { return truth[v] != 0; });
}

void expectTeeth(const assets::JawSegmentation& jaw, const std::vector<std::uint8_t>& truth, double least_dice) {
  for (const auto& [fdi, overlap] : tests::toothOverlaps(jaw.tooth, truth)) {
    EXPECT_EQ(overlap.found_fdi, fdi);
    EXPECT_GT(overlap.dice, least_dice) << fdi;
  }
}

TEST(JawSegmentation, FindsJawAndEveryToothOfAWholeArch) {
  const tests::ArchPhantom phantom = tests::archPhantom();
  const assets::JawSegmentation jaw = segmented(phantom);
  ASSERT_EQ(codeOf(jaw), "");
  EXPECT_GT(jawDice(jaw, phantom.jaw), 0.95);
  EXPECT_EQ(jaw.teeth.size(), 16u);
  expectTeeth(jaw, phantom.tooth, 0.85);
  EXPECT_NEAR(jaw.levels.cortical_hu, 1250.0, 100.0);
  EXPECT_NEAR(jaw.levels.dentine_hu, 1650.0, 130.0);
}

TEST(JawSegmentation, WhatIsFoundIsShownAsItComes) {
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = 0.8});
  std::vector<std::string> shown;
  std::vector<std::uint8_t> tooth;
  const assets::JawSegmentation jaw =
      assets::segmentJaw(phantom.grid, phantom.hounsfield, {}, {}, [&](const assets::JawSoFar& so_far) {
        shown.emplace_back(so_far.labels != nullptr ? "labels" : so_far.teeth != nullptr ? "teeth" : "jaw");
        if (so_far.labels != nullptr) tooth = so_far.labels->tooth;
        ASSERT_NE(so_far.labels == nullptr, so_far.jaw == nullptr);
      });
  EXPECT_EQ(shown, (std::vector<std::string>{"jaw", "teeth", "teeth", "labels"}));
  EXPECT_TRUE(tooth == jaw.tooth);
  const assets::JawSegmentation unwatched = assets::segmentJaw(phantom.grid, phantom.hounsfield);
  EXPECT_TRUE(jaw.label == unwatched.label && jaw.tooth == unwatched.tooth);
}

TEST(JawSegmentation, AGapKeepsTheNumbersOfTheOthers) {
  const tests::ArchPhantom phantom = tests::archPhantom({.missing = {46, 38, 34}});
  const assets::JawSegmentation jaw = segmented(phantom);
  ASSERT_EQ(codeOf(jaw), "");
  EXPECT_EQ(jaw.teeth.size(), 13u);
  expectTeeth(jaw, phantom.tooth, 0.85);
}

TEST(JawSegmentation, AMirroredJawHasTheMirroredLabels) {
  const tests::ArchPhantom phantom = tests::archPhantom(), mirrored = tests::archPhantom({.is_mirrored = true});
  const assets::JawSegmentation jaw = segmented(phantom), other = segmented(mirrored);
  ASSERT_EQ(codeOf(jaw) + codeOf(other), "");
  std::vector<std::uint8_t> back(other.label.size()), number(back.size());
  assets::forVoxels(phantom.grid, [&](glm::ivec3 p, std::size_t v) {
    const std::size_t from = phantom.grid.index({phantom.grid.size.x - 1 - p.x, p.y, p.z});
    const int fdi = other.tooth[from];
    back[v] = other.label[from];
    number[v] = static_cast<std::uint8_t>(fdi == 0 ? 0 : fdi < 40 ? fdi + 10 : fdi - 10);
  });
  EXPECT_GT(jawDice(jaw, back), 0.999);
  expectTeeth(jaw, number, 0.98);  // a layer of voxels where two teeth touch
}

TEST(JawSegmentation, AShiftedJawHasTheShiftedLabels) {
  const glm::ivec3 shift(3, -2, 1);
  const tests::ArchPhantom phantom = tests::archPhantom(), moved = tests::archPhantom({.shift = shift});
  const assets::JawSegmentation jaw = segmented(phantom), other = segmented(moved);
  ASSERT_EQ(codeOf(jaw) + codeOf(other), "");
  std::vector<std::uint8_t> back(other.label.size(), 0), number(back.size(), 0);
  assets::forVoxels(phantom.grid, [&](glm::ivec3 p, std::size_t v) {
    if (!phantom.grid.contains(p + shift)) return;
    back[v] = other.label[phantom.grid.index(p + shift)];
    number[v] = other.tooth[phantom.grid.index(p + shift)];
  });
  EXPECT_GT(jawDice(jaw, back), 0.999);
  expectTeeth(jaw, number, 0.999);
}

/// A head turned or tilted by 7° in the scanner.
TEST(JawSegmentation, ATurnedJawHasTheTurnedLabels) {
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = 0.8});
  const assets::VolumeGrid& grid = phantom.grid;
  const glm::dvec3 middle = grid.centre_P_mm(grid.size / 2);
  for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
    const glm::dquat turn = glm::angleAxis(0.122, axis);
    tests::ArchPhantom turned = phantom;
    std::ranges::fill(turned.jaw, std::uint8_t{0});
    std::ranges::fill(turned.tooth, std::uint8_t{0});
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = middle + turn * (grid.centre_P_mm(ijk) - middle);
      const glm::ivec3 at(glm::floor(grid.indexFromPoint(p))), nearest(glm::floor(grid.indexFromPoint(p) + 0.5));
      turned.hounsfield[v] = -1000;
      if (grid.contains(at) && grid.contains(at + 1))
        turned.hounsfield[v] = static_cast<std::int16_t>(
            std::lround(assets::trilinearAt(grid, p, [&](glm::ivec3 q) { return phantom.hounsfield[grid.index(q)]; })));
      if (!grid.contains(nearest)) return;
      turned.jaw[v] = phantom.jaw[grid.index(nearest)], turned.tooth[v] = phantom.tooth[grid.index(nearest)];
    });
    const assets::JawSegmentation jaw = segmented(phantom), other = segmented(turned);
    ASSERT_EQ(codeOf(jaw) + codeOf(other), "");
    EXPECT_GT(jawDice(other, turned.jaw), jawDice(jaw, phantom.jaw) - 0.03);
    expectTeeth(other, turned.tooth, 0.82);
  }
}

/// Noise, and dense lumps as of contrast medium or metal, are no jaw.
TEST(JawSegmentation, NoiseAndLumpsAreNoJaw) {
  const assets::VolumeGrid grid{{110, 110, 90}, 0.9, {0, 0, 0}};
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::normal_distribution<float> noise(60.0F, seed == 1 ? 500.0F : 80.0F);
    std::vector<std::int16_t> hu(grid.voxelCount());
    for (std::int16_t& value : hu) value = static_cast<std::int16_t>(std::lround(noise(random)));
    for (int lump = 0; lump < (seed == 1 ? 0 : 40); ++lump) {
      const glm::dvec3 at(glm::dvec3(grid.size) * glm::dvec3(share(random), share(random), share(random)));
      const double radius = 3.0 + 6.0 * share(random), level = 1400.0 + 1600.0 * share(random);
      assets::forCellsNear(at, radius, 1.0, grid.size, [&](glm::ivec3 ijk, double) {
        hu[grid.index(ijk)] = static_cast<std::int16_t>(std::lround(level));
      });
    }
    const assets::JawSegmentation jaw = assets::segmentJaw(grid, hu);
    EXPECT_TRUE(jaw.refusal) << seed << ": " << jaw.teeth.size() << " teeth";
  }
}

TEST(JawSegmentation, IsTheSameForAnyNumberOfThreads) {
  const tests::ArchPhantom phantom = tests::archPhantom({.missing = {48}, .spacing_mm = 0.8});
  const assets::JawSegmentation jaw = segmented(phantom);
  for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{8}}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const assets::JawSegmentation other = segmented(phantom);
    EXPECT_EQ(jaw.label, other.label) << threads;
    EXPECT_EQ(jaw.tooth, other.tooth) << threads;
    ASSERT_EQ(jaw.canals.size(), other.canals.size());
    for (std::size_t n = 0; n < jaw.canals.size(); ++n) EXPECT_EQ(jaw.canals[n].line_P_mm, other.canals[n].line_P_mm);
  }
}

TEST(JawSegmentation, SaysNoToAnUpperArchAndToAToothlessJaw) {
  const assets::JawSegmentation upper = segmented(tests::archPhantom({.is_upside_down = true}));
  EXPECT_EQ(codeOf(upper), "J1");
  EXPECT_TRUE(upper.tooth.empty());
  std::set<int> all;
  for (int n = 1; n <= 8; ++n) all.insert({30 + n, 40 + n});
  EXPECT_EQ(codeOf(segmented(tests::archPhantom({.missing = all}))), "J2");
}

TEST(JawSegmentation, APartOfAJawIsTooSmall) {
  EXPECT_FALSE(assets::canHoldJaw({{72, 80, 72}, 0.4, {0, 0, 0}}));
  EXPECT_TRUE(assets::canHoldJaw({{132, 169, 188}, 0.4, {0, 0, 0}}));
}

class JawSegmentationRealData : public testing::Test {
 protected:
  void SetUp() override { MOLAR_NEEDS(patients_ / "right_third_molar"); }
  const std::filesystem::path patients_ = tests::sharedData("patients");
};

/// Figures of the prototype: mandible 0.977, teeth 43 to 48 0.959 in the mean, 48 0.915 (enamel 0.93, dentine 0.83).
TEST_F(JawSegmentationRealData, ReachesTheFiguresOnARealJaw) {
  const assets::HounsfieldImage ct = assets::readHounsfield((patients_ / "right_third_molar/ct.nrrd").string());
  const auto tissue = assets::readLabels((patients_ / "right_third_molar/labels.nrrd").string()).values;
  const std::vector<std::uint8_t> tooth = tests::teethOfRightThirdMolar(patients_);
  const assets::JawSegmentation jaw = assets::segmentJaw(ct.grid, ct.hounsfield);
  ASSERT_EQ(codeOf(jaw), "");
  std::vector<std::uint8_t> mandible = tissue;
  for (std::uint8_t& value : mandible) value = value >= 1 && value <= 8 ? 1 : 0;
  EXPECT_GT(jawDice(jaw, mandible), 0.975);
  auto teeth = tests::toothOverlaps(jaw.tooth, tooth);
  double sum = 0.0;
  for (const int fdi : {43, 44, 45, 46, 47, 48}) {
    EXPECT_EQ(teeth[fdi].found_fdi, fdi);
    EXPECT_GT(teeth[fdi].dice, 0.91) << fdi;
    sum += teeth[fdi].dice;
  }
  EXPECT_GT(sum / 6.0, 0.955);
  EXPECT_GT(teeth[48].dice, 0.92) << "thin ends of its roots";
  const auto of_molar = [&](assets::Tissue wanted) {
    const auto value = static_cast<std::uint8_t>(wanted);
    return tests::diceOf(
        tooth.size(), [&](std::size_t v) { return jaw.tooth[v] == 48 && jaw.label[v] == value; },
        [&](std::size_t v) { return tooth[v] == 48 && tissue[v] == value; });
  };
  EXPECT_GT(of_molar(assets::Tissue::enamel), 0.92);
  EXPECT_GT(of_molar(assets::Tissue::dentine), 0.84);
  EXPECT_GT(of_molar(assets::Tissue::pulp), 0.75);
  // From foramen to foramen.
  ASSERT_EQ(jaw.canals.size(), 1u);
  EXPECT_TRUE(jaw.canals.front().is_right);
  const tests::CanalMisses misses = tests::canalMisses(ct.grid, tissue, jaw.canals.front());
  EXPECT_LT(misses.from_truth_mm, 0.8);
  EXPECT_LT(misses.worst_mm, 4.0);
}

}  // namespace
