#include <regex>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class CalibrateCommand : public ProgramTest {
 protected:
  /// A unit with its touches, and others to judge by.
  void simulate(const std::string& options = "--seed 7", const std::string& name = "obs") const {
    const ProgramOutput said = molar("calibrate simulate --scenario D " + options + " --out " + at(name + ".yaml") +
                                     " --held-out " + at(name + "_held.yaml"));
    ASSERT_EQ(said.status, 0) << said.err;
  }
  nlohmann::json proof(const std::string& rig, const std::string& touches) const {
    return nlohmann::json::parse(molar("calibrate verify " + at(rig) + " " + at(touches) + " --json").out);
  }
  std::string current(const std::string& store) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(at(store)))
      if (entry.path().filename() == "current") {
        std::ifstream file(entry.path());
        std::string name;
        std::getline(file, name);
        return name;
      }
    return {};
  }
};

TEST_F(CalibrateCommand, FitsAndVerifiesAJig) {
  simulate("--seed 7 --outliers 0.03");
  const ProgramOutput said = molar("calibrate fit " + at("obs.yaml") + " --out " + at("rig.yaml") + " --json");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(nlohmann::json::parse(said.out)["model"], "full");
  const auto measured = proof("rig.yaml", "obs_held.yaml");
  EXPECT_EQ(measured["n"], 16);
  EXPECT_LT(measured["tre_rms_mm"], 0.45);
  EXPECT_EQ(measured["bias_mm"].size(), 3u);
  EXPECT_EQ(molar("calibrate verify " + at("rig.yaml") + " " + at("obs_held.yaml")).status, 0);
}

TEST_F(CalibrateCommand, FullBeatsRigidOnHeldOutTouches) {
  simulate();
  for (const char* model : {"rigid", "full"}) {
    const std::string name = std::string(model) + ".yaml";
    const ProgramOutput said = molar("calibrate fit " + at("obs.yaml") + " --model " + model + " --out " + at(name));
    EXPECT_NE(said.status, 2) << said.err;
  }
  EXPECT_LT(2.0 * proof("full.yaml", "obs_held.yaml")["tre_rms_mm"].get<double>(),
            proof("rigid.yaml", "obs_held.yaml")["tre_rms_mm"].get<double>());
}

TEST_F(CalibrateCommand, RezeroCorrectsAMovedUnit) {
  simulate();
  simulate("--seed 7 --drift-deg 0.3 --drift-mm 1", "later");
  ASSERT_EQ(molar("calibrate fit " + at("obs.yaml") + " --out " + at("rig.yaml")).status, 0);
  const std::string drift = "calibrate simulate --scenario D --seed 7 --drift-deg 0.3 --drift-mm 1 --out ";
  molar(drift + at("five.yaml") + " --method rezero5");
  molar(drift + at("four.yaml") + " --method check4");
  EXPECT_EQ(molar("calibrate check " + at("rig.yaml") + " " + at("four.yaml")).status, 1);
  const ProgramOutput said =
      molar("calibrate rezero " + at("rig.yaml") + " " + at("five.yaml") + " --out " + at("new.yaml"));
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(molar("calibrate check " + at("new.yaml") + " " + at("four.yaml")).status, 0);
  EXPECT_LT(proof("new.yaml", "later_held.yaml")["tre_rms_mm"], 0.45);
}

TEST_F(CalibrateCommand, StoresVerifiedRigsAndRollsBack) {
  simulate();
  simulate("--seed 7 --method jig8", "few");
  const std::string store = " --keep --store " + at("store");
  const std::string held = " --held-out " + at("obs_held.yaml");
  const ProgramOutput first = molar("calibrate fit " + at("few.yaml") + held + store);
  EXPECT_NE(first.status, 2) << first.err;
  const std::string before = current("store");
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(molar("calibrate fit " + at("obs.yaml") + held + store).status, 0);
  EXPECT_NE(current("store"), before);

  // Not verified, or red: kept, not in force.
  const std::string in_force = current("store");
  molar("calibrate fit " + at("obs.yaml") + store);
  EXPECT_EQ(current("store"), in_force);

  const ProgramOutput list = molar("calibrate list --store " + at("store"));
  EXPECT_EQ(std::count(list.out.begin(), list.out.end(), '*'), 1) << list.out;
  EXPECT_NE(list.out.find("green"), std::string::npos) << list.out;
  EXPECT_EQ(molar("calibrate rollback --store " + at("store")).status, 0);
  EXPECT_EQ(current("store"), before);
}

