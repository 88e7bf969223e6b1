#include "app/procedure/steps/step_file.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

const std::string kGood = R"(title = "Two steps"
[[step]]
key = "bone"
title = "Bare the crown"
instruction = "Gently"
instruments = ["bur"]
region = "gutter"
done_when = { crown_bared = 0.5, bone_mm3 = 20 }
errors = { dry = true, nerve_mm = 2.5 }
[[step]]
key = "close"
title = "Close"
done_when = { given = "By the assistant" }
)";

std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

/// One line that names file and place.
void expectRefused(const std::string& text, const std::string& words) {
  try {
    stepPlanFromToml(text, "own.toml");
    ADD_FAILURE() << "accepted:\n" << text;
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_TRUE(said.starts_with("own.toml: ")) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said << " lacks " << words;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST(StepFile, ReadsWhatItSays) {
  const StepPlan plan = stepPlanFromToml(kGood, "own.toml");
  EXPECT_EQ(plan.name, "own");
  EXPECT_EQ(plan.title, "Two steps");
  ASSERT_EQ(plan.steps.size(), 2u);
  const Step& bone = plan.steps[0];
  EXPECT_EQ(bone.key, "bone");
  EXPECT_EQ(bone.instruction, "Gently");
  EXPECT_EQ(bone.instruments, std::vector{StepInstrument::bur});
  EXPECT_EQ(bone.region, StepRegion::gutter);
  EXPECT_EQ(bone.done_when.crown_bared, 0.5);
  EXPECT_EQ(bone.done_when.bone_mm3, 20.0);
  EXPECT_FALSE(bone.done_when.pieces);
  EXPECT_TRUE(bone.errors.dry);
  EXPECT_FALSE(bone.errors.canal);
  EXPECT_EQ(bone.errors.nerve_mm, 2.5);
  EXPECT_EQ(plan.steps[1].done_when.given, "By the assistant");
}

TEST(StepFile, ShipsThreeProceduresInWhichEveryStepIsWorkOrGiven) {
  EXPECT_EQ(shippedProcedures(), (std::vector<std::string>{"third-molar", "coronectomy", "whole-tooth"}));
  for (const std::string& name : shippedProcedures()) {
    const StepPlan plan = stepPlanNamed(name);
    EXPECT_EQ(plan.name, name);
    EXPECT_GE(plan.steps.size(), 6u) << name;
    EXPECT_TRUE(
        std::ranges::any_of(plan.steps, [](const Step& step) { return step.done_when.crown_bared.has_value(); }));
    EXPECT_TRUE(std::ranges::any_of(
        plan.steps, [](const Step& step) { return step.done_when.pieces_out || step.done_when.all_out; }));
    EXPECT_TRUE(plan.steps.back().done_when.stitches) << "the wound is closed at last";
  }
}

TEST(StepFile, ATeachersFileIsReadByItsPath) {
  const tests::ScratchFolder folder;
  std::ofstream(folder.file("own.toml")) << kGood;
  EXPECT_EQ(stepPlanNamed(folder.file("own.toml")).steps.size(), 2u);
  EXPECT_THROW(stepPlanNamed(folder.file("none.toml")), std::runtime_error);
  try {
    stepPlanNamed("apicectomy");
    ADD_FAILURE() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("third-molar, coronectomy, whole-tooth or a FILE.toml"),
              std::string::npos);
  }
}

TEST(StepFile, RefusesEachBadKeyByLine) {
  expectRefused("", "title");
  expectRefused("title = \"T\"\n", "step: give 1 to 40 tables, each after [[step]]");
  expectRefused("title = \"T\"\nstep = 3\n", "line 2: step");
  expectRefused("title = \"T\"\nstep = []\n", "line 2: step");
  expectRefused("title = \"T\"\n[step]\nkey = \"a\"\n", "line 2: step");
  expectRefused("not toml at all", "line 1");
  expectRefused(with(kGood, "key = \"bone\"", "key = \"Bone\""), "line 3: [step.1] key: give small letters");
  expectRefused(with(kGood, "key = \"close\"", "key = \"bone\""), "line 11: [step.2] key: another step");
  expectRefused(with(kGood, "key = \"bone\"\n", ""), "[step.1] key: it is missing");
  expectRefused(with(kGood, "title = \"Bare the crown\"", "title = \"\""), "line 4: [step.1] title");
  expectRefused(with(kGood, "title = \"Bare the crown\"", "title = 4"), "line 4: [step.1] title");
  expectRefused(with(kGood, "\"Gently\"", "\"" + std::string(201, 'a') + "\""), "line 5: [step.1] instruction");
  expectRefused(with(kGood, "[\"bur\"]", "[\"hammer\"]"),
                "line 6: [step.1] instruments: no such choice, give one of bur");
  expectRefused(with(kGood, "[\"bur\"]", "\"bur\""), "line 6: [step.1] instruments: give a list of");
  expectRefused(with(kGood, "[\"bur\"]", "[1]"), "line 6: [step.1] instruments: give a list of");
  expectRefused(with(kGood, "\"gutter\"", "\"ear\""), "line 7: [step.1] region: no such choice");
  expectRefused(with(kGood, "crown_bared = 0.5", "crown_bared = 1.5"),
                "[step.1.done_when] crown_bared: 1.5 is out of range");
  expectRefused(with(kGood, "crown_bared = 0.5", "crown_bared = nan"), "crown_bared");
  expectRefused(with(kGood, "crown_bared = 0.5", "pieces = 1"), "pieces: give a whole number from 2 to 4");
  expectRefused(with(kGood, "crown_bared = 0.5", "pieces_out = 0"), "pieces_out");
  expectRefused(with(kGood, "crown_bared = 0.5", "bridge_mm = 0"), "bridge_mm");
  expectRefused(with(kGood, "crown_bared = 0.5", "all_out = 1"), "all_out: give true or false");
  expectRefused(with(kGood, "crown_bared = 0.5", "in_hand = \"scalpel\""),
                "in_hand: no such choice, give one of bur, elevator, forceps");
  expectRefused(with(kGood, "crown_bared = 0.5", "crown_bare = 0.5"),
                "line 8: [step.1.done_when] crown_bare: no such key");
  expectRefused(with(kGood, "crown_bared = 0.5", "given = \"so\""), "what is given is not done by hand");
  expectRefused(with(kGood, "{ given = \"By the assistant\" }", "{}"), "line 13: [step.2.done_when]: it says no rule");
  expectRefused(with(kGood, "{ given = \"By the assistant\" }", "true"),
                "line 13: [step.2] done_when: it is missing, give a table");
  expectRefused(with(kGood, "done_when = { given = \"By the assistant\" }\n", ""), "[step.2] done_when: it is missing");
  expectRefused(with(kGood, "{ dry = true, nerve_mm = 2.5 }", "[\"dry\"]"), "line 9: [step.1] errors: give a table");
  expectRefused(with(kGood, "dry = true", "wet = true"), "line 9: [step.1.errors] wet: no such key");
  expectRefused(with(kGood, "dry = true", "dry = 1"), "line 9: [step.1.errors] dry: give true or false");
  expectRefused(with(kGood, "nerve_mm = 2.5", "nerve_mm = -1"), "nerve_mm: -1 is out of range, give 0.1 to 10 mm");
  expectRefused(kGood + "colour = 1\n", "[step.2] colour: no such key");
  expectRefused(kGood + "[colours]\nred = 1\n", "[colours]: no such table");
  std::string many = "title = \"T\"\n";
  for (int n = 0; n < 41; ++n)
    many += "[[step]]\nkey = \"k" + std::to_string(n) + "\"\ntitle = \"t\"\ndone_when = { given = \"g\" }\n";
  expectRefused(many, "give 1 to 40 tables");
}

}  // namespace
}  // namespace app
