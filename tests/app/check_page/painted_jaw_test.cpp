#include "app/check_page/painted_jaw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "app/check_page/check_edits.h"
#include "assets/tissue.h"

namespace app {
namespace {

/// A block of bone with two teeth in it, in voxels of half a millimetre.
class PaintedJawTest : public testing::Test {
 protected:
  PaintedJawTest() {
    ct_.grid = {{70, 66, 61}, 0.5, {-10.0, 5.0, 0.0}};
    ct_.hounsfield.resize(ct_.grid.voxelCount());
    found_.label.assign(ct_.hounsfield.size(), 0);
    found_.tooth.assign(ct_.hounsfield.size(), 0);
    std::mt19937 random(5);
    assets::forVoxels(ct_.grid, [&](glm::ivec3 p, std::size_t v) {
      const int fdi = std::abs(p.x - 20) < 7 ? 48 : std::abs(p.x - 40) < 7 ? 47 : 0;
      const bool is_bone = p.z < 45 && p.x > 5 && p.x < 60;
      if (fdi != 0 && p.z > 20 && p.z < 55) {
        found_.tooth[v] = static_cast<std::uint8_t>(fdi);
        found_.label[v] = static_cast<std::uint8_t>(p.z > 45 ? assets::Tissue::enamel : assets::Tissue::dentine);
      } else if (is_bone) {
        found_.label[v] = static_cast<std::uint8_t>(assets::Tissue::trabecular);
      }
      const int level = found_.tooth[v] != 0 ? 1650 : is_bone ? 400 : -1000;
      ct_.hounsfield[v] = static_cast<std::int16_t>(level + static_cast<int>(random() % 400) - 200);
    });
    for (const int fdi : {48, 47}) {
      assets::FoundTooth tooth;
      tooth.fdi = fdi;
      found_.teeth.push_back(tooth);
    }
    assets::takeCounts(ct_.grid, assets::toothCounts(ct_.grid, found_.tooth), found_);
  }

  assets::VoxelEdit anyEdit(std::mt19937& random) const {
    std::uniform_real_distribution<double> x(-12.0, 27.0), y(3.0, 40.0), z(-2.0, 32.0);
    const auto p = [&] { return glm::dvec3(x(random), y(random), z(random)); };
    if (random() % 8 == 0) return assets::JawCut{p(), p(), p()};
    assets::BrushStroke stroke;
    stroke.radius_mm = 0.5 + 0.25 * static_cast<double>(random() % 19);
    constexpr std::array<std::uint8_t, 5> kAs{0, 1, 48, 47, 38};
    stroke.as = kAs[random() % kAs.size()];
    for (auto n = 1 + random() % 4; n > 0; --n) stroke.way_P_mm.push_back(p());
    if (random() % 2 == 0) {
      const auto range = assets::greyLikeAt({ct_.grid, ct_.hounsfield}, stroke.way_P_mm.front());
      stroke.low_hu = range[0], stroke.high_hu = range[1];
    }
    return stroke;
  }
  /// From the beginning.
  assets::JawSegmentation painted(const std::vector<assets::VoxelEdit>& edits) const {
    assets::JawSegmentation jaw = found_;
    assets::applyVoxelEdits({ct_.grid, ct_.hounsfield}, edits, jaw);
    return jaw;
  }
  static void expectSame(const assets::JawSegmentation& a, const assets::JawSegmentation& b) {
    EXPECT_TRUE(a.label == b.label);
    EXPECT_TRUE(a.tooth == b.tooth);
    ASSERT_EQ(a.teeth.size(), b.teeth.size());
    for (std::size_t n = 0; n < a.teeth.size(); ++n) {
      EXPECT_EQ(a.teeth[n].fdi, b.teeth[n].fdi);
      EXPECT_EQ(a.teeth[n].volume_mm3, b.teeth[n].volume_mm3);
      EXPECT_EQ(a.teeth[n].told_fdi, b.teeth[n].told_fdi);
    }
  }

