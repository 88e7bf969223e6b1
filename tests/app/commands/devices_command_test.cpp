#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class DevicesCommand : public ProgramTest {
 protected:
  /// The check with these answers, a line each.
  ProgramOutput check(const std::string& answers, const std::string& address = "simulated:omni") const {
    return molar("devices check " + address + " --rate-seconds 0.5 --report " + at("report.md"),
                 write("answers", answers));
  }
};

/// Answers of a user with a good Omni: 6 for switches and corners, then the push direction, then grams.
std::string goodAnswers(const std::string& ways, const std::string& grams) {
  return "\n\n\n\n\n\n\n\n\n" + ways + grams;
}

TEST_F(DevicesCommand, ListsDevicesAndMarksUntestedDrivers) {
  const ProgramOutput said = molar("devices");
  EXPECT_EQ(said.status, 0) << said.err;
  for (const char* words :
       {"simulated:omni", "openhaptics", "wooden", "falcon", "never on a real unit", "devices check"})
    EXPECT_NE(said.out.find(words), std::string::npos) << words;
  const auto all = nlohmann::json::parse(molar("devices --json").out);
  bool has_omni = false;
  for (const auto& device : all["devices"]) has_omni = has_omni || device["address"] == "simulated:omni";
  EXPECT_TRUE(has_omni);
  for (const auto& kind : all["kinds"]) EXPECT_EQ(kind["ran_on_a_real_unit"], false) << kind;
}

TEST_F(DevicesCommand, CheckPassesAGoodUnit) {
  const ProgramOutput said = check(goodAnswers("r\nu\nt\n", "0\n30.6\n61.2\n102\n-30.6\n-61.2\n-102\n"));
  const std::string page = read("report.md");
  EXPECT_EQ(said.status, 0) << said.err << page;
  EXPECT_EQ(said.out, "");
  for (const char* line : {"| pushes right | right | right, moved +", "| pushes towards you | towards you |",
                           "| inkwell says docked | yes, then no | yes, then no | ok |",
                           "| buttons: free, first, second | none, bits 1, bits 2 | none, bits 1, bits 2 | ok |",
                           "| scale of the force | 1.00 ± 0.10 |", "| rate | 1000 Hz | 1000.0 Hz | ok |",
                           "- [ ] a newton is a newton", "This unit is simulated"})
    EXPECT_NE(page.find(line), std::string::npos) << line << "\n" << page << said.err;
  EXPECT_EQ(page.find("left before the end"), std::string::npos) << page;
}

TEST_F(DevicesCommand, CheckDetectsAReversedForceAndStopsPushing) {
  const ProgramOutput said = check(goodAnswers("l\nu\nt\n", ""));
  EXPECT_EQ(said.status, 1) << said.err;
  const std::string page = read("report.md");
  EXPECT_NE(page.find("| pushes right | right | left"), std::string::npos) << page;
  EXPECT_NE(page.find("**WRONG**"), std::string::npos);
  EXPECT_NE(page.find("| scale of the force | 1.00 ± 0.10 |  | not tried |"), std::string::npos) << page;
}

TEST_F(DevicesCommand, CheckCanBeLeftAtAnyQuestion) {
  for (const int lines : {0, 3, 10}) {
    std::filesystem::remove(at("report.md"));
    std::string answers = goodAnswers("r\nu\nt\n", "0\n30.6\n");
    std::size_t end = 0;
    for (int i = 0; i < lines; ++i) end = answers.find('\n', end) + 1;
    const ProgramOutput said = check(answers.substr(0, end) + "q\n");
    EXPECT_EQ(said.status, 1) << lines << said.err;
    EXPECT_NE(read("report.md").find("left before the end"), std::string::npos) << lines;
  }
}

TEST_F(DevicesCommand, CheckRefusesMissingDevices) {
  write("report.md", "mine");
  expectRefusal("devices check simulated:omni --report " + at("report.md"), "report.md");
  EXPECT_EQ(read("report.md"), "mine");
  expectRefusal("devices check simulated:robot --report " + at("new.md"), "simulated:robot");
  expectRefusal("devices check wheelbarrow --report " + at("new.md"), "wheelbarrow");
  expectRefusal("devices check simulated:omni --rate 7 --report " + at("new.md"), "rate");
  EXPECT_EQ(fileCount(), 1u);
}

}  // namespace
}  // namespace app
