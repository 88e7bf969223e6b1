// `molar carve`: carving along timed poses, no device. The carved solid fraction as NRRD, removed mm³ as JSON on
// stdout.

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/device/pose_csv.h"
#include "app/options/law_text.h"
#include "app/options/settings_text.h"
#include "app/options/tool_text.h"
#include "app/options/volume_option.h"
#include "app/text/command_line.h"
#include "assets/scan/image_file.h"
#include "calibration/output_file.h"
#include "haptics/bone/carve.h"
#include "haptics/contact/cut_conditions.h"
#include "haptics/contact/law.h"

namespace app {
namespace {

using calibration::Patient;

struct CarveOptions {
  VolumeOption volume;
  std::string tool, erosion = "time", poses, out;
  std::vector<std::string> settings;
  bool force = false;
};

/// Longest step between two poses.
constexpr double kMaxStep_s = 0.001;

/// How the bur cuts.
struct Cut {
  haptics::BurShape head;
  haptics::ErosionSettings erosion;
  haptics::SpindleSettings spindle;
  haptics::LawSettings law;
  double normal_force_N = std::numeric_limits<double>::quiet_NaN();  ///< NaN: as the force law computes
};

/// The spindle's speed under a load, from its commanded speed.
double speedUnder(const haptics::SpindleSettings& spindle, double load_Nmm) {
  const double idle = haptics::steadySpeed_rad_per_s(spindle, 0.0);
  if (idle == 0.0) return 0.0;
  return haptics::radPerSecond(spindle.commanded_rpm) * haptics::steadySpeed_rad_per_s(spindle, load_Nmm) / idle;
}

class Carving {
 public:
  Carving(haptics::CarvedBone& bone, const Cut& cut) : bone_(bone), cut_(cut) {}

  /// In straight lines from row to row, in equal steps of at most a millisecond.
  void along(const std::vector<TimedPose>& poses) {
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
      const double span_s = poses[i + 1].t_s - poses[i].t_s;
      const auto steps = static_cast<std::uint64_t>(std::max(1.0, std::ceil(span_s / kMaxStep_s - 1e-6)));
      if (!poses[i].drill) {
        tick_ += steps;
        memory_ = {};
        continue;
      }
      drilled_s_ += span_s;
      for (std::uint64_t k = 0; k < steps; ++k, ++tick_) {
        const auto at = [&](double n) {
          return between(poses[i].X_PT, poses[i + 1].X_PT, n / static_cast<double>(steps));
        };
        step(at(static_cast<double>(k)), at(static_cast<double>(k) + 0.5), at(static_cast<double>(k) + 1.0),
             span_s / static_cast<double>(steps));
      }
    }
  }

  const haptics::CarveResult& removed() const { return removed_; }
  double drilled_s() const { return drilled_s_; }

 private:
  using PoseOfTool = calibration::Pose<Patient, calibration::Tool>;

  static PoseOfTool between(const PoseOfTool& from, const PoseOfTool& to, double part) {
    return {glm::slerp(from.rotation, to.rotation, part), glm::mix(from.translation_mm, to.translation_mm, part)};
  }

  void step(const PoseOfTool& from, const PoseOfTool& middle, const PoseOfTool& to, double dt_s) {
    const haptics::CutConditions moment = momentAt(middle, to.translation_mm - from.translation_mm, dt_s);
    const haptics::ErosionStep share = haptics::erosionStep(cut_.erosion, moment, memory_);
    haptics::CarveResult removed;
    if (!share.isZero()) removed = haptics::carveSweep(bone_, cut_.head, from, to, share, tick_);
    memory_ = haptics::updatedErosion(cut_.erosion, moment, memory_, removed.removed_mm3_by_label);
    removed_ += removed;
  }

