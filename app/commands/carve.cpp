// `molar carve`: carving along timed poses, no device. The carved solid fraction as NRRD, removed mm³ as JSON on
// stdout.

#include <cmath>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/pose_csv.h"
#include "app/settings_text.h"
#include "app/tool_text.h"
#include "app/volume_option.h"
#include "assets/image_file.h"
#include "haptics/bone/carve.h"

namespace app {
namespace {

using calibration::Patient;

struct CarveOptions {
  VolumeOption volume;
  std::string tool, erosion = "time", poses, out;
  std::vector<std::string> settings;
  bool force = false;
};

/// Poses further apart in time are carved through in steps of this.
constexpr double kLongestStep_s = 0.001;

/// Carves from each row to the next, straight, in equal steps of at most a millisecond.
haptics::CarveResult carveAlong(haptics::CarvedBone& bone, const std::vector<TimedPose>& poses,
                                const haptics::BurShape& head, const haptics::ErosionParameters& erosion) {
  haptics::CarveResult removed;
  std::uint64_t tick = 0;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const double span_s = poses[i + 1].t_s - poses[i].t_s;
    const auto steps = static_cast<std::uint64_t>(std::max(1.0, std::ceil(span_s / kLongestStep_s - 1e-6)));
    const auto &from = poses[i].X_PT, &to = poses[i + 1].X_PT;
    if (!poses[i].drill) {
      tick += steps;
      continue;
    }
    const double dt_s = span_s / static_cast<double>(steps);
    for (std::uint64_t k = 0; k < steps; ++k, ++tick) {
      const auto at = [&](double n) {
        const double part = n / static_cast<double>(steps);
        return calibration::Pose<Patient, calibration::Tool>{glm::slerp(from.rotation, to.rotation, part),
                                                             glm::mix(from.translation_mm, to.translation_mm, part)};
      };
      removed += haptics::carveSweep(bone, head, at(static_cast<double>(k)), at(static_cast<double>(k) + 1.0),
                                     haptics::timeErosion(erosion, dt_s), tick);
    }
  }
  return removed;
}

int carve(const CarveOptions& options) {
  const haptics::BurShape head = headFrom(options.tool);
  haptics::ErosionParameters erosion;
  std::map<std::string, Setting> settings{{"removal_rate_per_s", {&erosion.removal_rate_per_s, 0.0, 1000.0, "1/s"}}};
  for (std::size_t l = 0; l < assets::kTissues.size(); ++l)
    settings["factor_" + std::string(assets::kTissues[l].key)] = {&erosion.tissue_factor[l], 0.0, 1000.0, ""};
  applySettings(options.settings, settings);

  refuseSameFile(options.out, {options.poses, options.volume.path()});
  assets::OutputFile out = assets::nrrdOutput(options.out, options.force);
  const std::vector<TimedPose> poses = readPoses(options.poses);
  refuseLongRun(poses, options.poses);
  const SolidVolume volume = options.volume.load();
  haptics::CarvedBone bone(volume.grid, volume.solid, volume.label);
  const haptics::CarveResult removed = carveAlong(bone, poses, head, erosion);
  assets::writeSolid(volume.grid, bone.solidInGridOrder(), out);

  nlohmann::json by_label = nlohmann::json::object();
  for (std::size_t l = 0; l < removed.removed_mm3_by_label.size(); ++l)
    if (removed.removed_mm3_by_label[l] > 0.0) by_label[std::to_string(l)] = removed.removed_mm3_by_label[l];
  std::printf("%s\n",
              nlohmann::json{{"removed_mm3", removed.removed_mm3}, {"removed_mm3_by_label", by_label}}.dump(2).c_str());
  return 0;
}

}  // namespace

void addCarve(CLI::App& molar, Chosen& chosen) {
  auto options = std::make_shared<CarveOptions>();
  CLI::App* command = molar.add_subcommand("carve", "Carving along timed poses: carved NRRD, removed mm³ as JSON");
  options->volume.addTo(*command);
  command->add_option("--tool", options->tool, kHeadHelp)->required();
  command->add_option("--erosion", options->erosion, "Erosion law")
      ->check(CLI::IsMember({"time"}))
      ->capture_default_str();
  command->add_option("--set", options->settings, "key=value: removal_rate_per_s, factor_enamel, factor_cortical, …");
  command->add_option("--poses", options->poses, "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz[,drill] (X_PT)")->required();
  command->add_option("--out", options->out, "Solid fraction that is left, .nrrd")->required();
  command->add_flag("--force", options->force, "Replace the output if it exists");
  command->callback([options, &chosen] { chosen.action = [options] { return carve(*options); }; });
}

}  // namespace app
