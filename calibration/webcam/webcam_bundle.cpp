#include "calibration/webcam/webcam_bundle.h"

#include <cmath>
#include <limits>

#include "calibration/fit/least_squares.h"
#include "calibration/geometry/rotation.h"

namespace calibration {
namespace {

constexpr double kScreenCauchy = 4.0, kTipCauchy = 4.0;       ///< in sigmas: half weight there
constexpr double kFocalSigma = 0.002, kCentreSigma_px = 2.0;  ///< prior of the lens; relative, px
constexpr std::size_t kPoseNumbers = 6, kLensNumbers = 3;
constexpr int kMaxIterations = 40;

/// A pixel with its derivatives by the point in C and by the lens parameters.
struct PixelSlopes {
  glm::dvec2 px{0.0};
  glm::dmat3x2 by_point{0.0};  ///< columns x, y, z of p_C
  glm::dvec2 by_focal{0.0};    ///< of a relative change
};
PixelSlopes pixelSlopes(const CameraModel& camera, const glm::dvec3& p_C) {
  const double x = p_C.x / p_C.z, y = p_C.y / p_C.z, r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (camera.k1 + r2 * camera.k2), slope = camera.k1 + 2.0 * r2 * camera.k2;
  const double across = 2.0 * x * y * slope + 2.0 * camera.p1 * x + 2.0 * camera.p2 * y;
  const double xx = radial + 2.0 * x * x * slope + 2.0 * camera.p1 * y + 6.0 * camera.p2 * x;
  const double yy = radial + 2.0 * y * y * slope + 6.0 * camera.p1 * y + 2.0 * camera.p2 * x;
  PixelSlopes of;
  of.px = camera.pixelOf({p_C});
  of.by_focal = of.px - camera.centre_px;
  const glm::dvec2 by_x = camera.focal_px * glm::dvec2(xx, across), by_y = camera.focal_px * glm::dvec2(across, yy);
  of.by_point[0] = by_x / p_C.z;
  of.by_point[1] = by_y / p_C.z;
  of.by_point[2] = -(x * by_x + y * by_y) / p_C.z;
  return of;
}

/// Rotated about, and translated at, the point where W's origin is in C.
Pose<Camera, World> movedPose(const Pose<Camera, World>& X_CW, const double* parameters) {
  return {glm::normalize(rotationFromVector({parameters[0], parameters[1], parameters[2]}) * X_CW.rotation),
          X_CW.translation_mm + glm::dvec3(parameters[3], parameters[4], parameters[5])};
}

CameraModel movedLens(CameraModel camera, const double* parameters) {
  camera.focal_px *= 1.0 + parameters[0];
  camera.centre_px += glm::dvec2(parameters[1], parameters[2]);
  return camera;
}

/// Parameter order: the arm's, six of each camera position, three of the lens.
class BundleProblem {
 public:
  BundleProblem(const WebcamObservations& observations, const WebcamBundle& from)
      : observations_(observations), from_(from) {
    first_pose_ = from.fitted.size();
    first_lens_ = first_pose_ + kPoseNumbers * observations.positions.size();
    count_ = first_lens_ + kLensNumbers;

    LeastSquares& p = problem_;
    for (const std::size_t k : from.fitted) {
      p.start.push_back(from.parameters[k]);
      p.priors.push_back({0.0, kArmPriorSigma[k]});
    }
    p.start.resize(count_, 0.0);
    p.priors.resize(first_lens_);
    const glm::dvec2 off_px = observations.camera.centre_px - from.camera.centre_px;
    p.priors.push_back({observations.camera.focal_px.x / from.camera.focal_px.x - 1.0, kFocalSigma});
    p.priors.push_back({off_px.x, kCentreSigma_px});
    p.priors.push_back({off_px.y, kCentreSigma_px});

    const MeasuredArm arm = from.arm();
    for (std::size_t c = 0; c < observations.positions.size(); ++c) {
      for (std::size_t i = 0; i < observations.positions[c].screen.size(); ++i) p.groups.push_back({2, kScreenCauchy});
      for (std::size_t i = 0; i < observations.positions[c].tips.size(); ++i) {
        if (!from.tip_used[c][i]) continue;
        p.groups.push_back({2, kTipCauchy});
        tips_.push_back(
            {c, i, tipSigma_px(observations, from, c, arm.tip_W(observations.positions[c].tips[i].joints_rad))});
      }
    }
    p.residuals = 2 * p.groups.size();
    p.max_iterations = kMaxIterations;
    p.relative_tolerance = 1e-7;
    p.residuals_at = [this](std::span<const double> x, std::span<double> r) { evaluate(x, r, {}); };
    p.jacobian_at = [this](std::span<const double> x, std::span<double> J) { evaluate(x, {}, J); };
  }
  BundleProblem(const BundleProblem&) = delete;
  BundleProblem& operator=(const BundleProblem&) = delete;

  WebcamBundle solution() const {
    const LeastSquaresResult result = solved(problem_);
    WebcamBundle bundle = from_;
    bundle.parameters = armNumbers(result.parameters);
    for (std::size_t c = 0; c < bundle.X_CW.size(); ++c)
      bundle.X_CW[c] = movedPose(from_.X_CW[c], &result.parameters[first_pose_ + kPoseNumbers * c]);
    bundle.camera = movedLens(from_.camera, &result.parameters[first_lens_]);
    bundle.iterations += result.iterations;
    bundle.sigma = {};
    bundle.effective_arm_parameters = 0.0;
    for (std::size_t i = 0; i < from_.fitted.size() && !result.covariance.empty(); ++i) {
      const double variance = result.covariance[i * count_ + i];
      const double prior = kArmPriorSigma[from_.fitted[i]];
      bundle.sigma[from_.fitted[i]] = std::sqrt(variance);
      bundle.effective_arm_parameters += prior > 0.0 ? 1.0 - variance / (prior * prior) : 1.0;
    }
    return bundle;
  }

