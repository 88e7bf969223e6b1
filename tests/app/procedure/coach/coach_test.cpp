#include "app/procedure/coach/coach.h"

#include <cmath>

#include <gtest/gtest.h>

#include "app/procedure/coach/coach_file.h"
#include "assets/load_error.h"
#include "tests/app/session/measures/bur_path.h"

namespace app {
namespace {

using bur_path::sampleAt;

struct Said {
  double t_s = 0.0;
  std::string words;
};

/// With the shipped rules, asked after each sample.
std::vector<Said> said(const std::vector<WorkSample>& samples, const CoachRules& rules = coachRulesOf("")) {
  Coach coach(rules);
  std::vector<Said> all;
  for (const WorkSample& sample : samples) {
    coach.add(sample);
    if (auto words = coach.take()) all.push_back({sample.t_s, *words});
  }
  return all;
}

/// A light, shallow, moving hand with water, to and fro.
std::vector<WorkSample> goodWork(double seconds) {
  std::vector<WorkSample> samples;
  for (double from_s = 0.0; from_s < seconds;) {
    std::vector<WorkSample> pass = bur_path::raster(8, 0.1);
    for (WorkSample& sample : pass) {
      sample.t_s += from_s;
      samples.push_back(sample);
    }
    from_s = samples.back().t_s + 1e-3;
  }
  return samples;
}

TEST(Coach, GoodWorkIsNotSpokenInto) { EXPECT_TRUE(said(goodWork(10.0)).empty()); }

TEST(Coach, DryDrillingIsSaidAfterASecond) {
  std::vector<WorkSample> samples = goodWork(3.0);
  for (WorkSample& sample : samples) sample.irrigated = sample.t_s < 1.0;
  const std::vector<Said> all = said(samples);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].t_s, 2.0, 0.01);
  EXPECT_EQ(all[0].words, "water on: you are drilling dry");
}

TEST(Coach, TheMoreImportantIsSaidFirstAndTheOtherAPauseLater) {
  std::vector<WorkSample> samples = goodWork(8.0);
  for (WorkSample& sample : samples) {
    sample.irrigated = false;
    sample.force_P_N = {0.0, 0.0, sample.t_s > 0.3 ? 6.0 : 1.0};
  }
  const std::vector<Said> all = said(samples);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].words, "lighter: let the bur do the work");
  EXPECT_EQ(all[1].words, "water on: you are drilling dry");
  EXPECT_GE(all[1].t_s - all[0].t_s, 3.0);
  EXPECT_LT(all[1].t_s - all[0].t_s, 3.1);
}

TEST(Coach, TheSameIsNotSaidAgainSoon) {
  std::vector<WorkSample> samples = goodWork(40.0);
  for (WorkSample& sample : samples) sample.irrigated = false;
  const std::vector<Said> all = said(samples);
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t n = 1; n < all.size(); ++n) EXPECT_GE(all[n].t_s - all[n - 1].t_s, 15.0);
}

TEST(Coach, WorkOutOfSightIsSaidWhileItLasts) {
  Coach coach(coachRulesOf(""));
  std::vector<Said> all;
  for (const WorkSample& sample : goodWork(6.0)) {
    // Half a second now and then is nothing to speak of.
    const bool is_hidden = sample.t_s > 3.0 || std::fmod(sample.t_s, 1.0) < 0.5;
    coach.add(sample, {.is_out_of_sight = is_hidden});
    if (auto words = coach.take()) all.push_back({sample.t_s, *words});
  }
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].words, "out of sight: retract, or come from where you see the bur");
  EXPECT_NEAR(all[0].t_s, 4.5, 0.1);
}

TEST(Coach, AnInstrumentOfAnotherStepIsSaidWhileItIsAtWork) {
  Coach coach(coachRulesOf(""));
  std::vector<Said> all;
  for (const WorkSample& sample : goodWork(4.0)) {
    coach.add(sample, {.is_other_instrument = sample.t_s > 1.0 && sample.t_s < 1.3});
    if (auto words = coach.take()) all.push_back({sample.t_s, *words});
  }
  EXPECT_TRUE(all.empty()) << "too short";
  for (const WorkSample& sample : goodWork(4.0)) {
    WorkSample later = sample;
    later.t_s += 10.0;
    coach.add(later, {.is_other_instrument = sample.t_s > 1.0});
    if (auto words = coach.take()) all.push_back({sample.t_s, *words});
  }
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].t_s, 1.5, 0.01);
  EXPECT_EQ(all[0].words, "this step is for another instrument");
}

