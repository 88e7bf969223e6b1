#include "calibration/webcam/webcam_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "calibration/arm/phantom_models.h"
#include "calibration/fit/fit_warnings.h"
#include "calibration/fit/touch_checks.h"
#include "calibration/webcam/webcam_bundle.h"
#include "calibration/webcam/webcam_start.h"

namespace calibration {
namespace {

constexpr std::size_t kMinPositions = 2, kMinTips = 16, kMinTipsAtOne = 4, kMinPlaces = 6;
constexpr double kMinBase_deg = 5.0, kNarrowBase_deg = 20.0;
constexpr std::size_t kFewTips = 40;
constexpr double kRigidMismatch_mm = 0.9, kMinMismatch_mm = 0.02, kMaxMismatch_mm = 3.0;
constexpr double kWild = 4.5;  ///< sigmas of both axes together
constexpr int kRounds = 4;
constexpr std::size_t kFolds = 5;
constexpr double kMinPredictedShare = 0.3;  ///< lower bound after noise subtraction, relative to the squares

[[noreturn]] void refuseWebcam(const std::string& what, const std::string& mend) {
  throw CalibrationError("webcam: " + what + ", " + mend);
}

void checkPosition(const WebcamObservations& observations, std::size_t c) {
  const std::string where = "camera position " + std::to_string(c + 1);
  const CameraPosition& position = observations.positions[c];
  if (position.screen.size() < kMinPlaces)
    refuseWebcam(where + " sees too little of the screen", "show the board again");
  if (position.tips.size() < kMinTipsAtOne)
    refuseWebcam(where + " has only " + std::to_string(position.tips.size()) + " tips",
                 "touch at least 4 positions from there");
  for (const ScreenObservation& observation : position.screen)
    if (!isFinite(observation.camera_px) || !isFinite(glm::dvec2(observation.position_W.mm)) ||
        observation.position_W.mm.z != 0.0)
      refuseWebcam(where + " has a screen point that is not finite or not on the screen", "take its images again");
  for (const TipObservation& observation : position.tips)
    if (!isFinite(observation.camera_px) ||
        !std::ranges::all_of(observation.joints_rad, [](double a) { return std::abs(a) < 13.0; }))
      refuseWebcam(where + ", touch " + std::to_string(observation.id) + ": a number that is not finite",
                   "leave it out");
}

void checkObservations(const WebcamObservations& observations) {
  if (findPhantomModel(observations.device_model) == nullptr)
    refuseWebcam("the device model '" + observations.device_model + "' is not known",
                 "give one of " + phantomModelKeys());
  for (std::size_t c = 0; c < observations.positions.size(); ++c) checkPosition(observations, c);
}

std::size_t tipsOf(const WebcamObservations& observations) {
  std::size_t count = 0;
  for (const CameraPosition& position : observations.positions) count += position.tips.size();
  return count;
}

template <class Use>
void eachTip(const WebcamObservations& observations, Use&& use) {
  for (std::size_t c = 0; c < observations.positions.size(); ++c)
    for (std::size_t i = 0; i < observations.positions[c].tips.size(); ++i)
      use(c, i, observations.positions[c].tips[i]);
}

/// Reprojection error of a tip.
struct TipError {
  Point<World> tip_W;
  glm::dvec2 off_px{0.0};
  double mm_per_px = 0.0;  ///< at its distance
};
TipError tipError(const WebcamBundle& bundle, const MeasuredArm& arm, std::size_t c,
                  const TipObservation& observation) {
  TipError error{arm.tip_W(observation.joints_rad)};
  const Point<Camera> p_C = bundle.X_CW[c] * error.tip_W;
  error.off_px = bundle.camera.pixelOf(p_C) - observation.camera_px;
  error.mm_per_px = p_C.mm.z / bundle.camera.focal_px.x;
  return error;
}

/// The best single-position start, evaluated on all positions.
WebcamBundle firstGuess(const WebcamObservations& observations) {
  WebcamBundle guess;
  guess.camera = observations.camera;
  guess.start.geometry = findPhantomModel(observations.device_model)->geometry;
  for (std::size_t c = 0; c < observations.positions.size(); ++c) {
    guess.X_CW.push_back(cameraSeeing(observations, c));
    guess.tip_used.emplace_back(observations.positions[c].tips.size(), true);
  }
  double least = 1e300;
  for (std::size_t c = 0; c < observations.positions.size(); ++c) {
    const MeasuredArm arm{guess.start.geometry, {}, deviceSeen(observations, c, guess.X_CW[c])};
    double sum = 0.0;
    eachTip(observations, [&](std::size_t at, std::size_t, const TipObservation& observation) {
      const TipError error = tipError(guess, arm, at, observation);
      sum += std::min(100.0, error.mm_per_px * error.mm_per_px * glm::dot(error.off_px, error.off_px));
    });
    if (sum < least) least = sum, guess.start.X_WD = arm.X_WD;
  }

  // Rotate the pose parameters about the centre of the tips.
  const MeasuredArm arm{guess.start.geometry, {}, guess.start.X_WD};
  glm::dvec3 sum{0.0};
  eachTip(observations, [&](std::size_t, std::size_t, const TipObservation& observation) {
    sum += arm.tip_W(observation.joints_rad).mm;
  });
  guess.start.middle_W = {sum / double(tipsOf(observations))};
  return guess;
}

/// The widest angle between two camera positions.
double widestBaseline_deg(const WebcamBundle& bundle) {
  double widest = 0.0;
  for (const auto& one : bundle.X_CW)
    for (const auto& other : bundle.X_CW) {
      const glm::dvec3 a = glm::normalize(one.inverse().translation_mm - bundle.start.middle_W.mm);
      const glm::dvec3 b = glm::normalize(other.inverse().translation_mm - bundle.start.middle_W.mm);
      widest = std::max(widest, degreesFromRad(std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0))));
    }
  return widest;
}