 private:
  struct Tip {
    std::size_t position, index;
    double sigma_px;
  };

  ArmParameters armNumbers(std::span<const double> x) const {
    ArmParameters parameters{};
    for (std::size_t i = 0; i < from_.fitted.size(); ++i) parameters[from_.fitted[i]] = x[i];
    return parameters;
  }

  /// Residuals or Jacobian, position by position: screen, then tips.
  void evaluate(std::span<const double> x, std::span<double> r, std::span<double> J) const {
    const CameraModel camera = movedLens(from_.camera, &x[first_lens_]);
    const ArmParameters parameters = armNumbers(x);
    const MeasuredArm arm = armOf(from_.start, parameters);
    std::size_t row = 0;
    auto tip = tips_.begin();
    for (std::size_t c = 0; c < observations_.positions.size(); ++c) {
      const double* pose = &x[first_pose_ + kPoseNumbers * c];
      const Pose<Camera, World> X_CW = movedPose(from_.X_CW[c], pose);
      for (const ScreenObservation& observation : observations_.positions[c].screen)
        setRows(row++, r, J, c, pose, camera, X_CW, observation.position_W.mm, observation.camera_px,
                observations_.screen_noise_px);
      for (; tip != tips_.end() && tip->position == c; ++tip) {
        const TipObservation& observation = observations_.positions[c].tips[tip->index];
        if (J.empty()) {
          setRows(row++, r, J, c, pose, camera, X_CW, arm.tip_W(observation.joints_rad).mm, observation.camera_px,
                  tip->sigma_px);
          continue;
        }
        const TipJacobian slopes = tipJacobian(from_.start, parameters, observation.joints_rad);
        const glm::dmat3x2 by_W =
            setRows(row, r, J, c, pose, camera, X_CW, slopes.tip_W_mm, observation.camera_px, tip->sigma_px);
        for (std::size_t k = 0; k < from_.fitted.size(); ++k)
          setSlope(J, row, k, by_W * slopes.by_parameter[from_.fitted[k]] / tip->sigma_px);
        ++row;
      }
    }
  }

  void setSlope(std::span<double> J, std::size_t row, std::size_t number, const glm::dvec2& slope) const {
    J[2 * row * count_ + number] = slope.x;
    J[(2 * row + 1) * count_ + number] = slope.y;
  }

  /// One point, except for the arm's parameters; returns the pixel's derivatives by the point in W.
  glm::dmat3x2 setRows(std::size_t row, std::span<double> r, std::span<double> J, std::size_t c, const double* pose,
                       const CameraModel& camera, const Pose<Camera, World>& X_CW, const glm::dvec3& p_W,
                       const glm::dvec2& seen_px, double sigma_px) const {
    const glm::dvec3 from_origin = X_CW.rotation * p_W, p_C = from_origin + X_CW.translation_mm;
    if (J.empty()) {
      const glm::dvec2 off = p_C.z > 1.0 ? (camera.pixelOf({p_C}) - seen_px) / sigma_px
                                         : glm::dvec2(std::numeric_limits<double>::quiet_NaN());
      r[2 * row] = off.x;
      r[2 * row + 1] = off.y;
      return {};
    }
    const PixelSlopes slopes = pixelSlopes(camera, p_C);
    // Left Jacobian to first order: rotations are small.
    const glm::dmat3 by_turn =
        -crossMatrix(from_origin) * (glm::dmat3(1.0) + 0.5 * crossMatrix({pose[0], pose[1], pose[2]}));
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      setSlope(J, row, first_pose_ + kPoseNumbers * c + k, slopes.by_point * by_turn[axis] / sigma_px);
      setSlope(J, row, first_pose_ + kPoseNumbers * c + 3 + k, slopes.by_point[axis] / sigma_px);
    }
    setSlope(J, row, first_lens_, slopes.by_focal / sigma_px);
    setSlope(J, row, first_lens_ + 1, glm::dvec2(1.0, 0.0) / sigma_px);
    setSlope(J, row, first_lens_ + 2, glm::dvec2(0.0, 1.0) / sigma_px);
    return slopes.by_point * glm::mat3_cast(X_CW.rotation);
  }

  const WebcamObservations& observations_;
  const WebcamBundle& from_;
  std::size_t first_pose_ = 0, first_lens_ = 0, count_ = 0;
  std::vector<Tip> tips_;
  LeastSquares problem_;
};

}  // namespace

double tipSigma_px(const WebcamObservations& observations, const WebcamBundle& bundle, std::size_t position,
                   const Point<World>& tip_W) {
  const double away_mm = std::max(50.0, (bundle.X_CW[position] * tip_W).mm.z);
  return std::hypot(observations.tip_noise_px, bundle.mismatch_mm * bundle.camera.focal_px.x / away_mm);
}

WebcamBundle adjusted(const WebcamObservations& observations, const WebcamBundle& from) {
  return BundleProblem(observations, from).solution();
}

}  // namespace calibration
