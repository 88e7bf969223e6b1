#include "app/procedure/debris/follicle.h"

#include <gtest/gtest.h>

#include "assets/tissue.h"

namespace app {
namespace {

FollicleBlob blobAt(const glm::dvec3& at_P_mm, double volume_mm3 = 4.0) {
  FollicleBlob blob;
  blob.at_P_mm = at_P_mm;
  blob.volume_mm3 = volume_mm3;
  blob.radius_mm = 1.0;
  return blob;
}

/// A curette that presses with `press_N` downwards and is drawn along x.
struct Scraping {
  Follicle follicle{{blobAt({0, 0, -1}), blobAt({0, 12, -1}, 12.0)}};
  haptics::Tool tool = haptics::handInstrumentTool(haptics::HandInstrument::curette);
  haptics::Tick tick;

  explicit Scraping(double press_N = 1.0) {
    tick.dt_s = 1e-3;
    tick.depth_mm = 0.1;
    tick.law_force_P_N.xyz = {0.0, 0.0, press_N};
  }
  void draw(double way_mm, const glm::dvec3& along = {1, 0, 0}, const std::optional<SuctionTip>& tip = {}) {
    const double step_mm = 0.01;
    for (int n = 0; n * step_mm < way_mm; ++n) {
      tick.proxy_P.mm = (n / 20 % 2 == 0 ? n % 20 : 20 - n % 20) * step_mm * along;
      follicle.follow(tick, tool, tip);
    }
  }
  FollicleBlob::State state(std::size_t n = 0) const { return follicle.blobs()[n].state; }
};

TEST(Follicle, ComesLooseWhenItIsScrapedFarEnough) {
  Scraping curette;
  curette.draw(0.9 * kScraped_mm);
  EXPECT_EQ(curette.state(), FollicleBlob::State::stuck);
  curette.draw(0.2 * kScraped_mm);
  EXPECT_EQ(curette.state(), FollicleBlob::State::loose);
  EXPECT_EQ(curette.state(1), FollicleBlob::State::stuck) << "out of reach";
  EXPECT_NEAR(curette.follicle.left().value(), 1.0, 1e-12) << "loose is not taken";
}

TEST(Follicle, IsLooseWhereNothingIsBesideItAnyMore) {
  Follicle follicle{{blobAt({0, 0, -1}), blobAt({0, 12, -1}, 12.0)}};
  double asked_mm = 0.0;
  follicle.letLoose([&](const glm::dvec3& p, double within_mm) {
    asked_mm = within_mm;
    return p.y > 5.0;
  });
  EXPECT_EQ(follicle.blobs()[0].state, FollicleBlob::State::stuck);
  EXPECT_EQ(follicle.blobs()[1].state, FollicleBlob::State::loose);
  EXPECT_DOUBLE_EQ(asked_mm, 1.0 + kHolds_mm);
}

TEST(Follicle, StaysUnderALightOrPressingHandOrAnotherInstrument) {
  Scraping light(0.9 * kScrape_N);
  light.draw(5.0 * kScraped_mm);
  EXPECT_EQ(light.state(), FollicleBlob::State::stuck);
  Scraping pressing;
  pressing.draw(5.0 * kScraped_mm, {0, 0, 1});
  EXPECT_EQ(pressing.state(), FollicleBlob::State::stuck) << "into the wall, not along it";
  Scraping file;
  file.tool = haptics::handInstrumentTool(haptics::HandInstrument::bone_file);
  file.draw(5.0 * kScraped_mm);
  EXPECT_EQ(file.state(), FollicleBlob::State::stuck);
}

TEST(Follicle, SuctionTakesWhatIsLooseAlone) {
  Scraping run;
  run.draw(1.1 * kScraped_mm);
  ASSERT_EQ(run.state(), FollicleBlob::State::loose);
  run.tool = haptics::handInstrumentTool(haptics::HandInstrument::suction);
  for (const double y_mm : {0.0, 12.0}) run.draw(20.0, {0, 0, 0}, SuctionTip{{0.0, y_mm, 1.5}, true});
  EXPECT_EQ(run.state(0), FollicleBlob::State::taken);
  EXPECT_EQ(run.state(1), FollicleBlob::State::stuck);
  EXPECT_NEAR(run.follicle.left().value(), 0.75, 1e-12);
}

TEST(Follicle, ATurningBurTearsIt) {
  Scraping run;
  run.tool = {};
  run.tool.head.radius_mm = 2.0;
  run.draw(0.5);
  EXPECT_EQ(run.state(), FollicleBlob::State::stuck);
  run.tick.drilling = true;
  run.draw(0.5);
  EXPECT_EQ(run.state(), FollicleBlob::State::taken);
}

TEST(Follicle, WithoutAnyNothingIsLeft) { EXPECT_FALSE(Follicle({}).left()); }

/// A ball of enamel of 4 mm with a shell of ligament of 1.5 mm: blobs all around, each flat on the ball, together its
/// volume but for the few voxels whose enamel the flood takes for farther than it is.
TEST(Follicle, IsTheShellAroundTheCrown) {
  assets::Patient patient;
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{64, 64, 64}, 0.25, glm::dvec3(-7.875)};
  ct.label.assign(ct.grid.voxelCount(), 0);
  ct.solid = ct.label;
  double shell_mm3 = 0.0;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double from_middle_mm = glm::length(ct.grid.centre_P_mm(ijk));
    if (from_middle_mm < 4.0) ct.label[v] = static_cast<std::uint8_t>(assets::Tissue::enamel);
    if (from_middle_mm < 4.0 || from_middle_mm > 5.5) return;
    ct.label[v] = static_cast<std::uint8_t>(assets::Tissue::ligament);
    shell_mm3 += ct.grid.voxelVolume_mm3();
  });
  EXPECT_TRUE(follicleOf(patient).empty()) << "no site";
  patient.site.emplace();
  const std::vector<FollicleBlob> blobs = follicleOf(patient);
  ASSERT_GE(blobs.size(), 8u);
  ASSERT_LE(blobs.size(), kMostBlobs);
  double sum_mm3 = 0.0;
  for (const FollicleBlob& blob : blobs) {
    sum_mm3 += blob.volume_mm3;
    EXPECT_NEAR(glm::length(blob.at_P_mm), 4.6, 0.5);
    EXPECT_GT(glm::dot(blob.outward_P, glm::normalize(blob.at_P_mm)), 0.98);
  }
  EXPECT_NEAR(sum_mm3, shell_mm3, 0.01 * shell_mm3);
}

}  // namespace
}  // namespace app
