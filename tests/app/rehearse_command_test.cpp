#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "app/practice_device.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/rig_store.h"
#include "tests/app/program.h"

namespace app {
namespace {

/// A coarse patient keeps these quick; the cache is this build's own.
class RehearseCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    setenv("MOLAR_CALIBRATION", at("store").c_str(), 1);
  }
};

constexpr char kCoarse[] = "rehearse --headless --device scripted --voxel 0.6 --size 96x64 ";

TEST_F(RehearseCommand, RecordsWhatReplaysBitForBit) {
  const Said said = molar(kCoarse + std::string("--seconds 4 --record ") + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("removed"), std::string::npos);
  const Said replay = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  const Said metrics = molar("metrics " + at("s.molar") + " --json");
  ASSERT_EQ(metrics.status, 0) << metrics.err;
  const auto json = nlohmann::json::parse(metrics.out);
  EXPECT_GE(json.at("duration_s").get<double>(), 4.0);
  EXPECT_GE(json.at("ticks").get<int>(), 4000);
  EXPECT_GT(json.at("removed_mm3").get<double>(), 1.0) << "the scripted hand carves";
  EXPECT_LE(json.at("max_force_N").get<double>(), 3.3 + 1e-9);

  // Any changed byte is found.
  std::string bytes = read("s.molar");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write("t.molar", bytes);
  EXPECT_NE(molar("replay " + at("t.molar") + " --verify").status, 0);
}

