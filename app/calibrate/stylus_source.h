// Sources of the wizard's ticks: a device in real time, or the robot technician in real time or as fast as possible.
// mm, s. One thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/calibrate/page_scene.h"
#include "app/calibrate/practice_input.h"
#include "app/calibrate/robot_technician.h"
#include "app/calibrate/stylus_sample.h"
#include "haptics/loop/handle_recorder.h"

namespace app {

/// The sample for the wizard; valid where the device is healthy and calibrated and its pose a pose.
StylusSample sampleOf(const haptics::TimedHandle& handle);

class StylusSource {
 public:
  virtual ~StylusSource() = default;
  /// All ticks since the last call, in the order of time, appended; `view`: what is seen meanwhile.
  virtual void takeInto(std::vector<StylusSample>& out, const WizardView& view) = 0;
  virtual void take(const render::WindowEvent&, const glm::dvec3& /*across_W*/, const glm::dvec3& /*up_W*/) {}
  /// The stylus itself, where it would not be seen without being drawn.
  virtual std::optional<TrueStylus> seen() { return std::nullopt; }
};

/// Listens to a device from construction to destruction. Throws haptics::DeviceError; UsageError at the first tick of a
/// device that does not report its joints.
class DeviceSource : public StylusSource {
 public:
  explicit DeviceSource(haptics::HapticDevice& device);
  void takeInto(std::vector<StylusSample>& out, const WizardView& view) override;

 private:
  std::string model_;
  std::vector<haptics::TimedHandle> taken_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  double last_s_ = -1.0;
  haptics::HandleRecorder hand_;
};

/// Where a practice stylus is at first: before the targets, within reach. Frame W.
inline constexpr glm::dvec3 kPracticeStart_mm{20.0, -20.0, 60.0};

/// A practice stylus, held by mouse and keys.
class PracticeSource final : public StylusSource {
 public:
  explicit PracticeSource(const calibration::SyntheticRig& rig);
  void takeInto(std::vector<StylusSample>& out, const WizardView& view) override;
  void take(const render::WindowEvent& event, const glm::dvec3& across_W, const glm::dvec3& up_W) override;
  std::optional<TrueStylus> seen() override { return stylus_.seen(); }

 private:
  PracticeStylus stylus_;
  PracticeInput hand_;
  DeviceSource device_;  // stops before its device goes
};

class RobotSource final : public StylusSource {
 public:
  /// `hurried`: every call brings 20 ms more; else what the clock says.
  RobotSource(const calibration::SyntheticRig& rig, const TechnicianSettings& habits, bool hurried);
  void takeInto(std::vector<StylusSample>& out, const WizardView& view) override;
  std::optional<TrueStylus> seen() override { return seen_; }

 private:
  calibration::SyntheticRig rig_;
  RobotTechnician robot_;
  bool hurried_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::int64_t ticks_ = 0;
  std::optional<TrueStylus> seen_;
};

}  // namespace app
