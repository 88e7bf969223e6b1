// Opposing teeth of a mesh and of a scan: where they stand over the tooth, and what is refused.
#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "app/procedure/preparation/bite.h"
#include "app/procedure/preparation/given_antagonist.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "tests/app/procedure/preparation/cusps.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace app::round_tooth {
namespace {

using testing::HasSubstr;

const Scene& stood() {
  static const Scene kScene(0.08, true);
  return kScene;
}
const OcclusalRaster& intact() {
  static const OcclusalRaster kIntact = occlusalHeights(stood().crown, stood().crown.solid);
  return kIntact;
}

/// z = level + slope x over a square of the tooth's frame; closed: a slab of 3 mm.
std::vector<assets::StlTriangle> slab(double half_mm, double level_mm, double slope, bool is_closed,
                                      const glm::dvec2& middle = glm::dvec2(0.0)) {
  const auto at = [&](int x, int y, double over_mm) {
    const glm::dvec2 p = middle + half_mm * glm::dvec2(x, y);
    return stood().frame.inP({p, level_mm + slope * p.x + over_mm});
  };
  std::vector<assets::StlTriangle> mesh;
  for (const double over_mm : {0.0, 3.0}) {
    if (over_mm > 0.0 && !is_closed) continue;
    mesh.push_back({at(-1, -1, over_mm), at(1, -1, over_mm), at(1, 1, over_mm)});
    mesh.push_back({at(-1, -1, over_mm), at(1, 1, over_mm), at(-1, 1, over_mm)});
  }
  return mesh;
}
GivenAntagonist givenBy(const std::vector<assets::StlTriangle>& mesh) {
  return givenAntagonist(mesh, stood().frame, intact(), std::string(64, 'b'), "--antagonist f.stl");
}
std::string refusalOf(const std::vector<assets::StlTriangle>& mesh) {
  return tests::refusalOf<UsageError>([&] { givenBy(mesh); });
}
std::string binary(const std::vector<assets::StlTriangle>& mesh) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(mesh.size()));
  for (const auto& face : mesh) {
    put(glm::vec3(0.0F));
    for (const glm::dvec3& p : face) put(glm::vec3(p));
    put(std::uint16_t{0});
  }
  return bytes;
}

TEST(GivenAntagonist, AMeshStandsOverTheToothWhereItsLowestFaceDoes) {
  for (const bool is_closed : {false, true}) {
    const GivenAntagonist given = givenBy(slab(6.0, 7.4, 0.1, is_closed));
    EXPECT_FALSE(given.is_arch);
    const assets::PreparedTooth tooth{46, stood().frame, "class-1", "", {}, {}, given.teeth};
    const Antagonist opposes = antagonistOf(stood().crown, intact(), tooth);
    EXPECT_FALSE(opposes.is_made);
    EXPECT_NEAR(opposes.middle_mm.x, 0.0, 0.1);
    for (const glm::dvec2& place : {glm::dvec2(0.0), glm::dvec2(3.13, -2.02), glm::dvec2(-5.9, 5.9)})
      EXPECT_NEAR(static_cast<double>(opposes.height_mm.at(place)), 7.4 + 0.1 * place.x, 1e-5);
    EXPECT_TRUE(std::isnan(opposes.height_mm.at(glm::dvec2(6.2, 0.0))));
    // A flat tooth of 7 mm and a radius of 5: nearest at its distal rim, 0.5 mm lower there.
    const Bite bite = biteOn(intact(), opposes, 0.04);
    EXPECT_NEAR(bite.open_mm, 0.1, 0.03);
  }
}

TEST(GivenAntagonist, ABroadOneIsAnArch) { EXPECT_TRUE(givenBy(slab(20.0, 7.0, 0.0, false, {12.0, 0.0})).is_arch); }

TEST(GivenAntagonist, TheHingeLiesBehindTheToothAndTurnsTheJawsOpen) {
  EXPECT_EQ(usualHinge_mm(46), glm::dvec2(55.0, 32.0));
  EXPECT_EQ(usualHinge_mm(11).x, 80.0);
  for (const double back_mm : {55.0, 20.0}) {
    assets::PreparedTooth tooth{46, stood().frame, "class-1", "", {}, {}, givenBy(slab(6.0, 7.0, 0.0, false)).teeth};
    tooth.bite = {assets::Closing::hinge, hinge_P_mm(stood().crown, {back_mm, 32.0})};
    const Antagonist opposes = antagonistOf(stood().crown, intact(), tooth);
    const glm::dvec3 arm = glm::dvec3(opposes.middle_mm, stood().crown.top_mm) - opposes.hinge_mm;
    EXPECT_NEAR(glm::length(arm), std::hypot(back_mm, 32.0), 0.2);
    EXPECT_GT(glm::cross(opposes.opens, arm).z, 0.0);
    EXPECT_NEAR(std::abs(glm::dot(stood().frame.axes_P * opposes.opens, glm::dvec3(1.0, 0.0, 0.0))), 1.0, 1e-9);
  }
}