/// A simulated Phantom is armed and carves; what it recorded moves again as a hand of its own.
TEST_F(RehearseCommand, ArmsASimulatedPhantomAndReplaysItsHand) {
  const std::string quiet = "rehearse --headless --voxel 0.6 --size 96x64 ";
  const Said said = molar(quiet + "--device simulated:omni --seconds 7 --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("There is no force yet."), std::string::npos) << said.err;
  EXPECT_NE(said.err.find("The hand feels the tissue."), std::string::npos) << said.err;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  const Said again = molar(quiet + "--device replay:" + at("s.molar") + " --seconds 2 --record " + at("t.molar"));
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(molar("replay " + at("t.molar") + " --verify").status, 0);
  EXPECT_EQ(molar(quiet + "--device replay:" + at("none.molar")).status, 2);
}

/// The rig of one untrue arm, known as it truly is.
calibration::RigRecord rigOf(const calibration::SyntheticRig& truth, calibration::Verdict verdict) {
  calibration::RigRecord record;
  record.rig = truth.nominal;
  record.rig.X_WD = truth.X_WD;
  record.rig.arm = truth.arm.truth;
  record.provenance.rig_id = "rig-02";
  record.provenance.created_utc = "2026-11-19T08:00:00Z";
  record.provenance.mirror_kind = "front_surface";
  record.proof = calibration::RigProof{};
  record.proof->verdict = verdict;
  record.proof->errors.n = 16;
  record.proof->errors.rms_mm = 1.4, record.proof->errors.mean_mm = 1.2;
  record.proof->errors.p95_mm = 2.0, record.proof->errors.max_mm = 2.5;
  record.proof->checked_utc = record.provenance.created_utc;
  return record;
}

/// Sure arms, so that the work is the same on every machine: an untrue arm under its rig, and under the default one.
TEST_F(RehearseCommand, WorksOnAPracticeDeviceWhereItsRigHasIt) {
  const auto truth = *practiceRig("practice:B:3");
  const calibration::RigRecord green = rigOf(truth, calibration::Verdict::green),
                               red = rigOf(truth, calibration::Verdict::red);
  calibration::RigStore(at("store")).keep({"rig-02", truth.nominal.device->serial, "right"}, green, "", true);
  const std::string line = "rehearse --headless --voxel 0.6 --size 96x64 --device practice:B:3 ";
  const auto metricsOf = [&](const std::string& session) {
    return nlohmann::json::parse(molar("metrics " + at(session) + " --json").out);
  };

  const Said said = molar(line + "--seconds 7 --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("current rig rig-02: green"), std::string::npos) << said.err;
  EXPECT_NE(said.out.find("calibration      green, 1.40 mm RMS of 16"), std::string::npos) << said.out;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
  const auto json = metricsOf("s.molar");
  EXPECT_EQ(json.at("calibration").at("verdict"), "green");
  EXPECT_EQ(json.at("calibration").at("device_serial"), truth.nominal.device->serial);
  EXPECT_FALSE(json.at("removed_mm3_by_label").contains("other_teeth")) << json;

  // Red: locked, one line, until a word is given, which stays.
  std::ofstream(at("red.yaml")) << calibration::rigRecordText(red);
  const Said locked = molar(line + "--rig " + at("red.yaml"));
  EXPECT_EQ(locked.status, 2);
  EXPECT_EQ(std::ranges::count(locked.err, '\n'), 1) << locked.err;
  const std::string word = "--despite-calibration 'for show' --seconds 0.3 --record ";
  EXPECT_EQ(molar(line + "--rig " + at("red.yaml") + " " + word + at("t.molar")).status, 0);
  EXPECT_EQ(metricsOf("t.molar").at("calibration").at("despite"), "for show");

  // Another unit, and the rig of none.
  EXPECT_EQ(molar("rehearse --headless --voxel 0.6 --device practice:B:4 --rig " + at("red.yaml")).status, 2);
  EXPECT_EQ(molar("rehearse --headless --voxel 0.6 --device practice:Z").status, 2);
  EXPECT_EQ(molar(line + "--rig mirrored --seconds 0.3 --record " + at("u.molar")).status, 0);
  EXPECT_EQ(metricsOf("u.molar").at("calibration").at("rig"), "default");
}

/// Through the whole program, with our stand-in for the vendor's library.
TEST_F(RehearseCommand, ServesAPhantomThroughTheVendorsLibrary) {
  setenv("MOLAR_OPENHAPTICS", MOLAR_STAND_IN_HD, 1);
  const std::string line = "rehearse --headless --voxel 0.6 --size 96x64 --device openhaptics --seconds 2 ";
  const Said said = molar(line + "--record " + at("s.molar"));
  unsetenv("MOLAR_OPENHAPTICS");
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(said.out.find("latched"), std::string::npos) << said.out;
  EXPECT_EQ(molar("replay " + at("s.molar") + " --verify").status, 0);
}

TEST_F(RehearseCommand, SaysInOneLineWhyADeviceCanNotBeHad) {
  setenv("MOLAR_OPENHAPTICS", at("libHD.so").c_str(), 1);
  for (const char* address :
       {"openhaptics", "wooden", "falcon", "usb", "wooden:9-9", "spoon", "replay:", "simulated:x"}) {
    const Said said = molar("rehearse --headless --voxel 0.6 --device " + std::string(address));
    EXPECT_EQ(said.status, 2) << address;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  }
  unsetenv("MOLAR_OPENHAPTICS");
}

TEST_F(RehearseCommand, LeavesPicturesOfBothEyes) {
  const Said said = molar(kCoarse + std::string("--seconds 0.2 --snapshot-size 160x100 --snapshot ") + at("end.png"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read("end_left.png").substr(1, 3), "PNG");
  EXPECT_NE(read("end_left.png"), read("end_right.png"));
}

/// Law and gains change while it runs, every change is said and recorded, and the recording still replays bit for bit.
TEST_F(RehearseCommand, ObeysASettingsFileWhileItChanges) {
  const std::string file = write("feel.toml", "[law]\nstiffness_N_per_mm = 0.6\n");
  // Changed once it is being recorded, however long the patient took to make.
  const std::string later = "(while [ ! -e " + at("s.molar") + " ]; do sleep 0.1; done; sleep 1.5; echo '[law]' > " +
                            file + ".new; echo 'name = \"forssim\"' >> " + file + ".new; mv " + file + ".new " + file +
                            "; sleep 1; echo '[law' > " + file + ") & ";
  std::system((later + "true").c_str());
  const Said said = molar(kCoarse + std::string("--seconds 5 --parameters ") + file + " --record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.err.find("[law] name agus -> forssim"), std::string::npos) << said.err;
  EXPECT_NE(said.err.find("line 1: no TOML"), std::string::npos) << said.err;
  EXPECT_NE(said.err.find("the old values stay"), std::string::npos) << said.err;
  const Said replay = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
}

TEST_F(RehearseCommand, RefusesABadSettingsFileAtTheStart) {
  write("feel.toml", "[law]\nstiffness_N_per_mm = 99\n");
  expectRefusal(kCoarse + std::string("--parameters ") + at("feel.toml"), "line 2: [law] stiffness_N_per_mm");
  expectRefusal("rehearse --headless --device simulated --voxel 0.6 --set stiffness_N_per_mm=10", "2b/T");
  expectRefusal(kCoarse + std::string("--law harmonic --tool cone:1,2"), "does not admit");
  expectRefusal(kCoarse + std::string("--law spring"), "forssim");
}

TEST_F(RehearseCommand, ShowsWhatTheOtherHandHolds) {
  const auto end = [&](const std::string& options, const std::string& name) {
    const Said said = molar(kCoarse + std::string("--seconds 0.3 --renderer cpu --snapshot-size 160x100 --force ") +
                            options + " --snapshot " + at(name + ".png"));
    EXPECT_EQ(said.status, 0) << said.err;
    return read(name + "_left.png");
  };
  EXPECT_NE(end("--second-hand scripted --second-tool mirror", "mirror"),
            end("--second-hand scripted --second-tool retractor", "retractor"));
  expectRefusal(kCoarse + std::string("--second-hand mouse"), "--second-hand mouse");
}

TEST_F(RehearseCommand, KeepsAnOldRecording) {
  write("s.molar", "precious");
  expectRefusal(kCoarse + std::string("--seconds 0.2 --record ") + at("s.molar"), "s.molar");
  EXPECT_EQ(read("s.molar"), "precious");
}

}  // namespace
}  // namespace app