TEST(Coach, APlungeADeepStrokeAndALingeringBurAreSeen) {
  const std::vector<Said> plunge = said(bur_path::along({{0, 0, 0}, {0, 0, -4}}, 4.0, 1.0));
  ASSERT_FALSE(plunge.empty());
  EXPECT_EQ(plunge[0].words, "sweep along the bone, do not plunge");
  const std::vector<Said> deep = said(bur_path::raster(8, 3.0 * bur_path::kRadius_mm));
  ASSERT_FALSE(deep.empty());
  EXPECT_EQ(deep[0].words, "thinner layers: that stroke was deep");
  std::vector<WorkSample> rest;
  for (int n = 0; n < 3000; ++n) rest.push_back(sampleAt(n * 1e-3, {0.0, 0.0, 0.0}));
  const std::vector<Said> lingering = said(rest);
  ASSERT_EQ(lingering.size(), 1U);
  EXPECT_EQ(lingering[0].words, "keep the bur moving");
  EXPECT_NEAR(lingering[0].t_s, 1.5, 0.01);
}

TEST(Coach, ForceTowardsANearStructureIsSaidBeforeAnythingElse) {
  Coach coach(coachRulesOf(""));
  std::vector<std::string> all;
  for (WorkSample sample : goodWork(2.0)) {
    if (sample.t_s > 2.0) break;
    sample.force_P_N = {0.0, 0.0, 6.0};
    sample.irrigated = false;
    coach.add(sample, {.nearest_mm = sample.t_s < 1.0 ? std::optional(1.5) : std::nullopt});
    if (auto words = coach.take()) all.push_back(*words);
  }
  ASSERT_EQ(all.size(), 1U) << "a pause of 3 s";
  EXPECT_EQ(all[0], "near a structure: less force");
}

TEST(Coach, AnInvalidPoseBreaksOffWhatIsSeen) {
  std::vector<WorkSample> samples;
  for (int n = 0; n < 2000; ++n) samples.push_back(sampleAt(n * 1e-3, {0.0, 0.0, 0.0}));
  samples[1000].valid = false;
  EXPECT_TRUE(said(samples).empty()) << "twice a second at rest, not once two";
}

TEST(Coach, OffTheBoneNothingIsSaid) {
  std::vector<WorkSample> samples = goodWork(6.0);
  for (WorkSample& sample : samples) {
    sample.touches = false;
    sample.irrigated = false;
    sample.force_P_N = {0.0, 0.0, 9.0};
  }
  EXPECT_TRUE(said(samples).empty());
}

TEST(CoachFile, TheShippedRulesAreRead) {
  const CoachRules rules = coachRulesOf("");
  EXPECT_EQ(rules.pause_s, 3.0);
  EXPECT_EQ(rules.rules.size(), kCoachSigns.size());
}

TEST(CoachFile, WhatIsWrongIsRefusedInOneLineWithItsPlace) {
  const std::string good = "[[rule]]\nlooks_for = \"dry\"\nfor_s = 1.0\nsays = \"water\"\n";
  EXPECT_EQ(coachRulesFromToml(good, "own.toml").rules[0].says, "water");
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"", "rule"},
           {"pause_s = 0.1\n" + good, "pause_s"},
           {"[[rule]]\nlooks_for = \"luck\"\nsays = \"no\"\n", "looks_for"},
           {"[[rule]]\nlooks_for = \"force\"\nsays = \"no\"\nfor_s = 1.0\n", "most"},
           {"[[rule]]\nlooks_for = \"dry\"\nfor_s = 1.0\nsays = \"\"\n", "says"},
           {"[[rule]]\nlooks_for = \"dry\"\nfor_s = 1.0\nsays = \"w\"\nmost = 3.0\n", "most"},
           {"[[rule]", "own.toml"}}) {
    try {
      coachRulesFromToml(text, "own.toml");
      ADD_FAILURE() << text;
    } catch (const assets::LoadError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace app