/// Rejects outlier tips and estimates the model error of the others beyond their image noise.
void classifyTips(const WebcamObservations& observations, WebcamBundle& bundle) {
  const MeasuredArm arm = bundle.arm();
  double squares_mm2 = 0.0, noise_mm2 = 0.0, count = 0.0;
  eachTip(observations, [&](std::size_t c, std::size_t i, const TipObservation& observation) {
    const TipError error = tipError(bundle, arm, c, observation);
    bundle.tip_used[c][i] = glm::length(error.off_px) < kWild * tipSigma_px(observations, bundle, c, error.tip_W);
    if (!bundle.tip_used[c][i]) return;
    squares_mm2 += error.mm_per_px * error.mm_per_px * glm::dot(error.off_px, error.off_px);
    noise_mm2 += std::pow(observations.tip_noise_px * error.mm_per_px, 2);
    count += 1.0;
  });
  const double free = std::max(0.5 * count, 2.0 * count - bundle.effective_arm_parameters);
  const double left_mm2 = squares_mm2 / std::max(1.0, free) - noise_mm2 / std::max(1.0, count);
  bundle.mismatch_mm = std::clamp(std::sqrt(std::max(0.0, left_mm2)), kMinMismatch_mm, kMaxMismatch_mm);
}

WebcamBundle fitted(const WebcamObservations& observations, WebcamBundle bundle, ArmModel model) {
  // Pose only, then all parameters, alternating with outliers and mismatch.
  bundle.fitted = parametersOf(ArmModel::rigid);
  bundle.mismatch_mm = kRigidMismatch_mm;
  bundle = adjusted(observations, bundle);
  bundle.fitted = parametersOf(model);
  for (int round = 0; round < kRounds; ++round) {
    bundle = adjusted(observations, bundle);
    const auto was_used = bundle.tip_used;
    const double was_mm = bundle.mismatch_mm;
    classifyTips(observations, bundle);
    if (bundle.tip_used == was_used && std::abs(bundle.mismatch_mm - was_mm) < 0.03 * was_mm) break;
  }
  return bundle;
}

/// Two of three axes are observed: scale to an error in space.
double upToThreeAxes(double squares_mm2, double count) { return std::sqrt(1.5 * squares_mm2 / std::max(1.0, count)); }

/// 5-fold, less the image noise of the tips left out, which is not the arm's.
double crossValidated_mm(const WebcamObservations& observations, const WebcamBundle& bundle) {
  double squares_mm2 = 0.0, noise_mm2 = 0.0, count = 0.0;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    WebcamBundle without = bundle;
    const auto is_out = [&](std::size_t c, std::size_t i) {
      return bundle.tip_used[c][i] && (i + 2 * c) % kFolds == fold;
    };
    eachTip(observations, [&](std::size_t c, std::size_t i, const TipObservation&) {
      if (is_out(c, i)) without.tip_used[c][i] = false;
    });
    without = adjusted(observations, without);
    const MeasuredArm arm = without.arm();
    eachTip(observations, [&](std::size_t c, std::size_t i, const TipObservation& observation) {
      if (!is_out(c, i)) return;
      const TipError error = tipError(without, arm, c, observation);
      squares_mm2 += error.mm_per_px * error.mm_per_px * glm::dot(error.off_px, error.off_px);
      noise_mm2 += 2.0 * std::pow(observations.tip_noise_px * error.mm_per_px, 2);
      count += 1.0;
    });
  }
  return upToThreeAxes(std::max(squares_mm2 - noise_mm2, kMinPredictedShare * squares_mm2), count);
}