TEST_F(CalibrateCommand, ShowsDifferencesAndWritesOnePage) {
  simulate();
  ASSERT_EQ(molar("calibrate fit " + at("obs.yaml") + " --held-out " + at("obs_held.yaml") + " --out " + at("rig.yaml"))
                .status,
            0);
  const ProgramOutput diff = molar("calibrate diff mirrored " + at("rig.yaml"));
  EXPECT_EQ(diff.status, 0) << diff.err;
  EXPECT_NE(diff.out.find("mm"), std::string::npos) << diff.out;
  EXPECT_EQ(molar("calibrate diff " + at("rig.yaml") + " " + at("rig.yaml")).out, "");
  const ProgramOutput said = molar("calibrate report " + at("rig.yaml") + " --out " + at("report.html"));
  EXPECT_EQ(said.status, 0) << said.err;
  const std::string page = read("report.html");
  for (const char* words : {"<svg", "green", "mm", "jig27"}) EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"http"))) << "it must stand alone";
}

TEST_F(CalibrateCommand, CollectsACalibrationThatTheRehearsalUses) {
  const std::string store = " --store " + at("store");
  const std::string robot = " --device practice:D:7 --robot --hurried --headless --keep" + store;
  const ProgramOutput said = molar("calibrate collect" + robot + " --observations " + at("touches.yaml"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_FALSE(current("store").empty());
  EXPECT_NE(read("touches.yaml").find("jig27"), std::string::npos);
  const ProgramOutput check = molar("calibrate check" + robot);
  EXPECT_EQ(check.status, 0) << check.err;

  const ProgramOutput rehearsed =
      molar("rehearse --headless --pace fast --device practice:D:7 --seconds 0.3 --voxel 0.6 --rig-store " +
            at("store") + " --record " + at("s.molar"));
  EXPECT_EQ(rehearsed.status, 0) << rehearsed.err;
  EXPECT_NE(rehearsed.out.find("calibration      green"), std::string::npos) << rehearsed.out;
  const auto metrics = nlohmann::json::parse(molar("metrics " + at("s.molar") + " --json").out);
  EXPECT_EQ(metrics["calibration"]["device_serial"], "SIM-D7");
  EXPECT_EQ(metrics["calibration"]["verdict"], "green");

  // Another unit is not this one.
  expectRefusal("rehearse --headless --device practice:D:8 --rig current --rig-store " + at("store"), "SIM-D8");
}

TEST_F(CalibrateCommand, ARedCheckLocksAGreenRig) {
  const std::string robot = " --device practice:D:7 --robot --hurried --headless --keep --store " + at("store");
  ASSERT_EQ(molar("calibrate collect" + robot).status, 0);
  const std::string rig = at("store") + "/rig/SIM-D7/right/" + current("store");
  const std::string pushed = "calibrate simulate --seed 7 --drift-deg 2 --drift-mm 10 ";
  ASSERT_EQ(molar(pushed + "--method check4 --out " + at("four.yaml")).status, 0);
  ASSERT_EQ(molar(pushed + "--method rezero5 --out " + at("five.yaml")).status, 0);
  EXPECT_EQ(molar("calibrate check " + rig + " " + at("four.yaml") + " --keep --store " + at("store")).status, 1);
  const std::string rehearse =
      "rehearse --headless --pace fast --device practice:D:7 --seconds 0.3 --voxel 0.6 --rig-store " + at("store");
  expectRefusal(rehearse, "red");
  EXPECT_EQ(molar("calibrate report " + rig + " --store " + at("store") + " --out " + at("page.html")).status, 0);
  EXPECT_NE(read("page.html").find("Red"), std::string::npos);
  const ProgramOutput insisted = molar(rehearse + " --despite-calibration \"to try it\"");
  EXPECT_EQ(insisted.status, 0) << insisted.err;

  // A re-zero opens it again, once others prove it.
  const std::string rezero = "calibrate rezero " + rig + " " + at("five.yaml") + " --keep --store " + at("store");
  EXPECT_NE(molar(rezero).err.find("not verified"), std::string::npos);
  expectRefusal(rehearse, "red");
  EXPECT_NE(molar(rezero + " --held-out " + at("four.yaml")).status, 2);
  const ProgramOutput opened = molar(rehearse);
  EXPECT_EQ(opened.status, 0) << opened.err;
}

TEST_F(CalibrateCommand, RefusesToCollectWithoutAStylusOrWithInvalidOptions) {
  for (const char* wrong :
       {"collect --device mouse", "collect --device practice:Z", "collect --device simulated:omni",
        "collect --device practice:D --headless", "collect --device practice:D --robot --headless --method jig9",
        "collect --device practice:D --robot --headless --method rest", "check", "rezero"})
    expectRefusal(std::string("calibrate ") + wrong);
}

TEST_F(CalibrateCommand, RefusesBadInputAndKeepsTheCurrentRig) {
  simulate();
  const std::string good = read("obs.yaml");
  const std::string store = " --held-out " + at("obs_held.yaml") + " --keep --store " + at("store");
  ASSERT_EQ(molar("calibrate fit " + at("obs.yaml") + store).status, 0);
  const std::string in_force = current("store");

  write("cut.yaml", good.substr(0, good.size() / 2));
  write("nan.yaml", std::regex_replace(good, std::regex("p_W_mm: *\\[ *[^,]+,"), "p_W_mm: [ .Nan,",
                                       std::regex_constants::format_first_only));
  write("unit.yaml", std::regex_replace(good, std::regex("\"?omni\"?"), "abacus"));
  write("empty.yaml", "");
  for (const char* name : {"cut", "nan", "unit", "empty", "missing"})
    expectRefusal("calibrate fit " + at(std::string(name) + ".yaml") + store, name);

  // Edited after it was written; of another unit.
  ASSERT_EQ(molar("calibrate fit " + at("obs.yaml") + " --out " + at("rig.yaml")).status, 0);
  std::string edited = read("rig.yaml");
  edited.replace(edited.find("lower_left_mm"), 13, "Lower_left_mm");
  write("edited.yaml", edited);
  expectRefusal("calibrate verify " + at("edited.yaml") + " " + at("obs_held.yaml"), "edited");
  simulate("--seed 8", "other");
  expectRefusal("calibrate verify " + at("rig.yaml") + " " + at("other_held.yaml"), "SIM-D8");
  expectRefusal("calibrate fit " + at("obs.yaml") + " --out " + at("rig.yaml"), "rig.yaml");
  expectRefusal(
      "calibrate fit " + at("obs.yaml") + " --keep --store " + at("store") + " --held-out " + at("other_held.yaml"),
      "SIM-D8");
  expectRefusal("calibrate fit " + at("obs.yaml") + store + " --serial SIM-D8", "SIM-D7");

  // Touches that the fit has seen prove nothing.
  expectRefusal("calibrate fit " + at("obs.yaml") + " --keep --store " + at("store") + " --held-out " + at("obs.yaml"),
                "of the fit");
  expectRefusal("calibrate verify " + at("rig.yaml") + " " + at("obs.yaml"), "verifies nothing");
  expectRefusal("calibrate simulate --scenario H --out " + at("x.yaml"));
  expectRefusal("calibrate simulate --method jig9 --out " + at("x.yaml"), "jig9");
  EXPECT_EQ(current("store"), in_force);
}

TEST_F(CalibrateCommand, ListsStoredRigsDespiteAnInvalidCurrentFile) {
  simulate();
  const std::string store = " --store " + at("store");
  ASSERT_EQ(molar("calibrate fit " + at("obs.yaml") + " --held-out " + at("obs_held.yaml") + " --keep" + store).status,
            0);
  const std::string in_force = current("store");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(at("store")))
    if (entry.path().filename() == "current") std::ofstream(entry.path()) << "banana\n";
  const ProgramOutput said = molar("calibrate list" + store);
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find(in_force), std::string::npos) << said.out;
  EXPECT_NE(said.err.find("names no rig"), std::string::npos) << said.err;
  EXPECT_EQ(molar("calibrate rollback" + store).status, 0);
  EXPECT_EQ(current("store"), in_force);
}

}  // namespace
}  // namespace app
