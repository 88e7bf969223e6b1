#include "app/options/tool_text.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

using haptics::BurShape;
using haptics::ShapeKind;

TEST(ToolText, ReadsEveryHead) {
  EXPECT_EQ(headFrom("sphere:2"), (BurShape{ShapeKind::sphere, 2.0, 0.0}));
  EXPECT_EQ(headFrom("capsule:0.8,4"), (BurShape{ShapeKind::capsule, 0.8, 4.0}));
  EXPECT_EQ(headFrom("capsule:0.8,0"), (BurShape{ShapeKind::capsule, 0.8, 0.0}));
  EXPECT_EQ(headFrom("cylinder:0.6,4.5"), (BurShape{ShapeKind::cylinder, 0.6, 4.5}));
  EXPECT_EQ(headFrom("cone:1,3"), (BurShape{ShapeKind::cone, 1.0, 3.0}));
}

TEST(ToolText, ReadsEveryRevolvedHeadAndWritesItBack) {
  for (std::size_t n = 0; n < assets::kBurProfiles; ++n) {
    const std::string text = std::string(assets::kBurProfileKeys[n]) + ":0.8,6.5";
    const BurShape head{ShapeKind::revolved, 0.8, 6.5, static_cast<assets::BurProfile>(n)};
    EXPECT_EQ(headFrom(text), head);
    EXPECT_EQ(textOf(head), text);
    EXPECT_EQ(toolFrom(text, "").head, head);
  }
}

TEST(ToolText, ReadsBursByTheirIsoNumber) {
  EXPECT_EQ(headFrom("iso:289/016"), (BurShape{ShapeKind::revolved, 0.8, 8.0, assets::BurProfile::torpedo}));
  EXPECT_EQ(headFrom("iso:289/016,6"), (BurShape{ShapeKind::revolved, 0.8, 6.0, assets::BurProfile::torpedo}));
  EXPECT_EQ(headFrom("iso:198/021").profile, assets::BurProfile::round_taper);
  EXPECT_EQ(headFrom("iso:001/023"), (BurShape{ShapeKind::sphere, 0.05 * 23, 0.0}));
  for (const auto& [bad, why] : {std::pair{"iso:", "that is no ISO number"},
                                 {"iso", "that is no ISO number"},
                                 {"iso:289", "that is no ISO number"},
                                 {"iso:289/x", "that is no ISO number"},
                                 {"iso:777/016", "no such ISO shape is made"},
                                 {"iso:289/000", "diameter is out of range"},
                                 {"iso:289/016,0", "length is out of range"},
                                 {"iso:289/016,nan", "length is out of range"},
                                 {"iso:001/016,3", "length is out of range"},
                                 {"iso:289/100", "too short for this form"},
                                 {"flame:1,1", "too short for this form, give at least 2 mm"},
                                 {"flame:1", "the length is missing"},
                                 {"pear:x,3", "the radius is not a number"},
                                 {"flame", "the radius"}}) {
    const std::string said = tests::refusalOf<UsageError>([&, text = bad] { toolFrom(text, ""); });
    EXPECT_NE(said.find(why), std::string::npos) << bad << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << bad;
  }
}

TEST(ToolText, ReadsForcepsAndBurs) {
  EXPECT_EQ(toolFrom("forceps", ""), haptics::forcepsTool());
  EXPECT_EQ(toolFrom("round:2.0", "0.5,12"), (haptics::Tool{headFrom("round:2.0"), {0.5, 12.0}}));
  EXPECT_EQ(toolFrom("round:2.0", "").shaft, haptics::standardShaft(headFrom("round:2.0")));
  EXPECT_NE(tests::refusalOf<UsageError>([] { toolFrom("forceps:3", ""); }).find("forceps have no size"),
            std::string::npos);
  EXPECT_NE(tests::refusalOf<UsageError>([] { toolFrom("pliers", ""); }).find("in mm, or forceps"), std::string::npos);
}

