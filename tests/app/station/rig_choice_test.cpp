#include "app/station/rig_choice.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "app/device/practice_device.h"
#include "app/text/usage_error.h"
#include "calibration/record/rig_file.h"
#include "calibration/record/rig_store.h"
#include "tests/app/session/small_session.h"
#include "tests/app/typed.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

using calibration::RigLocation;
using calibration::RigRecord;
using calibration::RigStore;
using calibration::Verdict;
using testing::Test;

constexpr char kNow[] = "2026-11-22T08:00:00Z";

RigRecord measured(const std::string& rig_id, const std::string& created_utc,
                   std::optional<Verdict> verdict = Verdict::green) {
  const auto truth = *practiceRig("practice:D:7");
  RigRecord record;
  record.rig = truth.nominal;
  record.rig.X_WD = truth.X_WD;
  record.rig.arm = truth.arm.truth;
  record.provenance.rig_id = rig_id;
  record.provenance.created_utc = created_utc;
  record.provenance.mirror_kind = "front_surface";
  if (verdict) {
    record.verification = calibration::RigVerification{};
    record.verification->verdict = *verdict;
    record.verification->errors.n = 16;
    record.verification->errors.rms_mm = 0.24, record.verification->errors.mean_mm = 0.2;
    record.verification->errors.p95_mm = 0.41, record.verification->errors.max_mm = 0.55;
    record.verification->checked_utc = created_utc;
  }
  return record;
}

class RigChoice : public Test {
 protected:
  void keep(const RigRecord& record) const {
    RigStore(folder_.file("store"))
        .keep({record.provenance.rig_id, record.rig.device->serial, "right"}, record, "", true);
  }
  std::string fileOf(const RigRecord& record) const {
    std::ofstream(folder_.file("rig.yaml")) << calibration::rigRecordText(record);
    return folder_.file("rig.yaml");
  }
  /// As typed; the store is this test's.
  std::optional<ChosenRig> choose(const std::string& arguments, const DeviceIdentity& device) const {
    RigOption option;
    tests::type("--rig-store " + folder_.file("store") + " " + arguments,
                [&](CommandLine& command) { option.addTo(command, true); });
    return option.choose(device, kNow);
  }
  std::string refusal(const std::string& arguments, const DeviceIdentity& device) const {
    return tests::refusalOf<UsageError>([&] { choose(arguments, device); });
  }
  const tests::ScratchFolder folder_;
  const DeviceIdentity practice_ = deviceIdentity("practice:D:7", nullptr), mouse_ = deviceIdentity("mouse", nullptr);
};

TEST_F(RigChoice, ReportsThatTheCurrentRigChangedMeanwhile) {
  const RigRecord record = measured("rig-02", "2026-11-19T08:00:00Z");
  keep(record);
  const RigStore store(folder_.file("store"));
  const RigLocation place{"rig-02", record.rig.device->serial, "right"};
  const std::string name = *store.currentName(place);
  const std::filesystem::path pointer = store.pathOf(place, name).parent_path() / "current";
  // A pointer that can be read once.
  std::filesystem::remove(pointer);
  ASSERT_EQ(mkfifo(pointer.c_str(), 0600), 0);
  std::thread writer([&] {
    std::ofstream once(pointer);
    std::filesystem::remove(pointer);
    once << name << "\n";
  });
  EXPECT_NE(refusal("--rig current", mouse_).find("is no longer in force"), std::string::npos);
  writer.join();
}

TEST_F(RigChoice, TakesTheOnlyCurrentRigOfTheDeviceAndReportsItsQuality) {
  EXPECT_FALSE(choose("", practice_));
  keep(measured("rig-02", "2026-11-19T08:00:00Z"));
  const auto chosen = choose("", practice_);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->source, "current rig rig-02");
  EXPECT_TRUE(chosen->record.rig.arm);
  EXPECT_TRUE(chosen->remarks.empty());
  EXPECT_EQ(calibrationText(chosen->calibration), "green, 0.24 mm RMS of 16, 3 days old");
  EXPECT_EQ(chosen->calibration.rig, chosen->record.hash);
  EXPECT_EQ(chosen->calibration.rig_id, "rig-02");
  EXPECT_EQ(chosen->calibration.device_serial, practice_.serial);
  EXPECT_FALSE(chosen->calibration.rig.empty());

  // Another unit has none, and without hardware nothing is asked of the store.
  EXPECT_FALSE(choose("", deviceIdentity("practice:D:8", nullptr)));
  EXPECT_FALSE(choose("", mouse_));
}

TEST_F(RigChoice, AsksWhichWhenSeveralSuit) {
  keep(measured("rig-01", "2026-11-19T08:00:00Z"));
  keep(measured("rig-02", "2026-11-20T08:00:00Z"));
  EXPECT_FALSE(choose("", practice_));
  EXPECT_NE(refusal("--rig current", practice_).find("rig-01"), std::string::npos);
  EXPECT_EQ(choose("--rig current:rig-02", practice_)->record.provenance.rig_id, "rig-02");
  EXPECT_NE(refusal("--rig current:rig-03", practice_).find("no calibration in force"), std::string::npos);
  EXPECT_NE(refusal("--rig current:rig-02 --mount left", practice_).find("no calibration"), std::string::npos);
}

