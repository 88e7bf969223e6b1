// `molar teeth`: keys, table and refusals; canals are tested at tests/assets/synthetic/built_in_teeth_test.cpp.
#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class TeethCommand : public ProgramTest {};

TEST_F(TeethCommand, ListsTheCanalsOfABuiltInJaw) {
  const ProgramOutput said = molar("teeth --case usual --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto teeth = nlohmann::json::parse(said.out).at("teeth");
  ASSERT_EQ(teeth.size(), 5U);
  EXPECT_EQ(teeth[2].at("fdi"), 46);
  EXPECT_EQ(teeth[2].at("name"), "lower right first molar");
  EXPECT_EQ(teeth[2].at("canals_are"), "built-in");
  ASSERT_EQ(teeth[2].at("canals").size(), 3U);
  const auto& canal = teeth[2].at("canals")[0];
  EXPECT_EQ(canal.at("name"), "mesiobuccal");
  EXPECT_NEAR(canal.at("smallest_width_mm").get<double>(), 0.28, 0.005);
  EXPECT_GT(canal.at("schneider_deg").get<double>(), 25.0);
  EXPECT_GT(canal.at("working_length_mm").get<double>(), canal.at("length_mm").get<double>());
  EXPECT_LT(canal.at("foramen_P_mm")[2].get<double>(), canal.at("orifice_P_mm")[2].get<double>());
  EXPECT_EQ(teeth[3].at("canals")[1].at("joins"), "mesiobuccal");
  EXPECT_FALSE(teeth[4].at("remark").is_null());

  const ProgramOutput table = molar("teeth --case usual");
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_NE(table.out.find("mesiolingual"), std::string::npos);
  EXPECT_EQ(std::ranges::count(table.out, '\n'), 12);
}

TEST_F(TeethCommand, RefusesInOneLine) {
  expectRefusal("teeth", "--case");
  expectRefusal("teeth --case no-such", "no-such");
}

}  // namespace
}  // namespace app