  assets::CtVolume ct_;
  assets::JawSegmentation found_;
};

/// 1,000 random strokes, cuts, undos and redos: what is shown is what the log's text makes, and after full undo what
/// was found.
TEST_F(PaintedJawTest, FollowsAThousandEditsAndUndosAsAReplayOfTheLogDoes) {
  std::mt19937 random(11);
  PaintedJaw jaw(ct_, {});
  jaw.take(found_);
  std::vector<std::uint8_t> seen = found_.tooth;
  const auto show = [&](const glm::ivec3& ijk, assets::VoxelLabel now) { seen[ct_.grid.index(ijk)] = now.tooth; };
  CheckEdits edits;
  for (int n = 0; n < 1000; ++n) {
    const auto what = random() % 9;
    if (what < 3)
      edits.undo();
    else if (what < 5)
      edits.redo();
    else
      std::visit([&edits](const auto& edit) { edits.add(edit); }, anyEdit(random));
    ASSERT_TRUE(jaw.follow(edits.clicks().voxels, show));
    if (n % 100 == 99) {
      expectSame(jaw.jaw(), painted(CheckEdits::fromText(edits.text(), "log").clicks().voxels));
      EXPECT_TRUE(seen == jaw.jaw().tooth);
    }
  }
  while (edits.undo()) {
  }
  ASSERT_TRUE(jaw.follow(edits.clicks().voxels, show));
  expectSame(jaw.jaw(), found_);
  EXPECT_TRUE(seen == found_.tooth);
}

TEST_F(PaintedJawTest, AStrokeDrawnDabByDabIsTheSameEdit) {
  std::mt19937 random(3);
  PaintedJaw jaw(ct_, {});
  jaw.take(found_);
  assets::BrushStroke stroke, drawn;
  stroke.as = 38, stroke.radius_mm = 2.0;
  for (int n = 0; n < 30; ++n) stroke.way_P_mm.emplace_back(-5.0 + 0.7 * n, 20.0 + 0.2 * n, 10.0);
  drawn.as = 38, drawn.radius_mm = 2.0;
  for (const glm::dvec3& p : stroke.way_P_mm) {
    drawn.way_P_mm.push_back(p);
    jaw.dab(drawn, drawn.way_P_mm.size() - 1, [](const glm::ivec3&, assets::VoxelLabel) {});
  }
  jaw.endStroke(drawn);
  expectSame(jaw.jaw(), painted({stroke}));
  // The painted tooth is a person's, and goes with its stroke.
  EXPECT_EQ(jaw.jaw().teeth.back().told_fdi, 38);
  ASSERT_TRUE(jaw.follow({}, [](const glm::ivec3&, assets::VoxelLabel) {}));
  expectSame(jaw.jaw(), found_);
  jaw.dab(drawn, 0, [](const glm::ivec3&, assets::VoxelLabel) {});
  jaw.leaveStroke([](const glm::ivec3&, assets::VoxelLabel) {});
  expectSame(jaw.jaw(), found_);
}

TEST_F(PaintedJawTest, WhatWasForgottenIsAskedForAnew) {
  std::mt19937 random(2);
  constexpr std::size_t kLittle_bytes = 60000;
  PaintedJaw jaw(ct_, {}, kLittle_bytes);
  jaw.take(found_);
  std::vector<assets::VoxelEdit> edits;
  const auto show = [](const glm::ivec3&, assets::VoxelLabel) {};
  for (int n = 0; n < 60; ++n) {
    edits.push_back(anyEdit(random));
    ASSERT_TRUE(jaw.follow(edits, show));
    EXPECT_LE(jaw.keptBytes(), kLittle_bytes);
  }
  const assets::JawSegmentation whole = jaw.jaw();
  std::vector<assets::VoxelEdit> less(edits.begin(), edits.begin() + 5);
  EXPECT_FALSE(jaw.follow(less, show));
  expectSame(jaw.jaw(), whole);
  jaw.take(found_);
  ASSERT_TRUE(jaw.follow(less, show));
  expectSame(jaw.jaw(), painted(less));
}

/// A ball of 2 mm in half millimetres: 4/3 pi 4^3 voxels; grey values keep it to the tooth.
TEST_F(PaintedJawTest, PaintsABallAndOnlyWhatIsAlike) {
  assets::BrushStroke ball;
  ball.as = 38, ball.radius_mm = 2.0;
  ball.way_P_mm = {ct_.grid.centre_P_mm({52, 30, 30})};
  const auto count = [](const assets::JawSegmentation& jaw, int fdi) {
    return static_cast<double>(std::ranges::count(jaw.tooth, static_cast<std::uint8_t>(fdi)));
  };
  EXPECT_NEAR(count(painted({ball}), 38), 268.0, 15.0);
  ball.way_P_mm = {ct_.grid.centre_P_mm({46, 30, 30})};
  ball.low_hu = 1300, ball.high_hu = 2000;
  const assets::JawSegmentation jaw = painted({ball});
  assets::forVoxels(ct_.grid, [&](glm::ivec3, std::size_t v) {
    if (jaw.tooth[v] == 38) {
      EXPECT_EQ(found_.tooth[v], 47);
    }
  });
  EXPECT_GT(count(jaw, 38), 60.0);
  // Of another tooth it keeps its tissue.
  assets::forVoxels(ct_.grid, [&](glm::ivec3, std::size_t v) {
    if (jaw.tooth[v] == 38) {
      EXPECT_EQ(jaw.label[v], found_.label[v]);
    }
  });
}

TEST_F(PaintedJawTest, ACutTakesWhatLiesBeyondItsLineAndNoWiderThanIt) {
  const assets::JawCut cut{{-10.0, 20.0, 15.0}, {5.0, 20.0, 15.0}, {0.0, 20.0, 25.0}};
  const assets::JawSegmentation jaw = painted({cut});
  assets::forVoxels(ct_.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct_.grid.centre_P_mm(ijk);
    const bool goes = p.z > 15.0 && p.x >= -10.0 && p.x <= 5.0;
    ASSERT_EQ(jaw.label[v], goes ? 0 : found_.label[v]);
  });
}

}  // namespace
}  // namespace app
