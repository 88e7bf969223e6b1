#include <thread>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

const std::string kQuickProtocol = R"(participant = "P07"
method = "2afc-constant"
[bone]
voxel_mm = 0.3
[tool]
head = "sphere:1"
[probe]
duration_s = 0.1
[standard]
stiffness_N_per_mm = 0.8
[comparison]
law = "agus"
[vary]
parameter = "stiffness_N_per_mm"
levels = [0.4, 0.8, 1.2]
repetitions = 8
)";

class PsychophysicsCommand : public ProgramTest {};

TEST_F(PsychophysicsCommand, WritesARowATrialAndASummary) {
  const ProgramOutput said = molar("psychophysics " + write("p.toml", kQuickProtocol) + " --out " + at("r.csv"));
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string csv = read("r.csv");
  EXPECT_TRUE(csv.starts_with("trial,participant,method,track,first,parameter,unit,")) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 24);
  EXPECT_NE(csv.find("\n24,P07,2afc-constant,"), std::string::npos);
  EXPECT_TRUE(read("r.png").starts_with("\x89PNG"));
  const auto summary = nlohmann::json::parse(read("r.json"));
  EXPECT_EQ(summary["trials"], 24);
  EXPECT_EQ(summary["comparison_first"], 12);
  EXPECT_EQ(summary["complete"], true);
  EXPECT_GT(summary["share_correct"], 0.85);
  EXPECT_NEAR(summary["fit"]["pse"].get<double>(), 0.8, 0.2);
}

TEST_F(PsychophysicsCommand, IsReproducibleBySeed) {
  const std::string run = "psychophysics " + write("p.toml", kQuickProtocol) + " --out ";
  ASSERT_EQ(molar(run + at("a.csv") + " --seed 5").status, 0);
  ASSERT_EQ(molar(run + at("b.csv") + " --seed 5").status, 0);
  ASSERT_EQ(molar(run + at("c.csv") + " --seed 6").status, 0);
  EXPECT_EQ(read("a.csv"), read("b.csv"));
  EXPECT_EQ(read("a.json"), read("b.json"));
  EXPECT_NE(read("a.csv"), read("c.csv"));
}

TEST_F(PsychophysicsCommand, OverwritesNothingWithoutForce) {
  const std::string protocol = write("p.toml", kQuickProtocol);
  write("r.csv", "precious");
  expectRefusal("psychophysics " + protocol + " --out " + at("r.csv"), "r.csv");
  EXPECT_EQ(read("r.csv"), "precious");
  write("s.json", "precious");
  expectRefusal("psychophysics " + protocol + " --out " + at("s.csv"), "s.json");
  EXPECT_EQ(read("s.json"), "precious");
  expectRefusal("psychophysics " + protocol + " --out " + at("r.txt"), ".csv");
  expectRefusal("psychophysics " + at("none.toml") + " --out " + at("q.csv"), "none.toml");
  write("bad.toml", kQuickProtocol + "colour = 1\n");
  expectRefusal("psychophysics " + at("bad.toml") + " --out " + at("r.csv") + " --force", "line 17: [vary] colour");
  EXPECT_EQ(read("r.csv"), "precious") << "a bad protocol changes no file";
  EXPECT_EQ(molar("psychophysics " + protocol + " --out " + at("r.csv") + " --force").status, 0);
}

TEST_F(PsychophysicsCommand, ExitsWithOneIfTheRecordingIsLost) {
  if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  // The disk is full after 200 kB, a second of ticks; once that was said, it is ended.
  const int status =
      std::system(("trap '' XFSZ; ulimit -f 400; " + std::string(MOLAR_PROGRAM) + " psychophysics " +
                   write("p.toml", kQuickProtocol) + " --observer keyboard --out " + at("r.csv") + " --record " +
                   at("s.molar") + " >/dev/null 2>" + at("said") + " & p=$!; while ! grep -qF 'recording ended' " +
                   at("said") + " && kill -0 $p; do sleep 0.05; done; kill -TERM $p; wait $p")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1) << read("said");
  EXPECT_NE(read("said").find("recorded in      " + at("s.molar") + ", "), std::string::npos) << read("said");
  EXPECT_NE(read("said").find("ticks lost; the recording ended early: "), std::string::npos) << read("said");
}

TEST_F(PsychophysicsCommand, KeepsEveryAnsweredTrialWhenKilled) {
  std::string slow = kQuickProtocol;
  slow.replace(slow.find("repetitions = 8"), 15, "repetitions = 500");
  const std::string protocol = write("p.toml", slow);
  // Killed as soon as some rows are there, however slow the machine is.
  const std::string rows_so_far = "$(cat " + at("r.csv") + " 2>&1 | wc -l)";
  const int status = std::system((std::string(MOLAR_PROGRAM) + " psychophysics " + protocol + " --out " + at("r.csv") +
                                  " >/dev/null 2>&1 & p=$!; while [ " + rows_so_far +
                                  " -lt 6 ] && kill -0 $p; do sleep 0.02; done; kill -KILL $p; wait $p")
                                     .c_str());
  ASSERT_NE(status, 0);
  const std::string csv = read("r.csv");
  const auto columns = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  std::istringstream lines(csv);
  std::string header, line;
  std::getline(lines, header);
  int rows = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(columns(line), columns(header)) << line;
    EXPECT_TRUE(line.starts_with(std::to_string(++rows) + ",")) << line;
  }
  EXPECT_GT(rows, 3);
  EXPECT_EQ(csv.back(), '\n');
}

}  // namespace
}  // namespace app
