#include "app/station/case_reach.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/device/pose_source.h"
#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

using calibration::Device;
using calibration::Handle;
using calibration::Patient;
using calibration::Point;
using calibration::Pose;
using calibration::World;

constexpr glm::dvec3 kRegionHalf_P_mm{30.0, 25.0, 20.0};
constexpr double kFarOffScreen_mm = 40.0, kTrackedEye_mm = 2.0;
constexpr double kMargin_mm = 5.0, kMaxGimbal_rad = calibration::radFromDegrees(60.0);
constexpr double kStep_mm = 5.0, kTurnStep_deg = 10.0;
constexpr int kSteps = 3, kTurnSteps = 2;

std::array<glm::dvec3, 8> corners_P_mm(const assets::Patient& patient) {
  const assets::VolumeGrid& grid = patient.ct.grid;
  const glm::dvec3 site = patient.focus_P_mm();
  const glm::dvec3 least = glm::max(site - kRegionHalf_P_mm, grid.origin_P_mm);
  const glm::dvec3 most =
      glm::min(site + kRegionHalf_P_mm, grid.origin_P_mm + grid.spacing_mm * glm::dvec3(grid.size - 1));
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {i & 1 ? most.x : least.x, i & 2 ? most.y : least.y, i & 4 ? most.z : least.z};
  return corners;
}

struct Arm {
  calibration::PhantomGeometry geometry;
  Pose<World, Device> X_WD;
  glm::dvec3 tip_H_mm;
};

/// The tool at this position, held as at work, with a margin on every side.
bool isReached(const Arm& arm, const glm::dvec3& tip_W_mm) {
  const Pose<Device, World> X_DW = arm.X_WD.inverse();
  const glm::dquat R_WH = restingTool().rotation;
  constexpr glm::dvec3 kSides[] = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  return std::ranges::all_of(kSides, [&](const glm::dvec3& side) {
    const Pose<World, Handle> X_WH{R_WH, tip_W_mm + kMargin_mm * side - R_WH * arm.tip_H_mm};
    const auto joints = calibration::jointsReaching(arm.geometry, X_DW * X_WH);
    return joints && std::abs(joints->wrist_rad.x) <= kMaxGimbal_rad && std::abs(joints->wrist_rad.y) <= kMaxGimbal_rad;
  });
}

int cornersOut(const Arm& arm, const std::array<glm::dvec3, 8>& corners_W_mm) {
  return static_cast<int>(
      std::ranges::count_if(corners_W_mm, [&](const glm::dvec3& corner) { return !isReached(arm, corner); }));
}

std::string shiftText(const Reach::Shift& shift) {
  std::string words;
  const auto add = [&](double mm, const char* positive, const char* negative) {
    if (mm != 0.0)
      words += (words.empty() ? "" : ", ") + fmt::format("{:.0f} mm {}", std::abs(mm), mm > 0.0 ? positive : negative);
  };
  add(shift.by_W_mm.x, "right", "left"), add(shift.by_W_mm.y, "up", "down"), add(shift.by_W_mm.z, "nearer", "back");
  if (shift.turn_deg != 0.0)
    words += (words.empty() ? "" : ", ") + fmt::format("turned by {:.0f} degrees about the vertical", shift.turn_deg);
  return words;
}

}  // namespace

double farthestOffScreen_mm(const calibration::Rig& rig, const assets::Patient& patient) {
  double farthest = 0.0;
  for (const glm::dvec3& corner_P_mm : corners_P_mm(patient))
    farthest = std::max(farthest, std::abs((rig.X_WP * Point<Patient>{corner_P_mm}).mm.z));
  return farthest;
}

Reach reachOf(const calibration::Rig& rig, const assets::Patient& patient, const calibration::PhantomGeometry& model) {
  const Arm arm{model, rig.X_WD, rig.arm ? rig.arm->tip_H_mm : calibration::kNominalTip_H_mm};
  const glm::dvec3 site_W_mm = (rig.X_WP * Point<Patient>{patient.focus_P_mm()}).mm;
  std::array<glm::dvec3, 8> corners_W_mm;
  std::ranges::transform(corners_P_mm(patient), corners_W_mm.begin(),
                         [&](const glm::dvec3& corner) { return (rig.X_WP * Point<Patient>{corner}).mm; });
  Reach reach;
  reach.corners_out = cornersOut(arm, corners_W_mm);
  if (reach.corners_out == 0) return reach;

  // The smallest change first; a degree counts as a millimetre.
  std::vector<Reach::Shift> tries;
  for (int turn = -kTurnSteps; turn <= kTurnSteps; ++turn)
    for (int x = -kSteps; x <= kSteps; ++x)
      for (int y = -kSteps; y <= kSteps; ++y)
        for (int z = -kSteps; z <= kSteps; ++z) tries.push_back({kStep_mm * glm::dvec3(x, y, z), kTurnStep_deg * turn});
  const auto size = [](const Reach::Shift& s) { return glm::length(glm::dvec4(s.by_W_mm, s.turn_deg)); };
  std::ranges::stable_sort(tries, {}, size);
  for (const Reach::Shift& shift : tries) {
    const glm::dquat turn = glm::angleAxis(calibration::radFromDegrees(shift.turn_deg), glm::dvec3(0.0, 1.0, 0.0));
    auto moved = corners_W_mm;
    for (glm::dvec3& corner : moved) corner = site_W_mm + shift.by_W_mm + turn * (corner - site_W_mm);
    if (cornersOut(arm, moved) > 0) continue;
    reach.suggestion = shift;
    break;
  }
  return reach;
}

std::vector<std::string> caseRemarks(const calibration::Rig& rig, const assets::Patient& patient, double eye_sd_mm,
                                     const std::string& arm_model) {
  std::vector<std::string> remarks;
  if (!patient.site) return remarks;
  const double off_mm = farthestOffScreen_mm(rig, patient);
  if (off_mm > kFarOffScreen_mm && eye_sd_mm > kTrackedEye_mm) {
    const double eye_mm = std::max(1.0, std::abs(rig.cyclopeanEye().mm.z));
    remarks.push_back(
        fmt::format("case: it reaches {:.0f} mm from the virtual screen, where a head that is not tracked and "
                    "moves {:.0f} mm sees it {:.1f} mm off: stand the tooth nearer the screen (X_WP)",
                    off_mm, eye_sd_mm, eye_sd_mm * off_mm / eye_mm));
  }
  const calibration::PhantomModel* const model = calibration::findPhantomModel(arm_model);
  if (model == nullptr) return remarks;
  const Reach reach = reachOf(rig, patient, model->geometry);
  if (reach.corners_out > 0)
    remarks.push_back(
        fmt::format(
            "case: {} of 8 corners of the region about the tooth are beyond the arm's reach or nearer than {:.0f} mm "
            "to its limits: ",
            reach.corners_out, kMargin_mm) +
        (reach.suggestion ? "stand the patient " + shiftText(*reach.suggestion) + " (X_WP)"
                          : "no shift of 15 mm or turn of 20 degrees helps, move the device's base"));
  return remarks;
}

}  // namespace app
