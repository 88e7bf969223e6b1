// `molar report`, `compare`, `trend`: what a recorded rehearsal leaves on paper, made from the file alone.
#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class ReportCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    setenv("MOLAR_CALIBRATION", at("store").c_str(), 1);
  }
  /// A few seconds of the planned cut in a coarse patient.
  void rehearse(const std::string& file, const std::string& more = "--seconds 8") {
    const ProgramOutput said = molar("rehearse --headless --pace fast --device scripted --voxel 0.6 --size 96x64 " +
                                     more + " --record " + at(file));
    ASSERT_EQ(said.status, 0) << said.err;
  }
};

TEST_F(ReportCommand, MakesOnePageFromASessionTheSameEachTime) {
  rehearse("a.molar");
  const ProgramOutput said = molar("report " + at("a.molar") + " --out " + at("a.html"));
  ASSERT_EQ(said.status, 0) << said.err;
  const std::string page = read("a.html");
  for (const char* words : {"The case", "mesio-angular", "Errors", "Lingual plate", "cortical bone", "Dice",
                            "painting index", "Timeline", "round 3.0 mm", "agus"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_EQ(page.find(at("")), std::string::npos) << "no path";
  EXPECT_NE(page.find("<figure id=\"picture-1\">"), std::string::npos) << "the nearest place is shown";
  EXPECT_EQ(page.find("<script"), std::string::npos);
  ASSERT_EQ(molar("report " + at("a.molar") + " --out " + at("b.html")).status, 0);
  EXPECT_EQ(page, read("b.html"));
}

TEST_F(ReportCommand, ComparesTwoRehearsalsOfACase) {
  rehearse("a.molar");
  rehearse("b.molar", "--seconds 12");
  const ProgramOutput same = molar("compare " + at("a.molar") + " " + at("a.molar") + " --json");
  ASSERT_EQ(same.status, 0) << same.err;
  const auto self = nlohmann::json::parse(same.out);
  EXPECT_EQ(self.at("bone").at("only_first_mm3"), 0.0);
  EXPECT_EQ(self.at("bone").at("dice"), 1.0);
  const auto two = nlohmann::json::parse(molar("compare " + at("a.molar") + " " + at("b.molar") + " --json").out);
  EXPECT_NEAR(two.at("bone").at("only_first_mm3").get<double>(), 0.0, 1e-6) << "the longer one did all of the shorter";
  EXPECT_GT(two.at("bone").at("only_second_mm3").get<double>(), 0.1);
  for (const auto& measure : two.at("measures")) {
    if (measure.at("id") != "duration_s") continue;
    EXPECT_NEAR(measure.at("difference").get<double>(), 4.0, 1e-9);
  }
  const std::string words = molar("compare " + at("a.molar") + " " + at("b.molar")).out;
  EXPECT_NE(words.find("0:08 min and 0:12 min\nbone removed: "), std::string::npos) << words;
  EXPECT_EQ(words.find("mm3"), std::string::npos) << "units as people write them";
  EXPECT_EQ(words.find("length of the work"), std::string::npos) << "no measure twice";
  ASSERT_EQ(molar("compare " + at("a.molar") + " " + at("b.molar") + " --out " + at("two.html")).status, 0);
  const std::string page = read("two.html");
  for (const char* said :
       {"Two rehearsals", "by the second alone", "First and second, from above", "second, from the tongue"})
    EXPECT_NE(page.find(said), std::string::npos) << said;
  EXPECT_EQ(page.find(at("")), std::string::npos) << "no path";
  EXPECT_EQ(molar("report " + at("b.molar") + " --compare " + at("a.molar") + " --out " + at("c.html")).status, 0);
  EXPECT_NE(read("c.html").find("compared with"), std::string::npos);
}

TEST_F(ReportCommand, TellsTheTrendOfAFolderFromThreeRunsOn) {
  for (const char* file : {"a.molar", "b.molar"}) rehearse(file, "--seconds 3");
  EXPECT_TRUE(nlohmann::json::parse(molar("trend " + at("") + " --json").out)[0].at("spread").at("minutes").is_null());
  rehearse("c.molar", "--seconds 6");
  const ProgramOutput said = molar("trend " + at("") + " --json");
  ASSERT_EQ(said.status, 0) << said.err;
  const auto trend = nlohmann::json::parse(said.out);
  ASSERT_EQ(trend.size(), 1U);
  EXPECT_EQ(trend[0].at("runs").size(), 3U);
  EXPECT_NEAR(trend[0].at("spread").at("minutes").at("median").get<double>(), 0.05, 1e-9);
  EXPECT_NEAR(trend[0].at("spread").at("minutes").at("most").get<double>(), 0.1, 1e-9);
  EXPECT_NE(molar("trend " + at("")).out.find("median"), std::string::npos);
}

/// The same work twice: only the file tells which of them is reported.
TEST_F(ReportCommand, FindsItsSessionInTheTrendByTheFile) {
  std::filesystem::create_directory(at("folder"));
  for (const char* file : {"folder/a.molar", "folder/b.molar"}) rehearse(file, "--seconds 3");
  const auto page = [&](const std::string& session) {
    const ProgramOutput said =
        molar("report " + at(session) + " --trend " + at("folder") + " --force --out " + at("t.html"));
    EXPECT_EQ(said.status, 0) << said.err;
    return read("t.html");
  };
  const auto own = [](const std::string& text) { return text.find("the square is this one") != std::string::npos; };
  const std::string first = page("folder/a.molar"), second = page("folder/b.molar");
  EXPECT_TRUE(own(first) && own(second));
  EXPECT_NE(first.substr(first.find("<h2>Over time")), second.substr(second.find("<h2>Over time")))
      << "the square is at another place";
  std::filesystem::copy(at("folder/a.molar"), at("c.molar"));
  EXPECT_FALSE(own(page("c.molar"))) << "a copy that lies elsewhere is not in the folder";
}

/// A wrong file named beside it costs no replay: it is refused before the session is read, here one that is broken.
TEST_F(ReportCommand, LooksAtAllThatIsNamedBeforeTheReplay) {
  rehearse("a.molar", "--seconds 1");
  rehearse("left.molar", "--seconds 1 --case shallow");
  std::string bytes = read("a.molar");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write("broken.molar", bytes);
  write("set.json", R"({"molar_reference": 1, "name": "s", "case": "another", "made_utc": "", "runs": []})");
  const std::string broken = "report " + at("broken.molar") + " --out " + at("c.html") + " ";
  expectRefusal(broken + "--compare " + at("left.molar"), "another case");
  expectRefusal(broken + "--reference " + at("set.json"), "another case");
  expectRefusal(broken + "--trend " + at("nowhere"), "no such folder");
  expectRefusal(broken, "damaged");
}

TEST_F(ReportCommand, RefusesInOneLine) {
  rehearse("a.molar", "--seconds 1");
  rehearse("left.molar", "--seconds 1 --case shallow");
  write("n.molar", "not a session");
  expectRefusal("report " + at("a.molar") + " --out " + at("a.pdf"), "name it .html");
  expectRefusal("report " + at("n.molar") + " --out " + at("n.html"), "n.molar");
  expectRefusal("report " + at("a.molar") + " --compare " + at("left.molar") + " --out " + at("c.html"),
                "another case");
  expectRefusal("compare " + at("a.molar") + " " + at("left.molar"), "of one case");
  expectRefusal("trend " + at("nowhere"), "no such folder");
  write("a.html", "mine");
  expectRefusal("report " + at("a.molar") + " --out " + at("a.html"), "a.html");
  EXPECT_EQ(read("a.html"), "mine");
}

}  // namespace
}  // namespace app
