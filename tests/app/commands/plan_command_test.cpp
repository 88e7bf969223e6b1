// `molar plan`: keys and refusals; what it reads is tested at tests/app/case/extraction_plan_test.cpp.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"
#include "tests/shared_data.h"

namespace app {
namespace {

class PlanCommand : public ProgramTest {};

TEST_F(PlanCommand, PrintsEveryParameterWithHowItWasFound) {
  const ProgramOutput said = molar("plan --case usual --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto plan = nlohmann::json::parse(said.out);
  for (const char* key :
       {"fdi", "winter_angle", "winter_class", "depth", "pell_gregory_depth", "pell_gregory_ramus", "canal_distance",
        "canal_relation", "lingual_plate", "second_molar", "roots", "root_shape", "difficulty"}) {
    ASSERT_TRUE(plan.contains(key)) << key;
    EXPECT_FALSE(plan.at(key).at("value").is_null()) << key;
    EXPECT_TRUE(plan.at(key).contains("unit")) << key;
    EXPECT_FALSE(plan.at(key).at("how").get<std::string>().empty()) << key;
  }
  EXPECT_EQ(plan.at("depth").at("unit"), "mm");
  EXPECT_EQ(plan.at("winter_angle").at("unit"), "deg");
  EXPECT_EQ(plan.at("difficulty").at("unit"), "of 10");
  EXPECT_TRUE(plan.at("winter_class").at("unit").is_null());
  EXPECT_TRUE(plan.at("depth").at("value").is_number());
  const ProgramOutput table = molar("plan --case usual");
  EXPECT_EQ(table.status, 0) << table.err;
  for (const char* words : {"mesio-angular", " °", " mm", " of 10", " FDI"})
    EXPECT_NE(table.out.find(words), std::string::npos) << words;
  EXPECT_EQ(std::ranges::count(table.out, '\n'), static_cast<std::ptrdiff_t>(plan.size()));
}

TEST_F(PlanCommand, RefusesInOneLine) {
  expectRefusal("plan", "exactly one");
  expectRefusal("plan --case usual " + at("patient"), "exactly one");
  expectRefusal("plan " + at("missing"), "missing");
  expectRefusal("plan --case no-such", "no-such");
}

class PlanRealData : public ProgramTest {};

/// Of this jaw the other teeth have no numbers: what needs the second molar has a reason.
TEST_F(PlanRealData, ReadsARealJawOrSaysWhyNot) {
  const std::filesystem::path scan = tests::sharedData("patients/right_third_molar");
  MOLAR_NEEDS(scan);
  ASSERT_EQ(molar("import " + scan.string() + " --out " + at("patient")).status, 0);
  const ProgramOutput said = molar("plan " + at("patient") + " --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto plan = nlohmann::json::parse(said.out);
  EXPECT_EQ(plan.at("fdi").at("value"), 48);
  // truth.json of that scan: 0.4 mm between voxels, one voxel wide.
  EXPECT_NEAR(plan.at("canal_distance").at("value").get<double>(), 0.4, 0.6);
  EXPECT_GT(plan.at("lingual_plate").at("value").get<double>(), 0.0);
  EXPECT_LT(plan.at("lingual_plate").at("value").get<double>(), 6.0);
  EXPECT_GE(plan.at("roots").at("value").get<int>(), 1);
  EXPECT_LE(plan.at("roots").at("value").get<int>(), 4);
  for (const auto& [key, item] : plan.items()) {
    if (!item.at("value").is_null()) continue;
    EXPECT_FALSE(item.at("reason").get<std::string>().empty()) << key;
  }
  EXPECT_TRUE(plan.at("winter_angle").at("value").is_null());
}

}  // namespace
}  // namespace app