TEST(ToolText, ReadsEveryElevator) {
  for (const auto& [text, kind] : {std::pair{"elevator:301", haptics::ElevatorKind::straight_301},
                                   {"elevator:34s", haptics::ElevatorKind::straight_34s},
                                   {"elevator:cryer-left", haptics::ElevatorKind::cryer_left},
                                   {"elevator:cryer-right", haptics::ElevatorKind::cryer_right}})
    EXPECT_EQ(toolFrom(text, ""), haptics::elevatorTool(kind)) << text;
  for (const char* bad : {"elevator", "elevator:", "elevator:none", "elevator:302", "elevator:301,2"})
    EXPECT_NE(tests::refusalOf<UsageError>([&] {
                toolFrom(bad, "");
              }).find("no such elevator, give elevator:301, elevator:34s, elevator:cryer-left or elevator:cryer-right"),
              std::string::npos)
        << bad;
}

TEST(ToolText, ReadsEveryHandInstrument) {
  for (const auto& [text, kind] : {std::pair{"scalpel:15", haptics::HandInstrument::scalpel_15},
                                   {"periosteal", haptics::HandInstrument::periosteal},
                                   {"curette", haptics::HandInstrument::curette},
                                   {"bone-file", haptics::HandInstrument::bone_file},
                                   {"suction", haptics::HandInstrument::suction},
                                   {"composite", haptics::HandInstrument::composite},
                                   {"glass-ionomer", haptics::HandInstrument::glass_ionomer},
                                   {"amalgam", haptics::HandInstrument::amalgam},
                                   {"wax", haptics::HandInstrument::wax},
                                   {"gutta-percha", haptics::HandInstrument::gutta_percha},
                                   {"plugger", haptics::HandInstrument::plugger},
                                   {"carver", haptics::HandInstrument::carver},
                                   {"curing-lamp", haptics::HandInstrument::curing_lamp},
                                   {"root-plugger", haptics::HandInstrument::root_plugger}})
    EXPECT_EQ(toolFrom(text, ""), haptics::handInstrumentTool(kind)) << text;
  for (const char* bad : {"scalpel", "scalpel:11", "none", "curette:3"})
    EXPECT_NE(tests::refusalOf<UsageError>([&] {
                toolFrom(bad, "");
              }).find("scalpel:15, periosteal, curette, bone-file, suction, composite"),
              std::string::npos)
        << bad;
}

TEST(ToolText, ReadsBursAsDentistsOrderThem) {
  EXPECT_EQ(headFrom("round:3.0"), headFrom("sphere:1.5"));
  EXPECT_EQ(headFrom("round:iso023"), headFrom("sphere:1.15"));
  EXPECT_EQ(headFrom("fissure:1.6,6"), headFrom("cylinder:0.8,6"));
  EXPECT_EQ(headFrom("fissure:iso012,4"), headFrom("cylinder:0.6,4"));
  for (const char* bad :
       {"round:iso23", "round:iso000", "round:iso", "sphere:iso023", "fissure:1.6", "fissure:1,iso023"})
    EXPECT_THROW(headFrom(bad), UsageError) << bad;
}

TEST(ToolText, WritesTheFormItReads) {
  for (const char* text : {"sphere:2", "capsule:0.8,4", "cylinder:0.6,4.5", "cone:1,3"})
    EXPECT_EQ(textOf(headFrom(text)), text);
}

TEST(ToolText, RefusesInvalidHeads) {
  for (const char* bad : {"",           "sphere",      "sphere:",      "sphere:0",      "sphere:-1",       "sphere:nan",
                          "sphere:99",  "sphere:2,3",  "sphere:2,",    "cone:1",        "cone:1,",         "cone:1,0",
                          "cone:1,2,3", "cylinder:,4", "cylinder:1;4", "capsule:1,-2",  "capsule:1,inf",   "disc:1,2",
                          "Sphere:1",   "sphere: 1",   "capsule:1, 2", "cylinder:1,41", "cylinder:0.05,4", "round:0.1",
                          "round:41"})
    EXPECT_THROW(headFrom(bad), UsageError) << bad;
}