TEST(GivenAntagonist, RefusesWhatDoesNotMeetTheTooth) {
  EXPECT_THAT(refusalOf(slab(6.0, 7.0, 0.0, true, {30.0, 0.0})), HasSubstr("nothing of it stands over the tooth"));
  EXPECT_THAT(refusalOf(slab(6.0, 5.0, 0.0, true)), HasSubstr("2.0 mm deep in the tooth"));
  EXPECT_THAT(refusalOf(slab(6.0, 16.0, 0.0, true)), HasSubstr("9.0 mm over the tooth"));
  EXPECT_THAT(refusalOf({}), HasSubstr("nothing of it stands over the tooth"));
  const std::vector<assets::StlTriangle> many(40'000, slab(50.0, 7.0, 0.0, false)[0]);
  EXPECT_THAT(refusalOf(many), HasSubstr("too large and too many"));
}

TEST(GivenAntagonist, RefusesFilesInOneLine) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("molar_antagonist_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto refusal = [&](const std::string& bytes) {
    std::ofstream(folder / "a.stl", std::ios::binary) << bytes;
    return tests::refusalOf<UsageError>(
        [&] { readAntagonist((folder / "a.stl").string(), stood().crown, "--antagonist"); });
  };
  for (const std::string& bytes :
       {std::string(), std::string("solid"), std::string(100, 'x'), binary(slab(6.0, 7.0, 0.0, true)).substr(0, 200)}) {
    const std::string line = refusal(bytes);
    EXPECT_THAT(line, HasSubstr("--antagonist ")) << bytes.size();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  EXPECT_EQ(refusal(binary(slab(6.0, 7.0, 0.0, true))), "accepted") << "as it should be";
  std::filesystem::remove_all(folder);
  EXPECT_THAT(tests::refusalOf<UsageError>([&] { readAntagonist("/nowhere.stl", stood().crown, "--antagonist"); }),
              HasSubstr("/nowhere.stl"));
}

TEST(GivenAntagonist, MutantsOfAMeshAreReadOrRefused) {
  std::size_t read = 0;
  mutants::forEachMutant(
      {binary(slab(6.0, 7.2, 0.05, true))}, 1500, [&](const std::string& bytes, std::size_t, std::uint64_t) {
        try {
          const GivenAntagonist given = givenAntagonist(assets::stlTriangles(bytes, "a.stl"), stood().frame, intact(),
                                                        std::string(64, 'c'), "--antagonist a.stl");
          ++read;
          for (const float height : given.teeth.height_mm)
            ASSERT_TRUE(std::isnan(height) || (height > 0.0F && height < 30.0F));
        } catch (const UsageError&) {
        } catch (const assets::LoadError&) {
        }
      });
  EXPECT_GT(read, 100u);
}

/// A scan of both jaws: a block of tooth 16 over the tooth.
assets::CtVolume scanWith(double level_mm) {
  assets::CtVolume ct;
  ct.grid = {{60, 60, 60}, 0.4, glm::dvec3(-12.0, -12.0, -4.0)};
  const std::size_t count = ct.grid.voxelCount();
  ct.solid.assign(count, 0), ct.label.assign(count, 0), ct.tooth.assign(count, 0);
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = stood().frame.local(ct.grid.centre_P_mm(ijk));
    if (p.z < level_mm - 1.0 || std::hypot(p.x, p.y) > 6.0) return;
    ct.tooth[v] = 16;
    ct.solid[v] = shapes::bytesOf(p.z - level_mm, ct.grid.spacing_mm);
  });
  return ct;
}

TEST(GivenAntagonist, AScanOfBothJawsOpposesItsTeeth) {
  EXPECT_TRUE(hasOpposingTeeth(scanWith(7.0), 46));
  EXPECT_TRUE(hasOpposingTeeth(scanWith(7.0), 36));
  EXPECT_FALSE(hasOpposingTeeth(scanWith(7.0), 17));
  const auto heightOf = [](const GivenAntagonist& given) {
    constexpr std::size_t kMiddle = assets::OpposingTeeth::kSide / 2;
    return static_cast<double>(given.teeth.height_mm[kMiddle * assets::OpposingTeeth::kSide + kMiddle]);
  };
  const auto near = scannedAntagonist(scanWith(7.3), 46, stood().crown);
  ASSERT_TRUE(near);
  EXPECT_NEAR(heightOf(*near), 7.3, 0.03);
  EXPECT_TRUE(near->remark.empty());
  EXPECT_TRUE(near->teeth.digest.empty());
  // Voxels of teeth that meet overlap a little; jaws that were open are closed.
  for (const double level_mm : {6.8, 12.0}) {
    const auto met = scannedAntagonist(scanWith(level_mm), 46, stood().crown);
    ASSERT_TRUE(met);
    EXPECT_NEAR(heightOf(*met), 7.0, 0.06) << level_mm;
    EXPECT_EQ(met->remark.empty(), level_mm < 10.0);
  }
  EXPECT_FALSE(scannedAntagonist(scanWith(5.0), 46, stood().crown)) << "it stands in the tooth";
}

}  // namespace
}  // namespace app::round_tooth
