// `molar feel`: a force law on given poses, no device. CSV of forces out.

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "app/commands/command.h"
#include "app/device/pose_csv.h"
#include "app/options/command_settings.h"
#include "app/options/law_text.h"
#include "app/options/settings_text.h"
#include "app/options/tool_text.h"
#include "app/options/volume_option.h"
#include "app/text/command_line.h"
#include "calibration/output_file.h"
#include "haptics/bone/cubelets.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

using calibration::Patient;
using calibration::Vector;

constexpr double kTick_s = 0.001;

struct FeelOptions {
  VolumeOption volume;
  std::string tool, shaft = "none", law = "agus", poses, out;
  std::vector<std::string> settings;
  bool raw = false, served = false, force = false;
};

struct FeltRow {
  Vector<Patient> force_P_N, torque_P_Nmm;  ///< on the hand; torque about T's origin
  double volume_mm3 = 0.0, depth_mm = 0.0;
};

/// Backward difference; zero at the first row.
Vector<Patient> velocityAt(const std::vector<TimedPose>& poses, std::size_t i) {
  if (i == 0) return {};
  const double dt_s = poses[i].t_s - poses[i - 1].t_s;
  return {(poses[i].X_PT.translation_mm - poses[i - 1].X_PT.translation_mm) / dt_s};
}

/// The law alone; the spindle at its commanded speed while the pedal is down.
std::vector<FeltRow> feelRaw(const SolidVolume& volume, const haptics::Command& command,
                             const std::vector<TimedPose>& poses) {
  const haptics::Cubelets cubelets(volume.grid, volume.solid, volume.label);
  const haptics::SolidField field = cubelets.field();
  std::vector<FeltRow> rows;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector<Patient> velocity = velocityAt(poses, i);
    haptics::ToolInBone at{field, command.tool.head, poses[i].X_PT, command.law.tissue, {}};
    at.motion.velocity_P_mm_per_s = velocity;
    if (poses[i].drill) at.motion.spindle_rad_per_s = haptics::radPerSecond(command.spindle.commanded_rpm);
    const haptics::Contact contact = haptics::contactOf(command.law, at);
    rows.push_back({contact.force_P_N + haptics::dampingForce_N(command.law, contact, velocity), contact.torque_P_Nmm,
                    contact.volume_mm3, contact.depth_mm});
  }
  return rows;
}

/// With proxy and safety, as the servo serves it: from row to row in a straight line, in ticks of at most a
/// millisecond.
std::vector<FeltRow> feelServed(const SolidVolume& volume, const haptics::Command& command,
                                const std::vector<TimedPose>& poses) {
  haptics::Bodies bodies(volume.grid, volume.solid, volume.label);
  haptics::Servo servo(bodies);
  std::vector<FeltRow> rows;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double span_s = i == 0 ? kTick_s : poses[i].t_s - poses[i - 1].t_s;
    const int ticks = static_cast<int>(std::max(1.0, std::ceil(span_s / kTick_s - 1e-6)));
    haptics::Tick tick;
    for (int n = 1; n <= ticks; ++n) {
      haptics::HandSample hand;
      hand.X_PT = poses[i].X_PT;
      hand.velocity_P_mm_per_s = velocityAt(poses, i);
      const double part = static_cast<double>(n) / ticks;
      if (i > 0)
        hand.X_PT = {glm::slerp(poses[i - 1].X_PT.rotation, poses[i].X_PT.rotation, part),
                     glm::mix(poses[i - 1].X_PT.translation_mm, poses[i].X_PT.translation_mm, part)};
      tick = servo.step(hand, command, span_s / ticks);
    }
    rows.push_back({tick.commanded_force_P_N, tick.commanded_torque_P_Nmm, tick.overlap_mm3, tick.depth_mm});
  }
  return rows;
}

int feel(const FeelOptions& options) {
  haptics::Command command;
  command.tool = {headFrom(options.tool), shaftFrom(options.shaft)};
  command.law.kind = lawNamed(options.law);
  applyTo(command, options.settings);
  refuseUnlessAdmitted(command);
  refuseSameFile(options.out, {options.poses, options.volume.path()});
  calibration::OutputFile out(options.out, options.force);
  const std::vector<TimedPose> poses = readPoses(options.poses);
  refuseControls(poses, options.poses);
  if (options.served) {
    refuseBeyondServoLimits(command);
    refuseUnlessStable(command, kUsualDeviceDamping_Ns_per_mm, 1.0 / kTick_s);
    refuseLongRun(poses, options.poses);
  }
  const SolidVolume volume = options.volume.load();
  const auto rows = options.served ? feelServed(volume, command, poses) : feelRaw(volume, command, poses);

  std::string csv = "t_s,fx_N,fy_N,fz_N,tx_Nmm,ty_Nmm,tz_Nmm,volume_mm3,depth_mm\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const glm::dvec3 &F = rows[i].force_P_N.xyz, &M = rows[i].torque_P_Nmm.xyz;
    csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", poses[i].t_s, F.x, F.y, F.z,
                       M.x, M.y, M.z, rows[i].volume_mm3, rows[i].depth_mm);
  }
  out.commit(csv);
  return 0;
}

}  // namespace

void addFeel(CommandLine& molar) {
  auto options = std::make_shared<FeelOptions>();
  CommandLine& command =
      molar.command("feel", "A force law on given poses, no device: CSV of forces, frame P").forEngineers();
  options->volume.addTo(command);
  command.option("--tool", options->tool, headHelp()).required();
  command.option("--shaft", options->shaft, kShaftHelp).showsDefault();
  command.option("--law", options->law, "Force law: " + lawNames()).showsDefault();
  command.option("--set", options->settings, "key=value: stiffness_N_per_mm, damping_Ns_per_mm, …");
  command.option("--poses", options->poses, "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz (X_PT)").required();
  command.option("--out", options->out, "Forces on the hand, CSV").required();
  Option raw = command.flag("--raw", options->raw, "The law alone (default)");
  command.flag("--served", options->served, "With proxy and safety, as the servo serves it").excludes(raw);
  command.flag("--force", options->force, "Replace the output if it exists");
  command.does([options] { return feel(*options); });
}

}  // namespace app
