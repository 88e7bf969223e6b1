#include "haptics/servo/measured_handle.h"

#include <gtest/gtest.h>

#include <limits>
#include <mutex>
#include <random>

#include "haptics/device/simulated/simulated_phantom.h"
#include "haptics/device/simulated_device.h"
#include "haptics/servo/haptic_loop.h"
#include "tests/haptics/phantom.h"
#include "tests/haptics/untrue_omni.h"

namespace haptics {
namespace {

using namespace phantom;
using calibration::Device;
using calibration::Handle;
using calibration::MeasuredArm;
using calibration::PerturbedArm;
using calibration::Point;
using calibration::Pose;
using calibration::World;

MeasuredArm perfectlyMeasured(const PerturbedArm& arm, const Pose<World, Device>& X_WD = {}) {
  return {arm.geometry, arm.truth, X_WD};
}

/// What the driver of an untrue arm says while the handle is truly there.
HandleState stateAt(const PerturbedArm& arm, const Pose<Device, Handle>& X_DH) {
  HandleState state;
  state.joints_rad = arm.rawAt(X_DH).value();
  state.has_joints = true;
  state.X_DH = calibration::handlePose(arm.geometry, {}, state.joints_rad);
  return state;
}

Pose<World, Device> crooked() {
  return {glm::normalize(glm::angleAxis(0.72, glm::dvec3(1, 0, 0)) * glm::angleAxis(0.1, glm::dvec3(0, 0.6, 0.8))),
          {4.0, -60.0, -30.0}};
}

TEST(MeasuredHandle, WithAPerfectCorrectionIsWhereItTrulyIs) {
  double driver_off_mm = 0.0;
  int poses = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const PerturbedArm arm = untrueOmni(seed);
    const MeasuredArm measured = perfectlyMeasured(arm, crooked());
    MeasuredHandle handle(measured);
    std::mt19937 rng(seed);
    for (int n = 0; n < 25; ++n) {
      const auto truth_DH = heldSomewhere(rng);
      const HandleState state = stateAt(arm, truth_DH);
      const auto X_WH = measured.X_WD * handle.corrected(state).X_DH;
      const Point<Handle> tip_H{arm.truth.tip_H_mm};
      const glm::dvec3 truth_W_mm = (crooked() * (truth_DH * tip_H)).mm;
      ASSERT_LT(glm::distance((X_WH * tip_H).mm, truth_W_mm), 1e-6) << seed;
      driver_off_mm +=
          glm::distance((crooked() * (state.X_DH * Point<Handle>{calibration::kNominalTip_H_mm})).mm, truth_W_mm);
      ++poses;
    }
  }
  EXPECT_GT(driver_off_mm / poses, 0.5) << "there was nothing to correct";
}

TEST(MeasuredHandle, WithoutAnArmOrWithoutAnglesIsTheDrivers) {
  std::mt19937 rng(3);
  const PerturbedArm arm = untrueOmni(3);
  HandleState state = stateAt(arm, heldSomewhere(rng));
  EXPECT_EQ(MeasuredHandle(std::nullopt).corrected(state).X_DH.translation_mm, state.X_DH.translation_mm);
  state.has_joints = false;
  MeasuredHandle handle(perfectlyMeasured(arm));
  const HandleState same = handle.corrected(state);
  EXPECT_EQ(same.X_DH.translation_mm, state.X_DH.translation_mm);
  EXPECT_TRUE(same.fresh);
}

TEST(MeasuredHandle, StaysWhereItWasWhenTheAnglesAreLost) {
  std::mt19937 rng(4);
  const PerturbedArm arm = untrueOmni(4);
  MeasuredHandle handle(perfectlyMeasured(arm));
  const HandleState before = handle.corrected(stateAt(arm, heldSomewhere(rng)));
  HandleState lost = stateAt(arm, heldSomewhere(rng)), mad = lost;
  lost.has_joints = false;
  mad.joints_rad[1] = std::numeric_limits<double>::quiet_NaN();
  for (const HandleState& state : {lost, mad}) {
    const HandleState after = handle.corrected(state);
    EXPECT_EQ(after.X_DH.translation_mm, before.X_DH.translation_mm);
    EXPECT_EQ(after.X_DH.rotation, before.X_DH.rotation);
    EXPECT_FALSE(after.fresh);
  }
}

TEST(MeasuredHandle, RefusesAnArmThatIsNotFinite) {
  MeasuredArm arm = perfectlyMeasured(untrueOmni(1));
  arm.correction.gain[2] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(MeasuredHandle{arm}, DeviceError);
}

/// Holds one state and remembers the largest force it was told.
class HeldDevice final : public SimulatedDevice {
 public:
  explicit HeldDevice(const HandleState& state) : state_(state) {}
  ~HeldDevice() override { stop(); }
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  HandleState exchange(const Wrench<Device>&, double) noexcept override { return state_; }
  void drive(const MotorCommand& command) noexcept override {
    const glm::dvec3 force_N = command.wrench_D().force_N.xyz;
    if (glm::length(force_N) > glm::length(most_N)) most_N = force_N;
  }
  glm::dvec3 most_N{0.0};

