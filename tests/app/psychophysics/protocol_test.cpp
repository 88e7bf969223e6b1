#include "app/psychophysics/protocol.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/random.h"

namespace app {
namespace {

const std::string kGood = R"(participant = "P07"
method = "2afc-constant"
[standard]
law = "agus"
stiffness_N_per_mm = 0.8
[comparison]
law = "agus"
[vary]
parameter = "stiffness_N_per_mm"
levels = [0.6, 0.8, 1.0]
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

/// One line that names file and key.
void expectRefused(const std::string& text, const std::string& word) {
  try {
    protocolFromToml(text, "protocol.toml");
    ADD_FAILURE() << "accepted:\n" << text;
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_TRUE(said.starts_with("protocol.toml: ")) << said;
    EXPECT_NE(said.find(word), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(Protocol, ReadsTheExamples) {
  const std::string folder = std::string(MOLAR_SOURCES) + "/app/psychophysics/";
  const Protocol constant = protocolFromToml(assets::readSmallFile(folder + "example.toml"), "example.toml");
  EXPECT_EQ(constant.method, Method::constant);
  EXPECT_EQ(constant.levels.size(), 7u);
  EXPECT_EQ(constant.standardValue(), 0.8);
  EXPECT_EQ(constant.comparisonAt(1.04).agus.stiffness_N_per_mm, 1.04);
  const Protocol staircase =
      protocolFromToml(assets::readSmallFile(folder + "example_staircase.toml"), "example_staircase.toml");
  EXPECT_EQ(staircase.method, Method::staircase);
  EXPECT_EQ(staircase.bone.kind, BoneChoice::Kind::trabecular);
  EXPECT_EQ(staircase.staircase.kind, StepKind::ratio);
  EXPECT_EQ(staircase.staircase.steps.size(), 3u);
}

TEST(Protocol, TakesDefaultsForWhatIsNotSaid) {
  const Protocol protocol = protocolFromToml(kGood, "protocol.toml");
  EXPECT_EQ(protocol.trials, 20);
  EXPECT_EQ(protocol.probe.motion, Motion::press);
  EXPECT_EQ(protocol.observer.weber_fraction, 0.15);
  EXPECT_EQ(protocol.unit, "N/mm");
}

TEST(Protocol, RefusesNamesAndDatesOfPeople) {
  for (const char* id : {"", "Anna", "P", "07", "P12345", "ABCD1", "p07", "P07 ", "P-1980", "AB--1", "M\\u00fcller"}) {
    if (std::string(id) == "P-1980") continue;  // four digits: a number like any other
    expectRefused(replaced(kGood, "P07", id), "participant");
  }
  for (const char* id : {"P07", "S-012", "ABC1234", "X1"})
    EXPECT_EQ(protocolFromToml(replaced(kGood, "P07", id), "f").participant, id);
}

TEST(Protocol, RefusesEachBadKeyByName) {
  expectRefused("", "participant");
  expectRefused("participant = \"P07\"\n", "method");
  expectRefused("not toml at all", "line 1");
  expectRefused(replaced(kGood, "2afc-constant", "guess"), "line 2: method");
  expectRefused(replaced(kGood, "\"2afc-constant\"", "3"), "method");
  expectRefused(replaced(kGood, "\"agus\"", "\"spring\""), "line 4: [standard] law");
  expectRefused(replaced(kGood, "= 0.8", "= -0.8"), "line 5: [standard] stiffness_N_per_mm");
  expectRefused(replaced(kGood, "= 0.8", "= nan"), "stiffness_N_per_mm");
  expectRefused(replaced(kGood, "= 0.8", "= \"0.8\""), "stiffness_N_per_mm");
  expectRefused(replaced(kGood, "parameter = \"stiffness_N_per_mm\"", "parameter = \"colour\""), "stiffness_N_per_mm");
  expectRefused(replaced(kGood, "[0.6, 0.8, 1.0]", "[0.6]"), "levels");
  expectRefused(replaced(kGood, "[0.6, 0.8, 1.0]", "[0.6, 0.6]"), "rise");
  expectRefused(replaced(kGood, "[0.6, 0.8, 1.0]", "[0.8, 0.6]"), "rise");
  expectRefused(replaced(kGood, "[0.6, 0.8, 1.0]", "[0.6, inf]"), "levels");
  expectRefused(replaced(kGood, "[0.6, 0.8, 1.0]", "[0.6, \"a\"]"), "levels");
  expectRefused(kGood + "repetitions = 0\n", "repetitions");
  expectRefused(kGood + "repetitions = 1.5\n", "repetitions");
  expectRefused(kGood + "colour = 1\n", "[vary] colour");
  expectRefused(kGood + "[colours]\nred = 1\n", "[colours]");
  expectRefused(kGood + "[bone]\nphantom = \"foam\"\n", "phantom");
  expectRefused(kGood + "[bone]\nphantom = \"flat\"\nvolume = \"v.nrrd\"\n", "more than one");
  expectRefused(kGood + "[bone]\nvolume = \"v.nrrd\"\n", "site_P_mm");
  expectRefused(kGood + "[bone]\nvolume = \"v.nrrd\"\nsite_P_mm = [0, 0]\n", "site_P_mm");
  expectRefused(kGood + "[bone]\nvolume = \"v\"\nsite_P_mm = [0, 0, 0]\noutward_P = [0, 0, 0]\n", "outward_P");
  expectRefused(kGood + "[bone]\nseed = 3\n", "seed");
  expectRefused(kGood + "[tool]\nhead = \"hammer\"\n", "head");
  expectRefused(kGood + "[probe]\nmotion = \"lick\"\n", "motion");
  expectRefused(kGood + "[probe]\nduration_s = 0\n", "duration_s");
  expectRefused(kGood + "[probe]\nstroke_mm = 3\n", "stroke_mm");
  expectRefused(kGood + "[timing]\nbetween_trials_s = -1\n", "between_trials_s");
  expectRefused(kGood + "[observer]\nweber_fraction = 2\n", "weber_fraction");
  expectRefused(kGood + "[observer]\ncue = \"smell\"\n", "cue");
  expectRefused(kGood + "[staircase]\nup = 1\n", "[staircase]");
  const std::string staircase =
      replaced(replaced(kGood, "2afc-constant", "staircase"), "levels = [0.6, 0.8, 1.0]\n", "");
  expectRefused(staircase, "start");
  expectRefused(staircase + "[staircase]\nstart = 1.2\n", "steps");
  expectRefused(staircase + "[staircase]\nstart = 1.2\nsteps = 0.1\nup = 0\n", "up");
  expectRefused(staircase + "[staircase]\nstart = 99\nsteps = 0.1\n", "start");
  expectRefused(staircase + "[staircase]\nstart = 1.2\nstep_kind = \"ratio\"\nsteps = 0.9\n", "steps");
  expectRefused(staircase + "[staircase]\nstart = 1.2\nsteps = 0.1\nreversals = 4\ndiscarded_reversals = 3\n",
                "discard");
  EXPECT_NO_THROW(protocolFromToml(staircase + "[staircase]\nstart = 1.2\nsteps = 0.1\n", "f"));
}

/// Whatever the bytes: a protocol or one line of refusal, never a crash and never a value out of range.
TEST(Protocol, SurvivesAnyBytes) {
  calibration::RandomGenerator rng(7);
  const std::string pieces = "[]=\"'#.,\n 0123456789-+einfa\\{}\xff\x01\t";
  int accepted = 0;
  for (int n = 0; n < 3000; ++n) {
    std::string text = kGood;
    for (std::size_t changes = 1 + rng.below(4); changes > 0; --changes) {
      const std::size_t at = rng.below(text.size());
      const char c = pieces[rng.below(pieces.size())];
      switch (rng.below(3)) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        default:
          text.erase(at, 1 + rng.below(6));
          break;
      }
    }
    try {
      const Protocol protocol = protocolFromToml(text, "f");
      ++accepted;
      for (const double level : protocol.levels) EXPECT_TRUE(level >= 0.0 && level <= 20.0) << text;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(accepted, 10);
  std::string nested(20000, '[');
  EXPECT_THROW(protocolFromToml("a = " + nested, "f"), assets::LoadError);
}

}  // namespace
}  // namespace app
