#include "app/session/measures/sight.h"
#include "app/session/measures/sight_lines.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "assets/instrument/dental_mirror.h"
#include "tests/app/session/measures/removal.h"
#include "tests/mutants.h"

namespace app {
namespace {

using test::Removal;

constexpr double kSurface_mm = 4.0;

Removal flatCut() {
  Removal cut({40, 40, 40});
  cut.fill([](const glm::dvec3& p) { return p.z - kSurface_mm; });
  for (int n = 0; n < 30; ++n) cut.ball({3.0 + 0.1 * n, 5.0, kSurface_mm + 0.6});
  return cut;
}

std::optional<double> outOfSight(const Removal& cut, const EyesPlace& eyes, const assets::SoftTissueField& soft = {},
                                 bool held = false) {
  const std::vector<EyesFrom> from{{0.0, eyes}};
  const std::vector<HeldFrom> holds{{0.0, held, held}};
  return sightOfWork(cut.clock(), {cut.before, cut.after, soft, from, holds}).hidden;
}

/// The shortest turn of one unit direction onto another.
glm::dquat turnFrom(const glm::dvec3& from, const glm::dvec3& to) {
  return glm::normalize(glm::dquat(1.0 + glm::dot(from, to), glm::cross(from, to)));
}

/// A mirror at a place with its glass towards a direction.
SecondHandPlace mirrorAt(const glm::dvec3& centre_P_mm, const glm::dvec3& out_P) {
  SecondHandPlace place{assets::SecondInstrument::mirror, true, {}};
  place.X_PO = {turnFrom(assets::mirrorGlassNormal(), glm::normalize(out_P)), centre_P_mm};
  return place;
}

SightOfWork seenWith(const Removal& cut, const EyesPlace& eyes, const SecondHandPlace& mirror, double from_s = 0.0,
                     std::span<const WorkingEnd> ends = {}) {
  const std::vector<EyesFrom> from{{0.0, eyes}};
  const assets::SoftTissueField soft;
  SecondHandTrack track;
  track.add(from_s, mirror);
  SeenWork work{cut.before, cut.after, soft, from, {}};
  work.second_hand = &track;
  work.ends = ends;
  return sightOfWork(cut.clock(), work);
}

constexpr EyesPlace kAbove{{-26.0, 5.0, 400.0}, {36.0, 5.0, 400.0}, true},
    kBelow{{5.0, 5.0, -400.0}, {6.0, 5.0, -400.0}, true};

TEST(Sight, WhatIsCutBeforeTheEyesIsSeen) { EXPECT_NEAR(outOfSight(flatCut(), kAbove).value(), 0.0, 0.05); }

TEST(Sight, WhatIsCutBehindAWallIsNot) {
  EXPECT_EQ(outOfSight(flatCut(), kBelow), 1.0);
  EXPECT_NEAR(outOfSight(flatCut(), {kBelow.left_P_mm, kAbove.right_P_mm, true}).value(), 0.0, 0.05)
      << "one eye is enough";
}

// Eyes below the bone, the cut on top of it: light goes up to a mirror above and past the bone's edge down to them.
TEST(Sight, WhatIsCutBehindAWallIsSeenInAMirrorThatShowsIt) {
  const Removal cut = flatCut();
  const glm::dvec3 site_mm(4.5, 5.0, kSurface_mm), glass_mm(25.0, 5.0, 30.0);
  const EyesPlace eyes{{60.0, 5.0, -400.0}, {61.0, 5.0, -400.0}, true};
  const glm::dvec3 to_site = glm::normalize(site_mm - glass_mm), to_eye = glm::normalize(eyes.left_P_mm - glass_mm);
  EXPECT_EQ(outOfSight(cut, eyes), 1.0);
  const SecondHandPlace mirror = mirrorAt(glass_mm, to_site + to_eye);
  const SightOfWork seen = seenWith(cut, eyes, mirror);
  EXPECT_NEAR(seen.hidden.value(), 0.0, 0.05);
  EXPECT_NEAR(seen.in_mirror.value(), 1.0, 0.05);
  // Half of the time, half of what went.
  const SightOfWork half = seenWith(cut, eyes, mirror, 0.5 * cut.ticks.back().t_s);
  EXPECT_GT(half.hidden.value(), 0.3);
  EXPECT_LT(half.hidden.value(), 0.9);
  EXPECT_NEAR(half.hidden.value() + half.in_mirror.value(), 1.0, 1e-12);

  const auto hidden = [&](const SecondHandPlace& place) { return seenWith(cut, eyes, place).hidden.value(); };
  EXPECT_EQ(hidden(mirrorAt(glass_mm, -(to_site + to_eye))), 1.0) << "its back shows nothing";
  EXPECT_EQ(hidden(mirrorAt(glass_mm, to_site + to_eye + glm::dvec3(0.0, 0.4, 0.0))), 1.0) << "turned aside";
  SecondHandPlace retractor = mirror;
  retractor.instrument = assets::SecondInstrument::retractor;
  EXPECT_EQ(hidden(retractor), 1.0) << "steel of another form";
  SecondHandPlace lost = mirror;
  lost.is_tracked = false;
  EXPECT_EQ(hidden(lost), 1.0);
}

TEST(Sight, AMirrorBeforeTheEyesHidesWhatLiesBehindIt) {
  const Removal cut = flatCut();
  const EyesPlace above{{4.0, 5.0, 400.0}, {5.0, 5.0, 400.0}, true};
  const SecondHandPlace over = mirrorAt({4.5, 5.0, 30.0}, {0.0, 0.0, 1.0});
  EXPECT_NEAR(outOfSight(cut, above).value(), 0.0, 0.05);
  EXPECT_EQ(seenWith(cut, above, over).hidden, 1.0);
  EXPECT_EQ(seenWith(cut, above, over).in_mirror, 0.0);
}

TEST(Sight, ViewOfTheMirrorIsTheTimeItShowsTheWorkingEnd) {
  const Removal cut = flatCut();
  const glm::dvec3 site_mm(4.5, 5.0, kSurface_mm + 1.0), glass_mm(25.0, 5.0, 30.0);
  const EyesPlace eyes{{60.0, 5.0, -400.0}, {61.0, 5.0, -400.0}, true};
  const SecondHandPlace mirror =
      mirrorAt(glass_mm, glm::normalize(site_mm - glass_mm) + glm::normalize(eyes.left_P_mm - glass_mm));
  std::vector<WorkingEnd> ends;
  for (int n = 0; n < 40; ++n) ends.push_back({0.1 * n, 0.1, n < 30 ? site_mm : site_mm + glm::dvec3(0.0, 60.0, 0.0)});
  EXPECT_NEAR(seenWith(cut, eyes, mirror, 1.0, ends).mirror_view_s, 2.0, 1e-9) << "from 1 s to 3 s";
}

TEST(Sight, SoftTissueHidesUntilItIsHeldAside) {
  assets::SoftTissueField cheek;
  cheek.grid = {{14, 14, 14}, 1.5, {-4.0, -4.0, 0.0}};
  cheek.distance.assign(cheek.grid.voxelCount(), assets::SoftTissueField::stored(10.0));
  cheek.tissue.assign(cheek.grid.voxelCount(), static_cast<std::uint8_t>(assets::SoftTissue::cheek));
  assets::forVoxels(cheek.grid, [&](glm::ivec3 ijk, std::size_t v) {
    cheek.distance[v] = assets::SoftTissueField::stored(std::abs(cheek.grid.centre_P_mm(ijk).z - 12.0) - 3.0);
  });
  EXPECT_EQ(outOfSight(flatCut(), kAbove, cheek), 1.0);
  EXPECT_NEAR(outOfSight(flatCut(), kAbove, cheek, true).value(), 0.0, 0.05);
}

TEST(Sight, WhereTheBurWorksIsSeenOrNotWhileItWorks) {
  Removal cut({40, 40, 40});
  cut.fill([](const glm::dvec3& p) { return p.z - kSurface_mm; });
  haptics::Tick tick;
  tick.proxy_P.mm = {5.0, 5.0, kSurface_mm + 0.6};
  cut.ball(tick.proxy_P.mm);
  const assets::SoftTissueField none;
  const SightLines lines{cut.grid, cut.after, none, {}};
  tick.drilling = true;
  tick.removed_mm3 = 0.01;
  const haptics::BurShape ball{haptics::ShapeKind::sphere, 1.0, 0.0};
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, kAbove));
  EXPECT_TRUE(worksOutOfSight(lines, tick, ball, kBelow));
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, {kBelow.left_P_mm, kAbove.right_P_mm, true})) << "one eye is enough";
  tick.removed_mm3 = 0.0;
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, kBelow)) << "nothing goes";
  tick.removed_mm3 = 0.01;
  tick.proxy_P.mm.z = 8.0;
  EXPECT_FALSE(worksOutOfSight(lines, tick, ball, kBelow)) << "off the bone";
}

