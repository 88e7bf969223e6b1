#include "haptics/servo/filling_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "haptics/bone/carve.h"
#include "haptics/bone/lay.h"
#include "haptics/bone/stroke_history.h"

namespace haptics {
namespace {

/// A table of this file, as the servo's functions reach no other's.
constexpr auto kTipRadii_mm = [] {
  std::array<double, kHandInstrumentSizes.size()> radii_mm{};
  for (std::size_t n = 0; n < radii_mm.size(); ++n) radii_mm[n] = kHandInstrumentSizes[n].tip_radius_mm;
  return radii_mm;
}();

assets::Tissue materialOf(HandInstrument kind) {
  switch (kind) {
    case HandInstrument::glass_ionomer:
      return assets::Tissue::glass_ionomer_soft;
    case HandInstrument::amalgam:
      return assets::Tissue::amalgam_soft;
    case HandInstrument::wax:
      return assets::Tissue::wax;
    case HandInstrument::gutta_percha:
      return assets::Tissue::gutta_percha;
    default:
      return assets::Tissue::composite_soft;
  }
}

}  // namespace

FillingHand::FillingHand(const Filling* filling) {
  if (filling == nullptr) return;
  const Filling::Begun& begun = filling->begun();
  increment_ = begun.increment;
  material_ = begun.material;
  ended_ = material_ == assets::Tissue::unlabelled;
  age_s_ = begun.age_s;
}

void FillingHand::lay(const LaidCone& cone) noexcept {
  increment_ = std::min(increment_ + 1U, Filling::kMostIncrements);
  material_ = assets::Tissue::gutta_percha;
  ended_ = true;
  age_s_[increment_] = 0.0;
  cone_.begin(cone, increment_);
}

FillingWork FillingHand::work(Bodies& bodies, StrokeHistory& strokes, const Tool& tool,
                              const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, bool pedal,
                              const ErosionSettings& erosion, double dt_s, std::uint64_t tick) noexcept {
  FillingWork done;
  Filling* const filling = bodies.filling();
  if (filling == nullptr) return done;
  for (unsigned n = 1; n <= increment_; ++n) age_s_[n] += dt_s;
  hardening_.step(*filling, age_s_);
  const HandInstrument kind = tool.hand_instrument;
  const bool lays_cone = cone_.isRunning();
  done.works = lays_cone || (pedal && fills(kind));
  // A press is a stroke.
  if (done.works != std::exchange(worked_, done.works)) strokes.endStroke();
  const double step_mm3 = filling->grid().voxelVolume_mm3() / 255.0;
  const double before_mm3 = filling->volume_mm3();
  if (!done.works) {
    due_steps_ = 0.0;
    light_.rest();
  } else if (lays_cone) {
    cone_.step(bodies.jaw().field(), *filling, &strokes);
  } else {
    // An instrument is as thick as it is made, whatever a command says.
    const double radius_mm = kTipRadii_mm[static_cast<std::size_t>(kind)];
    const LaidBall ball{bodies.jaw().field(), *filling, {X_PT.translation_mm}, radius_mm, tick, &strokes};
    if (isApplicator(kind)) {
      const assets::Tissue material = materialOf(kind);
      // What has set is not gone on with, nor is what is about to.
      const Setting setting = settingOf(static_cast<std::uint8_t>(material));
      const bool is_old = setting.by_itself_s > 0.0 && age_s_[increment_] > kMixed_share * setting.by_itself_s;
      ended_ = ended_ || material != material_ || is_old;
      const unsigned increment = std::min(increment_ + (ended_ ? 1U : 0U), Filling::kMostIncrements);
      due_steps_ += kLaying_mm3_per_s * dt_s / step_mm3;
      const auto most = static_cast<std::int64_t>(due_steps_);
      const std::int64_t laid = layBall(ball, material, increment, most);
      // What finds no room is not owed.
      due_steps_ -= static_cast<double>(most);
      if (laid > 0) {
        if (ended_) age_s_[increment] = 0.0;
        increment_ = increment, material_ = material, ended_ = false;
      }
    } else if (kind == HandInstrument::plugger || kind == HandInstrument::root_plugger) {
      // A hot one moves what is ahead, and a part of what is in its way aside.
      const bool ahead = kind == HandInstrument::root_plugger && tick % kAsideOneIn != 0;
      const glm::dvec3 way_P = X_PT.rotation * glm::dvec3(0.0, 0.0, -1.0);
      const double share = kPacking_per_s * dt_s;
      const std::int64_t moved = ahead ? packAhead(ball, way_P, share) : packBall(ball, share);
      done.packed_mm3 = static_cast<double>(moved) * step_mm3;
      const bool sets = filling->volume_mm3(assets::Tissue::composite_soft) > 0.0 ||
                        filling->volume_mm3(assets::Tissue::glass_ionomer_soft) > 0.0;
      ended_ = ended_ || (moved > 0 && !sets);
    } else if (kind == HandInstrument::carver) {
      ErosionStep step;
      for (std::size_t label = assets::kScanTissueCount; label < step.loss.size(); ++label)
        step.loss[label] = std::min(1.0, kCarving_per_s * erosion.tissue_factor[label] * dt_s);
      carveTool(*filling, {ShapeKind::sphere, radius_mm, 0.0}, X_PT, step, tick, 1, &strokes);
    } else {
      const std::int64_t set = light_.shine(bodies.jaw().field(), *filling, X_PT, radius_mm, dt_s, &strokes);
      ended_ = ended_ || set > 0;
    }
  }
  done.changed_mm3 = filling->volume_mm3() - before_mm3;
  done.increment = static_cast<std::uint8_t>(increment_);
  done.total_mm3 = filling->volume_mm3();
  for (const assets::Tissue set : {assets::Tissue::composite, assets::Tissue::glass_ionomer, assets::Tissue::amalgam})
    done.cured_mm3 += filling->volume_mm3(set);
  done.is_full = filling->blocksLeft() == 0;
  return done;
}

}  // namespace haptics