 private:
  HandleState state_;
  DeviceCapabilities capabilities_;
};

TEST(HapticLoop, WithAMeasuredArmFeelsTheBoneWhereAndAsItIsSeen) {
  // Bone below z = 0 of W, which is P; the tool truly 1 mm above it, where only the correction puts it.
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const PerturbedArm arm = untrueOmni(seed);
    const MeasuredArm measured = perfectlyMeasured(arm, crooked());
    const Pose<Handle, calibration::Tool> X_HT{{1.0, 0.0, 0.0, 0.0}, arm.truth.tip_H_mm};
    const Pose<Device, Handle> held_DH{{1.0, 0.0, 0.0, 0.0}, {5.0, -20.0, 10.0}};
    const glm::dvec3 wanted_W_mm(0.1, 0.2, 1.0);
    // The base is put so that this pose holds the tip there.
    Pose<World, Device> X_WD = crooked();
    X_WD.translation_mm = wanted_W_mm - X_WD.rotation * (held_DH * Point<Handle>{arm.truth.tip_H_mm}).mm;

    Bodies bone = halfSpace(4.0, 0.25).bodies(1);
    Servo servo(bone);
    Latest<Command> commands;
    TickLog log;
    Latest<Tick> newest;
    LoopSettings settings;
    settings.priority = std::nullopt;
    settings.X_PD = {X_WD.rotation, X_WD.translation_mm};
    settings.X_HT = X_HT;
    settings.arm = measured;
    HeldDevice device(stateAt(arm, held_DH));
    HapticLoop loop(servo, ServedDevice::steppedManually(device), commands, log, newest, settings);
    loop.start();
    loop.step(60);
    loop.stop();
    const Tick tick = newest.read();
    EXPECT_LT(glm::distance(tick.hand.X_PT.translation_mm, wanted_W_mm), 1e-6) << seed;

    ASSERT_GT(glm::length(device.most_N), 0.1);
    const glm::dvec3 true_z_D = glm::conjugate(X_WD.rotation) * glm::dvec3(0.0, 0.0, 1.0);
    EXPECT_GT(glm::dot(glm::normalize(device.most_N), true_z_D), std::cos(calibration::radFromDegrees(0.1))) << seed;
  }
}

TEST(SimulatedPhantom, OfAnUntrueArmIsTakenForAnotherPlaceByItsDriverAlone) {
  PhantomMechanics mechanics = *findSimulatedPhantom("omni");
  mechanics.sensing = {};
  mechanics.dry_N = 0.0;
  const PerturbedArm arm = untrueOmni(5);
  HandTarget still;
  still.position_mm = {10.0, -20.0, 15.0};
  SimulatedPhantom device(mechanics, [still](double) { return still; }, {0.055, 0.3, 0.003, 0.0}, 1, {"unit-5", arm});
  EXPECT_EQ(device.capabilities().serial, "unit-5");
  EXPECT_EQ(device.capabilities().arm_model, "omni");
  const HandleState state = device.exchange({}, 1e-3);
  MeasuredHandle handle(perfectlyMeasured(arm));
  ASSERT_TRUE(state.has_joints);
  EXPECT_GT(glm::distance(state.X_DH.translation_mm, still.position_mm), 0.3);
  EXPECT_LT(glm::distance(handle.corrected(state).X_DH.translation_mm, still.position_mm), 1e-6);
}

}  // namespace
}  // namespace haptics