TEST(Sight, NothingCutHasNoShare) {
  Removal cut({8, 8, 8});
  cut.fill([](const glm::dvec3& p) { return p.z - 1.0; });
  EXPECT_FALSE(outOfSight(cut, kAbove));
}

TEST(EyesEvent, ReadsWhatItWrites) {
  const EyesPlace eyes{{1.5, -2.0, 1e3}, {64.5, -2.0, 1e3}, true};
  const auto read = eyesFrom(eyesText(eyes));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->left_P_mm, eyes.left_P_mm);
  EXPECT_EQ(read->right_P_mm, eyes.right_P_mm);
  EXPECT_TRUE(read->in_stereo);
  for (const char* text : {"", "{}", "[1]", R"({"left_P_mm":[1,2],"right_P_mm":[1,2,3]})",
                           R"({"left_P_mm":[1,2,1e9],"right_P_mm":[1,2,3]})"})
    EXPECT_FALSE(eyesFrom(text)) << text;
}

TEST(SecondHandEvent, ReadsWhatItWritesToTheLastBit) {
  SecondHandPlace place{assets::SecondInstrument::retractor, true, {}};
  place.X_PO = {glm::normalize(glm::dquat(0.3, -0.1, 0.7, 1.0 / 3.0)), {1.0 / 7.0, -20.1, 1e-9}};
  const auto read = secondHandFrom(secondHandText(place));
  ASSERT_TRUE(read);
  EXPECT_TRUE(isSamePlace(*read, place));
  place.X_PO.translation_mm.x = std::nextafter(place.X_PO.translation_mm.x, 1.0);
  EXPECT_FALSE(isSamePlace(*read, place));
  const SecondHandPlace lost{assets::SecondInstrument::mirror, false, {}};
  EXPECT_TRUE(isSamePlace(secondHandFrom(secondHandText(lost)).value(), lost));
  for (const char* text :
       {"", "{}", "[]", R"({"instrument":"spoon"})", R"({"instrument":"mirror","rotation_PO":[1,0,0,0]})",
        R"({"instrument":"mirror","rotation_PO":[1,1,0,0],"translation_PO_mm":[0,0,0]})",
        R"({"instrument":"mirror","rotation_PO":[1,0,0,0],"translation_PO_mm":[0,1e9,0]})"})
    EXPECT_FALSE(secondHandFrom(text)) << text;
}