TEST_F(RigChoice, RefusesTheRigOfAnotherDevice) {
  const std::string file = fileOf(measured("rig-02", "2026-11-19T08:00:00Z"));
  EXPECT_TRUE(choose("--rig " + file, practice_));
  const std::string other = refusal("--rig " + file, deviceIdentity("practice:D:8", nullptr));
  EXPECT_NE(other.find("serial"), std::string::npos) << other;
  EXPECT_NE(refusal("--mount left --rig " + file, practice_).find("mount"), std::string::npos);
  haptics::DeviceCapabilities falcon;
  falcon.model = "Novint Falcon";
  EXPECT_NE(refusal("--rig " + file, deviceIdentity("falcon", &falcon)).find("Falcon"), std::string::npos);
}

TEST_F(RigChoice, IgnoresTheArmWithoutHardware) {
  const auto chosen = choose("--rig " + fileOf(measured("rig-02", "2026-11-19T08:00:00Z", Verdict::red)), mouse_);
  ASSERT_TRUE(chosen);
  EXPECT_FALSE(chosen->record.rig.arm);
  ASSERT_EQ(chosen->remarks.size(), 1u);
  EXPECT_NE(chosen->remarks[0].find("ignored"), std::string::npos);
}

TEST_F(RigChoice, IsRefusedWhenRedUntilAReasonIsGiven) {
  const std::string file = "--rig " + fileOf(measured("rig-02", "2026-11-19T08:00:00Z", Verdict::red));
  const std::string locked = refusal(file, practice_);
  EXPECT_NE(locked.find("red, 0.24 mm RMS of 16"), std::string::npos) << locked;
  EXPECT_NE(locked.find("--despite-calibration"), std::string::npos);
  EXPECT_EQ(locked.find('\n'), std::string::npos);
  EXPECT_NE(refusal(file + " --despite-calibration '  '", practice_), "accepted");
  EXPECT_NE(refusal(file + " --despite-calibration " + std::string(200, 'x'), practice_), "accepted");
  const auto chosen = choose(file + " --despite-calibration 'demonstration only'", practice_);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->calibration.despite, "demonstration only");
  EXPECT_NE(calibrationText(chosen->calibration).find("used despite that: demonstration only"), std::string::npos);
  // The word of a rig that is not red is not kept.
  const std::string good = "--rig " + fileOf(measured("rig-02", "2026-11-19T08:00:00Z"));
  EXPECT_EQ(choose(good + " --despite-calibration why", practice_)->calibration.despite, "");
}

TEST_F(RigChoice, ReportsAmberOldAndUnverified) {
  const auto remarkOn = [&](const RigRecord& record) {
    const auto chosen = choose("--rig " + fileOf(record), practice_);
    return chosen->remarks.size() == 1 ? chosen->remarks[0] : std::to_string(chosen->remarks.size()) + " remarks";
  };
  EXPECT_NE(remarkOn(measured("r", "2026-11-19T08:00:00Z", Verdict::amber)).find("amber"), std::string::npos);
  EXPECT_NE(remarkOn(measured("r", "2026-08-01T08:00:00Z")).find("113 days ago"), std::string::npos);
  EXPECT_NE(remarkOn(measured("r", "2026-11-19T08:00:00Z", std::nullopt)).find("nobody has verified"),
            std::string::npos);
}

TEST_F(RigChoice, HasTheRigsThatComeWithTheProgram) {
  const auto mirrored = choose("--rig mirrored", practice_);
  ASSERT_TRUE(mirrored);
  EXPECT_TRUE(mirrored->record.rig.mirror);
  EXPECT_EQ(mirrored->calibration.rig, "default");
  ASSERT_EQ(mirrored->remarks.size(), 1u) << "not measured with this device";
  EXPECT_FALSE(choose("--rig desktop", mouse_)->record.rig.mirror);
  EXPECT_TRUE(choose("--rig desktop", mouse_)->remarks.empty());
}

TEST(PracticeDevice, IsNamedByScenarioAndSeed) {
  EXPECT_FALSE(practiceRig("simulated:omni"));
  EXPECT_FALSE(practiceRig("practiced"));
  EXPECT_EQ(practiceRig("practice:C:12")->seed, 12u);
  EXPECT_EQ(practiceRig("practice:A")->seed, 1u);
  for (const char* bad : {"practice", "practice:", "practice:H", "practice:D:", "practice:D:x", "practice:D:-1",
                          "practice:D:99999999999", "practice:DD:1", "practice:D:7:8"})
    EXPECT_THROW(practiceRig(bad), UsageError) << bad;
}

}  // namespace
}  // namespace app