/// From the nearest point on the line of sight to the arm's tip: perpendicular to that line.
Residual residualOf(const WebcamBundle& bundle, std::size_t c, const TipObservation& observation, const TipError& error,
                    bool used) {
  const Pose<World, Camera> X_WC = bundle.X_CW[c].inverse();
  const glm::dvec3 ahead = glm::normalize(error.tip_W.mm - X_WC.translation_mm);
  const glm::dvec3 across = X_WC.rotation * glm::dvec3(error.off_px * error.mm_per_px, 0.0);
  const glm::dvec3 off = across - ahead * glm::dot(ahead, across);
  return {observation.id, {error.tip_W.mm - off}, {off}, used};
}

void measure(const WebcamObservations& observations, const WebcamBundle& bundle, WebcamFit& fit) {
  double screen_px2 = 0.0, points = 0.0, tip_px2 = 0.0, tip_mm2 = 0.0;
  for (std::size_t c = 0; c < observations.positions.size(); ++c)
    for (const ScreenObservation& observation : observations.positions[c].screen) {
      const glm::dvec2 off = bundle.camera.pixelOf(bundle.X_CW[c] * observation.position_W) - observation.camera_px;
      screen_px2 += glm::dot(off, off);
      points += 1.0;
    }
  std::vector<Touch> touches;
  eachTip(observations, [&](std::size_t c, std::size_t i, const TipObservation& observation) {
    const bool used = bundle.tip_used[c][i];
    const TipError error = tipError(bundle, fit.arm, c, observation);
    fit.residuals.push_back(residualOf(bundle, c, observation, error, used));
    touches.push_back({observation.id, observation.joints_rad, fit.residuals.back().target_W, used});
    (used ? fit.used : fit.outliers) += 1;
    if (!used) return;
    tip_px2 += glm::dot(error.off_px, error.off_px);
    tip_mm2 += glm::dot(fit.residuals.back().error_mm.xyz, fit.residuals.back().error_mm.xyz);
  });
  fit.screen_rms_px = std::sqrt(screen_px2 / points);
  fit.tip_rms_px = std::sqrt(tip_px2 / std::max(1, fit.used));
  fit.fre_rms_mm = upToThreeAxes(tip_mm2, fit.used);
  std::vector<std::size_t> all(touches.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  fit.tilt_spread_deg = tiltSpread_deg(bundle.start.geometry, touches, all);
}

void warn(const WebcamObservations& observations, WebcamFit& fit) {
  const auto add = [&](FitWarning::Kind kind, std::string line) { fit.warnings.push_back({kind, std::move(line)}); };
  if (tipsOf(observations) < kFewTips)
    add(FitWarning::Kind::few_touches,
        std::to_string(tipsOf(observations)) + " tips are few: touch 27 positions from each of three camera positions");
  if (fit.baseline_deg < kNarrowBase_deg)
    add(FitWarning::Kind::narrow_view, "the camera positions are only " +
                                           std::to_string(std::lround(fit.baseline_deg)) +
                                           "° apart: move the camera by 25° to each side");
  if (fit.tilt_spread_deg < kMinTilt_deg)
    add(FitWarning::Kind::little_tilt, "the stylus was held one way: errors of its gimbal are not detected, tilt it");
  if (10 * fit.outliers > fit.used + fit.outliers)
    add(FitWarning::Kind::many_outliers,
        std::to_string(fit.outliers) + " of " + std::to_string(fit.used + fit.outliers) +
            " tips do not fit: look for reflections, hold it still while it is recorded");
}

}  // namespace

WebcamFit fitWebcam(const WebcamObservations& observations, ArmModel model) {
  if (observations.positions.size() < kMinPositions)
    refuseWebcam("one camera position can be wrong by a centimetre and look good",
                 "move the camera and take a second one");
  if (tipsOf(observations) < kMinTips)
    refuseWebcam(std::to_string(tipsOf(observations)) + " tips are too few",
                 "touch at least 16 positions in all, better 27 each time");
  checkObservations(observations);
  const WebcamBundle guess = firstGuess(observations);
  if (widestBaseline_deg(guess) < kMinBase_deg)
    refuseWebcam("all camera positions are the same", "move the camera by 25° to each side");

  const WebcamBundle bundle = fitted(observations, guess, model);
  WebcamFit fit;
  fit.model = model;
  fit.arm = bundle.arm();
  fit.camera = bundle.camera;
  for (const auto& X_CW : bundle.X_CW) fit.X_WC.push_back(X_CW.inverse());
  fit.baseline_deg = widestBaseline_deg(bundle);
  fit.iterations = bundle.iterations;
  fit.sigma.assign(bundle.sigma.begin(), bundle.sigma.end());
  measure(observations, bundle, fit);
  if (3 * fit.outliers > fit.used || !(bundle.mismatch_mm < kMaxMismatch_mm))
    refuseWebcam("no arm explains where the tip is seen", "check that touches and images belong together");
  fit.cv_rms_mm = crossValidated_mm(observations, bundle);
  warn(observations, fit);
  return fit;
}

}  // namespace calibration