TEST(SecondHandEvent, MutantsAreReadOrNot) {
  SecondHandPlace place{assets::SecondInstrument::mirror, true, {}};
  place.X_PO.translation_mm = {-27.25, 38.5, 1.0 / 3.0};
  const std::vector<std::string> good{secondHandText(place), secondHandText({})};
  std::uint64_t refused = 0, tried = 0;
  mutants::forEachMutant(good, 3000, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    const auto read = secondHandFrom(mutant);
    ++tried, refused += read ? 0 : 1;
    if (!read) return;
    const auto disc = mirrorDiscOf(read);
    EXPECT_TRUE(!disc || (std::abs(glm::length(disc->out_P) - 1.0) < 1e-5 && glm::length(disc->centre_P_mm) < 2e5));
    EXPECT_TRUE(isSamePlace(secondHandFrom(secondHandText(*read)).value(), *read)) << mutant;
  });
  EXPECT_GT(refused, tried / 3);
}

TEST(SecondHandTrack, HasThePlaceThatHadBegun) {
  SecondHandTrack track;
  EXPECT_FALSE(track.at(1.0));
  SecondHandPlace here{assets::SecondInstrument::mirror, true, {}};
  track.add(1.0, here);
  track.add(2.0, {assets::SecondInstrument::mirror, false, {}});
  here.X_PO.translation_mm.x = 5.0;
  track.add(3.0, here);
  EXPECT_FALSE(track.at(0.9));
  EXPECT_EQ(track.at(1.0).value().X_PO.translation_mm.x, 0.0);
  EXPECT_FALSE(track.at(2.5)) << "lost";
  EXPECT_EQ(track.at(99.0).value().X_PO.translation_mm.x, 5.0);
}

}  // namespace
}  // namespace app
