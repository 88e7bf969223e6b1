// Whatever rests on a tooth or canal that nobody has confirmed says so: plan, clearance, metrics, report.
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "assets/patient/patient_folder.h"
#include "assets/synthetic/jaw.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

class NotConfirmed : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    assets::JawParameters coarse;
    coarse.spacing_mm = 0.6;
    patient_ = assets::syntheticJaw(coarse);
    patient_.face = {};
  }
  void save(const std::string& name, std::optional<assets::Confirmation> found) {
    patient_.found = found;
    assets::savePatient(patient_, at(name), false);
  }
  nlohmann::json jsonOf(const std::string& arguments) const {
    const ProgramOutput said = molar(arguments);
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }

  assets::Patient patient_;
};

TEST_F(NotConfirmed, PlanMarksWhatRestsOnToothAndCanal) {
  save("labelled", {});
  save("found", assets::Confirmation{false, false});
  save("tooth", assets::Confirmation{true, false});
  const nlohmann::json labelled = jsonOf("plan " + at("labelled") + " --json");
  for (const auto& [key, item] : labelled.items()) EXPECT_TRUE(item.at("confirmed")) << key;
  const nlohmann::json found = jsonOf("plan " + at("found") + " --json");
  for (const auto& [key, item] : found.items()) EXPECT_EQ(item.at("confirmed"), item.at("value").is_null()) << key;
  const nlohmann::json tooth = jsonOf("plan " + at("tooth") + " --json");
  for (const auto& [key, item] : tooth.items()) EXPECT_EQ(item.at("confirmed"), !key.starts_with("canal")) << key;
  const std::string table = molar("plan " + at("found")).out;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_NE(line.find("not confirmed; ") == std::string::npos, line.find("not known") == std::string::npos) << line;
  EXPECT_EQ(molar("plan " + at("labelled")).out.find("not confirmed"), std::string::npos);
  EXPECT_NE(molar("plan " + at("tooth")).err.find("not confirmed: what rests on the canal of"), std::string::npos);
}

TEST_F(NotConfirmed, ClearanceNamesTheColumnsThatRestOnIt) {
  save("labelled", {});
  save("canal", assets::Confirmation{false, true});
  save("found", assets::Confirmation{false, false});
  write("p.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz\n0,-20,36,0,1,0,0,0\n");
  const auto rows = [&](const std::string& patient) {
    EXPECT_EQ(
        molar("clearance " + at(patient) + " --tool sphere:1 --poses " + at("p.csv") + " --force --out " + at("c.csv"))
            .status,
        0);
    return read("c.csv");
  };
  const std::string plain = rows("labelled");
  EXPECT_TRUE(plain.starts_with("t_s,canal_mm,lingual_mm,second_molar_mm\n")) << plain;
  EXPECT_NE(rows("canal").find(",lingual_mm second_molar_mm\n"), std::string::npos);
  const std::string marked = rows("found");
  EXPECT_TRUE(marked.starts_with("t_s,canal_mm,lingual_mm,second_molar_mm,not_confirmed\n")) << marked;
  EXPECT_TRUE(marked.ends_with(",canal_mm lingual_mm second_molar_mm\n")) << marked;
  // The same distances.
  const std::string row = plain.substr(plain.find('\n') + 1, plain.size() - plain.find('\n') - 2);
  EXPECT_NE(marked.find("\n" + row + ","), std::string::npos) << plain << marked;
}

TEST_F(NotConfirmed, MetricsAndReportOfARehearsalMarkThem) {
  save("found", assets::Confirmation{false, false});
  save("labelled", {});
  const auto rehearse = [&](const std::string& patient) {
    const ProgramOutput said =
        molar("rehearse " + at(patient) +
              " --headless --pace fast --device scripted --size 96x64 --seconds 6 --record " + at(patient + ".molar"));
    ASSERT_EQ(said.status, 0) << said.err;
    EXPECT_EQ(said.out.find("(not confirmed)") != std::string::npos, patient == "found") << said.out;
  };
  rehearse("found");
  rehearse("labelled");
  const nlohmann::json marked = jsonOf("metrics " + at("found.molar") + " --json");
  const nlohmann::json plain = jsonOf("metrics " + at("labelled.molar") + " --json");
  EXPECT_FALSE(marked.at("confirmed"));
  EXPECT_EQ(marked.at("not_confirmed").at("what"), nlohmann::json({"tooth", "canal"}));
  EXPECT_TRUE(plain.at("confirmed"));
  EXPECT_TRUE(plain.at("not_confirmed").is_null());
  std::set<std::string> grey;
  for (const nlohmann::json& measure : marked.at("measures"))
    if (!measure.at("confirmed")) grey.insert(measure.at("id"));
  for (const char* id :
       {"S1.canal", "S2.canal_2mm", "S3.canal_max", "S4.canal", "S5.canal", "S1.lingual", "S1.second_molar",
        "S1.lingual_nerve", "O1.bone", "O2.plan", "O5.area", "O10.second_molar", "S8.tooth", "M9.planned_size"})
    EXPECT_TRUE(grey.contains(id)) << id;
  for (const char* id : {"M1.on", "M2.path", "M5.SPARC", "S10.dry", "S9.time", "PI"})
    EXPECT_FALSE(grey.contains(id)) << id;
  for (const nlohmann::json& measure : plain.at("measures")) EXPECT_TRUE(measure.at("confirmed")) << measure;
  for (const nlohmann::json& gate : marked.at("gates")) EXPECT_FALSE(gate.at("confirmed")) << gate;
  for (const nlohmann::json& key : marked.at("not_confirmed").at("keys")) EXPECT_TRUE(marked.contains(key)) << key;

  const std::string text = molar("metrics " + at("found.molar")).out;
  EXPECT_TRUE(text.starts_with("not confirmed: tooth and canal were found by the program")) << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("least clearance to the mandibular canal") != std::string::npos) {
      EXPECT_TRUE(line.ends_with(" (not confirmed)")) << line;
    }
    if (line.find("path length of the bur's centre") != std::string::npos) {
      EXPECT_FALSE(line.ends_with(" (not confirmed)")) << line;
    }
  }
  EXPECT_EQ(molar("metrics " + at("labelled.molar")).out.find("not confirmed"), std::string::npos);

  for (const char* name : {"found", "labelled"})
    ASSERT_EQ(molar("report " + at(std::string(name) + ".molar") + " --patient " + at(name) + " --out " +
                    at(std::string(name) + ".html"))
                  .status,
              0);
  const std::string page = read("found.html");
  EXPECT_NE(page.find("<p class=\"unconfirmed\">Not confirmed: tooth and canal were found"), std::string::npos);
  for (const char* name : {"least bone left before the outer lingual surface", "angulation", "touched by the bur"})
    EXPECT_NE(page.find("<span class=\"unconfirmed\">" + std::string(name)), std::string::npos) << name;
  EXPECT_NE(page.find("mandibular canal, not confirmed"), std::string::npos);
  EXPECT_EQ(page.find("<span class=\"unconfirmed\">way of the bur's centre"), std::string::npos);
  EXPECT_EQ(read("labelled.html").find("not confirmed"), std::string::npos);
  EXPECT_EQ(read("labelled.html").find("class=\"unconfirmed\""), std::string::npos);
}

}  // namespace
}  // namespace app
