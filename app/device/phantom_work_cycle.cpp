#include "app/device/phantom_work_cycle.h"

#include <cmath>
#include <optional>
#include <string>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr double kCheckInterval_s = 0.01;
/// In front of everything on the way; less where the arm does not reach that far.
constexpr double kClear_mm[] = {27.0, 22.0, 18.0, 15.0};

/// Where the handle would have to be, in D, at the first moment that the arm cannot follow.
std::optional<glm::dvec3> firstBeyondReach_mm(const haptics::PhantomMechanics& mechanics,
                                              const haptics::WorkCycle& cycle, const glm::dvec3& tip_H_mm) {
  const haptics::HandScript handle = handleScript(cycle, tip_H_mm);
  for (double t_s = 0.0; t_s < cycle.duration_s(); t_s += kCheckInterval_s) {
    const haptics::HandTarget target = handle(t_s);
    if (!jointsReaching(mechanics.geometry, {target.rotation, target.position_mm})) return target.position_mm;
  }
  return std::nullopt;
}

}  // namespace

haptics::HandScript handleScript(const haptics::WorkCycle& cycle, const glm::dvec3& tip_H_mm) {
  return [cycle, tip_H_mm](double t_s) {
    haptics::HandTarget target = cycle.at(t_s);
    target.position_mm -= target.rotation * tip_H_mm;
    return target;
  };
}

haptics::WorkCycle workCycleFor(const haptics::PhantomMechanics& mechanics, const assets::PlannedCut& cut,
                                const haptics::CuttingMotion& motion, const calibration::Rig& rig,
                                const glm::dvec3& tip_H_mm) {
  const haptics::TroughPath trough(cut, motion, rig.X_WD.inverse() * rig.X_WP);
  const auto rest_DH = mechanics.rest_DH();
  const haptics::HandTarget rest{rest_DH.translation_mm + rest_DH.rotation * tip_H_mm, rest_DH.rotation, false, 0,
                                 true};
  const glm::dvec3 to_viewer_D = glm::conjugate(rig.X_WD.rotation) * glm::dvec3(0.0, 0.0, 1.0);

  // Nothing lies between the site and the viewer: towards the viewer, across, and back; as far as the arm reaches.
  glm::dvec3 beyond_mm{0.0};
  for (const double clear_mm : kClear_mm) {
    const glm::dvec3 above_mm = trough.at(0.0).position_mm + clear_mm * to_viewer_D;
    const double lower_mm = glm::dot(above_mm - rest.position_mm, to_viewer_D);
    haptics::WorkCycle cycle(trough, rest, {rest.position_mm + lower_mm * to_viewer_D, above_mm});
    const auto beyond = firstBeyondReach_mm(mechanics, cycle, tip_H_mm);
    if (!beyond) return cycle;
    beyond_mm = *beyond;
  }
  const auto mm = [&](int axis) { return std::to_string(std::lround(beyond_mm[axis])); };
  throw UsageError("--device, simulated " + std::string(mechanics.name) + ": its arm does not reach (" + mm(0) + ", " +
                   mm(1) + ", " + mm(2) + ") mm of its own frame, on the way to the site: change X_WD of the rig");
}

}  // namespace app
