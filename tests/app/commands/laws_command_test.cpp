#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class LawsCommand : public ProgramTest {};

TEST_F(LawsCommand, ListsEveryParameterWithUnitRangeDefaultAndSource) {
  const ProgramOutput said = molar("laws --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto all = nlohmann::json::parse(said.out);
  EXPECT_EQ(all["laws"].size(), 7u);
  for (const auto& law : all["laws"]) {
    EXPECT_FALSE(law["formula"].get<std::string>().empty());
    EXPECT_FALSE(law["parameters"].empty()) << law["law"];
    for (const auto& one : law["parameters"]) {
      EXPECT_LE(one["lowest"], one["default"]) << one["key"];
      EXPECT_LE(one["default"], one["highest"]) << one["key"];
      EXPECT_FALSE(one["source"].get<std::string>().empty()) << one["key"];
    }
  }
  const ProgramOutput table = molar("laws --law hertz");
  EXPECT_NE(table.out.find("hertz_N_per_mm2"), std::string::npos) << table.out;
  EXPECT_EQ(table.out.find("force_constant_N"), std::string::npos) << "only the requested law";
}

TEST_F(LawsCommand, DrawsForceAndStiffness) {
  const ProgramOutput said = molar("laws --plot " + at("laws.png") + " --tool sphere:1 --law agus,hertz");
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string png = read("laws.png");
  EXPECT_TRUE(png.starts_with("\x89PNG")) << png.size();
  EXPECT_GT(png.size(), 20000u);
  expectRefusal("laws --plot " + at("laws.png"), "laws.png");
}

TEST_F(LawsCommand, RefusesUnknownNames) {
  expectRefusal("laws --law spring", "agus");
  expectRefusal("laws --plot " + at("a.png") + " --tool hammer:1", "hammer");
  expectRefusal("laws --plot " + at("a.png") + " --law agus --set colour=1", "no such setting");
  EXPECT_EQ(fileCount(), 0u);
}

}  // namespace
}  // namespace app
