#include "app/calibrate/run_wizard.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <atomic>
#include <cmath>

#include "app/calibrate/page_album.h"
#include "app/calibrate/stylus_source.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

using calibration::Scenario;

/// Practice without a window, by a robot in a hurry.
WizardRun practice(CalibrationProcedure procedure, const std::string& method, std::uint32_t seed) {
  WizardRun run;
  run.practice = calibration::syntheticRig(Scenario::d, seed);
  run.practice->technician.outlier_share = 0.0;  // no touch slips
  run.plan.procedure = procedure;
  run.plan.method = method;
  run.plan.record.rig = run.practice->nominal;
  run.plan.device = *run.practice->nominal.device;
  run.plan.settle_s = 1.0;
  run.robot = TechnicianSettings{};
  run.hurried = true;
  run.windows = false;
  run.sounds = false;
  return run;
}

class Folder {
 public:
  Folder() { std::filesystem::remove_all(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("wizard_pages" + std::to_string(getpid()));
};

TEST(WizardShow, ARobotWithoutAWindowComesToAGoodCalibration) {
  const WizardOutcome outcome = runWizard(practice(CalibrationProcedure::full, "jig27", 7));
  ASSERT_EQ(outcome.end, WizardOutcome::End::accepted) << outcome.reason;
  ASSERT_TRUE(outcome.errors);
  EXPECT_LT(outcome.errors->rms_mm, 0.5);
  EXPECT_GE(outcome.touches.touches.size(), 27u);
}

TEST(WizardShow, EveryPageIsAPictureOnce) {
  const Folder folder;
  WizardRun run = practice(CalibrationProcedure::full, "jig8", 3);
  run.pages = folder.path;
  run.plan.record.rig.screen.px = {480, 270};
  runWizard(run);
  int pictures = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path))
    pictures += file.path().extension() == ".png" && file.file_size() > 500;
  EXPECT_GE(pictures, 8);
  EXPECT_THROW(runWizard(run), UsageError);  // there is something in the folder now
}

TEST(WizardShow, WhoeverGivesUpLeavesEverythingAsItWas) {
  WizardRun run = practice(CalibrationProcedure::full, "jig27", 7);
  int turns = 0;
  run.interrupted = [&] { return ++turns > 200; };
  const WizardOutcome outcome = runWizard(run);
  EXPECT_EQ(outcome.end, WizardOutcome::End::declined);
  EXPECT_FALSE(outcome.reason.empty());
}

TEST(WizardShow, WithoutAWindowOnlyARobotMayBeLedThroughIt) {
  WizardRun run = practice(CalibrationProcedure::full, "jig27", 7);
  run.robot.reset();
  EXPECT_THROW(runWizard(run), UsageError);
  run.practice.reset();
  run.windows = true;
  EXPECT_THROW(runWizard(run), std::runtime_error);
}

TEST(SampleOf, BelievesOnlyWhatIsHealthyCalibratedAndFinite) {
  haptics::TimedHandle handle{.t_s = 2.0, .state = {}};
  handle.state.has_joints = true;
  handle.state.joints_rad = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  handle.state.buttons = 3;
  const StylusSample sample = sampleOf(handle);
  EXPECT_TRUE(sample.valid && sample.button);
  EXPECT_EQ(sample.raw_rad, handle.state.joints_rad);
  const auto believes = [&](auto spoil) {
    haptics::TimedHandle spoilt = handle;
    spoil(spoilt.state);
    return sampleOf(spoilt).valid;
  };
  EXPECT_FALSE(believes([](haptics::HandleState& s) { s.healthy = false; }));
  EXPECT_FALSE(believes([](haptics::HandleState& s) { s.calibrated = false; }));
  EXPECT_FALSE(believes([](haptics::HandleState& s) { s.joints_rad[4] = std::nan(""); }));
  EXPECT_FALSE(believes([](haptics::HandleState& s) { s.X_DH.rotation *= 2.0; }));
}

/// Ticks, and has nothing to tell of its joints.
class PlainDevice final : public haptics::PacedDevice {
 public:
  ~PlainDevice() override { stop(); }
  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }

 protected:
  haptics::HandleState sense(double) noexcept override { return {}; }
  void drive(const haptics::MotorCommand&) noexcept override {}

 private:
  haptics::DeviceCapabilities capabilities_;
};

/// Ticks for a while and then never again, until it may go.
class HangingDevice final : public haptics::PacedDevice {
 public:
  ~HangingDevice() override { stop(); }
  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  std::atomic<bool> hangs{false};

 protected:
  haptics::HandleState sense(double) noexcept override {
    while (hangs) usleep(1000);
    haptics::HandleState state;
    state.has_joints = true;
    return state;
  }
  void drive(const haptics::MotorCommand&) noexcept override {}

 private:
  haptics::DeviceCapabilities capabilities_;
};

/// Calls it until `holds`, for 20 s and more: a thread that is kept from ticking so long does not tick.
template <class Holds>
std::vector<StylusSample> taken(StylusSource& source, Holds holds) {
  std::vector<StylusSample> samples;
  for (int n = 0; n < 20'000 && (samples.empty() || !holds(samples.back())); ++n) {
    source.takeInto(samples, {});
    usleep(1000);
  }
  return samples;
}

TEST(DeviceSource, RefusesADeviceThatDoesNotTellItsJoints) {
  PlainDevice device;
  DeviceSource source(device);
  EXPECT_THROW(taken(source, [](const StylusSample&) { return false; }), UsageError);
}

TEST(DeviceSource, TellsOfSilenceAndBringsEverythingInTheOrderOfTime) {
  HangingDevice device;
  DeviceSource source(device);
  std::vector<StylusSample> samples = taken(source, [](const StylusSample& s) { return s.valid; });
  device.hangs = true;
  const std::vector<StylusSample> silent = taken(source, [](const StylusSample& s) { return !s.valid; });
  device.hangs = false;
  const std::vector<StylusSample> back = taken(source, [](const StylusSample& s) { return s.valid; });
  ASSERT_FALSE(silent.empty() || back.empty());
  EXPECT_FALSE(silent.back().valid);
  EXPECT_TRUE(back.back().valid);
  samples.insert(samples.end(), silent.begin(), silent.end());
  samples.insert(samples.end(), back.begin(), back.end());
  for (std::size_t n = 1; n < samples.size(); ++n) EXPECT_GT(samples[n].t_s, samples[n - 1].t_s);
}

TEST(PracticeSource, IsBelievedOnceItsKeyHasPutItIntoTheInkwell) {
  PracticeSource source(calibration::syntheticRig(Scenario::d, 7));
  std::vector<StylusSample> samples;
  for (int n = 0; n < 20; ++n) {
    source.takeInto(samples, {});
    usleep(1000);
  }
  for (const StylusSample& sample : samples) EXPECT_FALSE(sample.valid);
  source.take(render::KeyPressed{.key = render::keyOf('H'), .down = true}, {0.25, 0.0, 0.0}, {0.0, 0.25, 0.0});
  const StylusSample docked = taken(source, [](const StylusSample& s) { return s.docked; }).back();
  EXPECT_TRUE(docked.docked && docked.valid);
  EXPECT_TRUE(source.seen());
}

TEST(RobotSource, HurriedBringsTwentyMillisecondsACall) {
  RobotSource source(calibration::syntheticRig(Scenario::d, 7), {}, true);
  std::vector<StylusSample> samples;
  for (int n = 0; n < 5; ++n) source.takeInto(samples, {});
  ASSERT_EQ(samples.size(), 100u);
  EXPECT_NEAR(samples.back().t_s, 0.1, 1e-9);
}

}  // namespace
}  // namespace app
