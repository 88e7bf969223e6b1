#include "tests/bench/calibration/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calibration/fit/arm_fit.h"
#include "calibration/fit/rezero.h"
#include "calibration/random.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/webcam_fit.h"
#include "tests/bench/cpu_time.h"
#include "tests/calibration/synthetic/seen_error.h"
#include "tests/calibration/synthetic/synthetic_observations.h"

namespace bench {
namespace {

using namespace calibration;

constexpr int kJudges = 400;
constexpr glm::dvec3 kRegion_mm{70.0, 50.0, 35.0}, kNearScreen_mm{70.0, 50.0, 30.0};
constexpr glm::dvec3 kSeenBox_mm{65.0, 45.0, 30.0};
constexpr double kSolve_ms = 1000.0;

/// A number a rig.
class OverRigs {
 public:
  void add(double value) { values_.push_back(value); }
  double at(double share) const {
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
  }
  double median() const { return at(0.5); }
  double p95() const { return at(0.95); }
  double worst() const { return at(1.0); }
  double least() const { return at(0.0); }
  double mean() const {
    double sum = 0.0;
    for (const double value : values_) sum += value;
    return sum / static_cast<double>(values_.size());
  }

 private:
  std::vector<double> values_;
};

std::string text(const char* format, double a, double b = 0.0, double c = 0.0) {
  char line[120];
  std::snprintf(line, sizeof line, format, a, b, c);
  return line;
}

Figure atMost(std::string what, const char* unit, double limit, double measured) {
  return {std::move(what), text("<= %.2f ", limit) + unit, text("%.3f ", measured) + unit, measured <= limit};
}
Figure told(std::string what, std::string measured) { return {std::move(what), "", std::move(measured), true, true}; }

Figure all(std::string what, int found, int of) {
  return {std::move(what), std::to_string(of) + " of " + std::to_string(of),
          std::to_string(found) + " of " + std::to_string(of), found == of};
}
Figure none(std::string what, int found, int of) {
  return {std::move(what), "0 of " + std::to_string(of), std::to_string(found) + " of " + std::to_string(of),
          found == 0};
}

/// Each use of a rig has its own luck, the same whatever else is measured.
std::mt19937 rngOf(std::uint32_t seed, std::uint32_t use) {
  std::mt19937 rng(seed * 1009u + use);
  rng.discard(1000);
  return rng;
}

TouchSet touches(const SyntheticRig& rig, const char* method, std::uint32_t use) {
  std::mt19937 rng = rngOf(rig.seed, use);
  return simulatedTouches(rig, targetPlan(method).value(), rng);
}

double tre_mm(const MeasuredArm& arm, const SyntheticRig& rig, const glm::dvec3& half_mm = kRegion_mm) {
  std::mt19937 rng = rngOf(rig.seed, 77);
  double sum = 0.0;
  for (const Touch& touch : heldOutTouches(rig, kJudges, half_mm, rng))
    sum += std::pow(glm::length((arm.tip_W(touch.joints_rad) - touch.target_W).xyz), 2);
  return std::sqrt(sum / kJudges);
}

bool warned(const ArmFit& fit, FitWarning::Kind kind) {
  return std::any_of(fit.warnings.begin(), fit.warnings.end(), [&](const FitWarning& w) { return w.kind == kind; });
}

template <class Rigs>
void forRigs(Scenario scenario, int rigs, Rigs work) {
  for (int n = 1; n <= rigs; ++n) work(syntheticRig(scenario, static_cast<std::uint32_t>(n)));
}

/// A display that shows it mirrored, left to right or upside down.
TouchSet flipped(TouchSet set, int axis) {
  for (Touch& touch : set.touches) touch.target_W.mm[axis] = -touch.target_W.mm[axis];
  return set;
}

/// Refused or warned of.
bool foundFlipped(const TouchSet& set) {
  try {
    return warned(fitArm(set), FitWarning::Kind::mirrored);
  } catch (const CalibrationError&) {
    return true;
  }
}

}  // namespace

Figures jigFigures(int rigs) {
  OverRigs full, joints, rigid, eight, took_ms, chosen_full;
  forRigs(Scenario::d, rigs, [&](const SyntheticRig& rig) {
    const TouchSet set = touches(rig, "jig27", 1);
    const double began_ms = cpu_ms();
    const ArmFit fit = fitArm(set);
    took_ms.add(cpu_ms() - began_ms);
    chosen_full.add(fit.model == ArmModel::full ? 1.0 : 0.0);
    full.add(tre_mm(fit.arm, rig));
    joints.add(tre_mm(fitArm(set, {.model = ArmModel::joint_gains}).arm, rig));
    rigid.add(tre_mm(fitArm(set, {.model = ArmModel::rigid}).arm, rig));
    eight.add(tre_mm(fitArm(touches(rig, "jig8", 2)).arm, rig));
  });
  const double better = rigid.median() / full.median();
  return {atMost("jig, 27 touches: TRE, median of rigs", "mm", 0.26, full.median()),
          atMost("jig, 27 touches: TRE, worst rig", "mm", 0.35, full.worst()),
          atMost("jig, 8 touches: TRE, median", "mm", 0.40, eight.median()),
          {"full model against rigid, medians", ">= 2.00 times", text("%.2f times", better), better >= 2.0},
          atMost("fit with its choice of model: CPU, worst", "ms", kSolve_ms, took_ms.worst()),
          told("   rigid, joints: TRE, median", text("%.3f, %.3f mm", rigid.median(), joints.median())),
          told("   8 touches: TRE, worst rig", text("%.3f mm", eight.worst())),
          told("   the full model was chosen", text("%.0f %% of rigs", 100.0 * chosen_full.mean()))};
}

Figures crossValidationFigures(int rigs) {
  Figures figures;
  for (const Scenario scenario : {Scenario::a, Scenario::b, Scenario::c, Scenario::d}) {
    OverRigs ratio;
    forRigs(scenario, rigs, [&](const SyntheticRig& rig) {
      const ArmFit fit = fitArm(touches(rig, "jig27", 1));
      ratio.add(fit.cv_rms_mm / tre_mm(fit.arm, rig));
    });
    const std::string name = std::string("cross-validated / true, scenario ") + static_cast<char>(scenario);
    const double middle = ratio.median();
    figures.push_back({name + ", median", "0.90 to 1.40", text("%.2f", middle), middle >= 0.9 && middle <= 1.4});
    figures.push_back(told("   5 to 95 of 100 rigs", text("%.2f to %.2f", ratio.at(0.05), ratio.p95())));
  }
  return figures;
}

Figures outlierFigures(int rigs) {
  OverRigs change, without;
  int named = 0;
  forRigs(Scenario::d, rigs, [&](SyntheticRig rig) {
    rig.technician.outlier_share = 0.0;
    const TouchSet clean = touches(rig, "jig27", 1);
    TouchSet slipped = clean, left_out = clean;
    std::mt19937 rng = rngOf(rig.seed, 3);
    const std::size_t which = rng() % clean.touches.size();
    slipped.touches[which].target_W.mm += 15.0 * glm::normalize(gaussianVector(rng, 1.0));
    left_out.touches[which].used = false;
    const double clean_mm = tre_mm(fitArm(clean).arm, rig);
    const ArmFit fit = fitArm(slipped);
    named += fit.outliers == 1 && !fit.residuals[which].used ? 1 : 0;
    change.add(std::abs(tre_mm(fit.arm, rig) - clean_mm));
    without.add(std::abs(tre_mm(fitArm(left_out).arm, rig) - clean_mm));
  });
  return {atMost("one of 27 touches off by 15 mm: change of TRE, worst rig", "mm", 0.05, change.worst()),
          all("   it alone is named", named, rigs),
          told("   change, median; by leaving that touch out, worst",
               text("%.3f mm; %.3f mm", change.median(), without.worst()))};
}

Figures visualFigures(int rigs) {
  OverRigs full, rigid, fifteen;
  forRigs(Scenario::f, rigs, [&](const SyntheticRig& rig) {
    const TouchSet set = touches(rig, "visual25", 1);
    full.add(tre_mm(fitArm(set).arm, rig, kNearScreen_mm));
    rigid.add(tre_mm(fitArm(set, {.model = ArmModel::rigid}).arm, rig, kNearScreen_mm));
    fifteen.add(tre_mm(fitArm(touches(rig, "visual15", 2)).arm, rig, kNearScreen_mm));
  });
  return {atMost("25 crosses by eye: TRE, median", "mm", 0.60, full.median()),
          told("   worst rig; rigid, median", text("%.3f mm; %.3f mm", full.worst(), rigid.median())),
          told("   15 crosses: TRE, median", text("%.3f mm", fifteen.median()))};
}

Figures rezeroFigures(int rigs) {
  OverRigs drift, back, took_ms;
  forRigs(Scenario::d, rigs, [&](const SyntheticRig& rig) {
    const MeasuredArm arm = fitArm(touches(rig, "jig27", 1)).arm;
    std::mt19937 rng = rngOf(rig.seed, 4);
    const SyntheticRig now = drifted(rig, 0.3, 1.0, rng);
    drift.add(tre_mm(arm, now));
    const TouchSet five = touches(now, "rezero5", 5);
    const double began_ms = cpu_ms();
    const Rezero result = rezeroed(arm, five);
    took_ms.add(cpu_ms() - began_ms);
    back.add(tre_mm(result.arm, now));
  });
  return {atMost("re-zero, 5 touches, after 0.3 degrees + 1 mm: TRE, 95 of 100", "mm", 0.35, back.p95()),
          atMost("re-zero: CPU, worst", "ms", kSolve_ms, took_ms.worst()),
          told("   TRE before it, after it, medians", text("%.3f, %.3f mm", drift.median(), back.median())),
          told("   after it, worst rig", text("%.3f mm", back.worst()))};
}

Figures guardFigures(int rigs) {
  int flipped_jig = 0, flipped_crosses = 0, upright_jig = 0, upright_crosses = 0, one_tilt = 0, many_tilts = 0;
  forRigs(Scenario::d, rigs, [&](const SyntheticRig& rig) {
    const TouchSet set = touches(rig, "jig27", 1);
    flipped_jig += foundFlipped(flipped(set, 0)) && foundFlipped(flipped(set, 1)) ? 1 : 0;
    upright_jig += foundFlipped(set) ? 1 : 0;
    many_tilts += warned(fitArm(set), FitWarning::Kind::little_tilt) ? 1 : 0;
  });
  forRigs(Scenario::f, rigs, [&](const SyntheticRig& rig) {
    const TouchSet set = touches(rig, "visual25", 1);
    flipped_crosses += foundFlipped(flipped(set, 0)) && foundFlipped(flipped(set, 1)) ? 1 : 0;
    upright_crosses += foundFlipped(set) ? 1 : 0;
  });
  forRigs(Scenario::e, rigs, [&](const SyntheticRig& rig) {
    const ArmFit fit = fitArm(touches(rig, "jig27", 1));
    one_tilt += warned(fit, FitWarning::Kind::little_tilt) ? 1 : 0;
  });
  return {all("display flipped left to right, upside down, jig: both found", flipped_jig, rigs),
          all("display flipped left to right, upside down, crosses: both found", flipped_crosses, rigs),
          none("   display not flipped, jig: found all the same", upright_jig, rigs),
          none("   display not flipped, crosses: found all the same", upright_crosses, rigs),
          all("stylus held one way: found", one_tilt, rigs),
          none("   stylus held in many ways: found all the same", many_tilts, rigs)};
}

Figures seenFigures(int rigs) {
  OverRigs mean, most, loose_most, rms2;
  forRigs(Scenario::d, rigs, [&](const SyntheticRig& rig) {
    const MeasuredArm arm = fitArm(touches(rig, "jig27", 1)).arm;
    std::mt19937 rng = rngOf(rig.seed, 6), again = rng;
    const SeenError seen = seenError(rig, arm, kSeenBox_mm, {}, kJudges, rng);
    mean.add(seen.mean_mm);
    most.add(seen.max_mm);
    rms2.add(seen.rms_mm * seen.rms_mm);
    loose_most.add(seenError(rig, arm, kSeenBox_mm, {.head_sd_mm = 15.0}, kJudges, again).mean_mm);
  });
  return {atMost("seen, arm + screen + eyes at a chin rest, 130 x 90 x 60 mm: mean", "mm", 0.80, mean.mean()),
          atMost("seen: worst place of the worst rig and seating", "mm", 2.00, most.worst()),
          told("   RMS; worst place of a rig, median", text("%.3f mm; %.3f mm", std::sqrt(rms2.mean()), most.median())),
          told("   without a chin rest: mean", text("%.3f mm", loose_most.mean()))};
}

Figures webcamFigures(int rigs) {
  Figures figures;
  struct Resolution {
    const char* name;
    WebcamCare care;
    double limit_mm;
  };
  for (const Resolution& resolution :
       {Resolution{"1080p, 0.5 px", fineWebcam(), 0.35}, {"720p, 1 px", coarseWebcam(), 0.5}}) {
    OverRigs tre, single, ratio, took_ms;
    forRigs(Scenario::d, rigs, [&](const SyntheticRig& rig) {
      std::mt19937 rng = rngOf(rig.seed, 8);
      const WebcamObservations sights =
          syntheticObservations(rig, targetPlan("webcam27").value(), resolution.care, rng);
      const double began_ms = cpu_ms();
      const WebcamFit fit = fitWebcam(sights);
      took_ms.add(cpu_ms() - began_ms);
      tre.add(tre_mm(fit.arm, rig, kNearScreen_mm));
      ratio.add(fit.cv_rms_mm / tre_mm(fit.arm, rig, kNearScreen_mm));
      single.add(tre_mm(armFromOnePosition(sights, 0), rig, kNearScreen_mm));
    });
    const std::string name = std::string("webcam ") + resolution.name;
    figures.push_back(atMost(name + ", 3 positions x 27: TRE, median", "mm", resolution.limit_mm, tre.median()));
    figures.push_back(atMost(name + ": CPU of the fit, worst", "ms", kSolve_ms, took_ms.worst()));
    figures.push_back(
        told("   worst rig; one position alone, median", text("%.3f mm; %.3f mm", tre.worst(), single.median())));
    figures.push_back(told("   cross-validated / true, median", text("%.2f", ratio.median())));
  }
  return figures;
}

}  // namespace bench
