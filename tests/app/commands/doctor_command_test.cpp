#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class DoctorCommand : public ProgramTest {};

TEST_F(DoctorCommand, TextAndJsonAgree) {
  const ProgramOutput json = molar("doctor --json --sessions " + folder_.string());
  EXPECT_EQ(json.err, "");
  const auto all = nlohmann::json::parse(json.out);
  EXPECT_EQ(json.status, all["missing"] > 0 ? 1 : 0) << "1 if something required is missing";
  const ProgramOutput said = molar("doctor --sessions " + folder_.string());
  for (const auto& check : all["checks"]) {
    EXPECT_NE(said.out.find("  " + check["id"].get<std::string>() + " "), std::string::npos) << said.out;
    EXPECT_NE(check["sentence"], "");
    const bool is_to_do = check["state"] == "missing" || check["state"] == "warn";
    EXPECT_FALSE(is_to_do && check["next_step"] == "") << check;
  }
  EXPECT_EQ(all["checks"].size(), 14u);
  EXPECT_EQ(fileCount(), 0u) << "it leaves nothing behind";
}

TEST_F(DoctorCommand, PrintsInstallableRules) {
  const ProgramOutput said = molar("doctor --udev-rules");
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(said.err, "");
  for (const char* identity : {"2988", "0301", "1234", "cb48", "uaccess", "ID_MM_DEVICE_IGNORE"})
    EXPECT_NE(said.out.find(identity), std::string::npos) << identity;
}

TEST_F(DoctorCommand, RefusesUnknownNames) {
  expectRefusal("doctor --sessions " + at("nowhere"), "nowhere");
  expectRefusal("doctor --json --udev-rules", "udev-rules");
  expectRefusal("doctor everything");
  expectRefusal("doctor --priority 99", "priority");
}

}  // namespace
}  // namespace app