std::string complaint(const std::string& text) {
  return tests::refusalOf<UsageError>([&] { headFrom(text); });
}

TEST(ToolText, NamesTheErrorAndTheAcceptedForms) {
  EXPECT_NE(complaint("cone:1").find("the length is missing, give cone:R,L in mm"), std::string::npos);
  EXPECT_NE(complaint("cylinder:99,2").find("the radius is out of range, give 0.1 to 20 mm"), std::string::npos);
  EXPECT_NE(complaint("capsule:1,99").find("the length is out of range, give 0 to 40 mm"), std::string::npos);
  EXPECT_NE(complaint("capsule:1,x").find("the length is not a number"), std::string::npos);
  EXPECT_NE(complaint("disc:1").find("sphere:R, capsule:R,L, cylinder:R,L, cone:R,L, wheel:R,L"), std::string::npos);
}

TEST(ToolText, ReadsAShaft) {
  EXPECT_EQ(shaftFrom("1.175,25").radius_mm, 1.175);
  EXPECT_EQ(shaftFrom("1.175,25").length_mm, 25.0);
  EXPECT_EQ(shaftFrom("none").length_mm, 0.0);
  for (const char* bad : {"", "1", "1,", "0,10", "1,0", "6,10", "1,2,3", "x,1"})
    EXPECT_THROW(shaftFrom(bad), UsageError) << bad;
}

TEST(ToolText, ReadsRootCanalFiles) {
  const haptics::Tool plain = toolFrom("k-file:25,25", "");
  ASSERT_TRUE(plain.isFile());
  EXPECT_FALSE(plain.turns());
  EXPECT_EQ(plain.file.size, 25u);
  EXPECT_EQ(plain.file.length_mm, 25.0);
  EXPECT_FALSE(plain.file.nickel_titanium);
  const haptics::Tool bent = toolFrom("k-file:15,31,niti,bent:30", "");
  EXPECT_TRUE(bent.file.nickel_titanium);
  EXPECT_EQ(bent.file.bent_deg, 30.0);
  EXPECT_EQ(haptics::sanitised(bent), bent);
  EXPECT_FALSE(plain == bent);
  for (const char* const wrong : {"k-file", "k-file:", "k-file:7,25", "k-file:25,24", "k-file:25,25,gold",
                                  "k-file:25,25,bent:91", "k-file:-25,25", "k-file:25,25,bent:x"})
    EXPECT_THROW(toolFrom(wrong, ""), UsageError) << wrong;
}

TEST(ToolText, ReadsConesOfGuttaPercha) {
  const haptics::Tool cone = toolFrom("gp-cone:30,4", "");
  ASSERT_TRUE(cone.isFile());
  ASSERT_TRUE(cone.file.isCone());
  EXPECT_FALSE(cone.file.made()) << "no file";
  EXPECT_EQ(cone.file.cone()->size, 30);
  EXPECT_EQ(cone.file.cone()->taper, 0.04);
  EXPECT_EQ(cone.reach_mm(), 21.0);
  EXPECT_GT(cone.file.sealer_mm3, 0.0);
  EXPECT_EQ(haptics::sanitised(cone), cone);
  const haptics::Tool dry = toolFrom("gp-cone:15,2,22.5,dry", "");
  EXPECT_EQ(dry.file.sealer_mm3, 0.0);
  EXPECT_EQ(dry.reach_mm(), 22.5);
  for (const char* const wrong :
       {"gp-cone", "gp-cone:30", "gp-cone:30,5", "gp-cone:32,4", "gp-cone:10,2", "gp-cone:65,2", "gp-cone:30,4,9",
        "gp-cone:30,4,29", "gp-cone:30,4,wet", "gp-cone:-30,4", "gp-cone:1e30,4"})
    EXPECT_THROW(toolFrom(wrong, ""), UsageError) << wrong;
}

}  // namespace
}  // namespace app