  haptics::CutConditions momentAt(const PoseOfTool& X_PT, const glm::dvec3& way_mm, double dt_s) const {
    const haptics::SolidField field = bone_.field();
    haptics::ToolInBone at{field, cut_.head, X_PT, cut_.law.tissue, {}};
    at.motion.velocity_P_mm_per_s.xyz = way_mm / dt_s;
    at.motion.dt_s = dt_s;
    at.motion.spindle_rad_per_s = speedUnder(cut_.spindle, 0.0);
    // The law `time` needs no contact.
    haptics::Contact contact;
    if (cut_.erosion.kind != haptics::ErosionKind::time) contact = haptics::contactOf(cut_.law, at);
    const double pressing_N =
        std::isnan(cut_.normal_force_N) ? glm::dot(contact.force_P_N.xyz, contact.normal_P.xyz) : cut_.normal_force_N;
    haptics::CutConditions moment = haptics::cutConditions(cut_.erosion, cut_.spindle, at, contact, pressing_N);
    if (cut_.erosion.kind == haptics::ErosionKind::time) return moment;
    moment.spindle_rad_per_s = speedUnder(cut_.spindle, haptics::spindleLoad_Nmm(cut_.erosion, moment, 0.0));
    moment.power_Nmm_per_s = haptics::availablePower_Nmm_per_s(cut_.spindle, moment.spindle_rad_per_s);
    return moment;
  }

  haptics::CarvedBone& bone_;
  const Cut& cut_;
  haptics::ErosionState memory_;
  haptics::CarveResult removed_;
  double drilled_s_ = 0.0;
  std::uint64_t tick_ = 0;
};

int carve(const CarveOptions& options) {
  Cut cut;
  cut.head = headFrom(options.tool);
  cut.erosion.kind = *haptics::erosionOfKey(options.erosion);
  SettingMap settings = parametersOf(cut.erosion);
  settings.merge(parametersOf(cut.spindle));
  if (cut.erosion.kind != haptics::ErosionKind::time)
    settings["normal_force_N"] = {&cut.normal_force_N, 0.0, 100.0, "N"};
  if (cut.erosion.kind == haptics::ErosionKind::machining) cut.normal_force_N = 0.0;
  if (cut.erosion.kind == haptics::ErosionKind::dose)
    settings["stiffness_N_per_mm"] = {&cut.law.agus.stiffness_N_per_mm, 0.0, 100.0, "N/mm"};
  applySettings(options.settings, settings);

  refuseSameFile(options.out, {options.poses, options.volume.path()});
  calibration::OutputFile out = assets::nrrdOutput(options.out, options.force);
  const std::vector<TimedPose> poses = readPoses(options.poses);
  refuseControls(poses, options.poses);
  refuseLongRun(poses, options.poses);
  const SolidVolume volume = options.volume.load();
  haptics::CarvedBone bone(volume.grid, volume.solid, volume.label, haptics::BlockStorage::dense);
  Carving carving(bone, cut);
  carving.along(poses);
  const haptics::CarveResult& removed = carving.removed();
  assets::writeSolid(volume.grid, bone.solidInGridOrder(), out);

  nlohmann::json by_label = nlohmann::json::object();
  for (std::size_t l = 0; l < removed.removed_mm3_by_label.size(); ++l)
    if (removed.removed_mm3_by_label[l] > 0.0) by_label[std::to_string(l)] = removed.removed_mm3_by_label[l];
  const double mean_mm3_per_s = carving.drilled_s() > 0.0 ? removed.removed_mm3 / carving.drilled_s() : 0.0;
  std::printf("%s\n", nlohmann::json{{"erosion", options.erosion},
                                     {"removed_mm3", removed.removed_mm3},
                                     {"removed_mm3_by_label", by_label},
                                     {"mm3_per_s", mean_mm3_per_s}}
                          .dump(2)
                          .c_str());
  return 0;
}

}  // namespace

void addCarve(CommandLine& molar) {
  auto options = std::make_shared<CarveOptions>();
  CommandLine& command =
      molar.command("carve", "Carving along timed poses: carved NRRD, removed mm³ as JSON").forEngineers();
  options->volume.addTo(command);
  command.option("--tool", options->tool, headHelp()).required();
  command.option("--erosion", options->erosion, "Erosion law").oneOf(erosionNames()).showsDefault();
  command.option("--set", options->settings, "key=value, see below");
  command.option("--poses", options->poses, "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz[,drill] (X_PT)").required();
  command.option("--out", options->out, "Remaining solid fraction, .nrrd").required();
  command.flag("--force", options->force, "Replace the output if it exists");
  command.footer(
      erosionHelp() +
      "  dose and machining, in addition, the pressing force:\n"
      "    normal_force_N (N): drives dose; loads the spindle\n"
      "    stiffness_N_per_mm (N/mm): dose without normal_force_N uses k h of the law agus at each pose\n"
      "The spindle runs at spindle_rpm while the pedal is down, slower under load; machining takes its feed from the "
      "poses.");
  command.does([options] { return carve(*options); });
}

}  // namespace app
