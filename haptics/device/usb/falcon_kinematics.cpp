#include "haptics/device/usb/falcon_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::Device;
using calibration::kPi;
using calibration::Point;

// Lengths in mm with the published names.
constexpr double kA = 60.0, kB = 102.5, kC = 14.43, kDandE = 2.0 * 11.25, kF = -25.0, kR = 40.0, kS = -23.09;
// A wheel of 320 slots, four counts each, on a shaft of 14.25 mm that pulls an arm of 110 mm; 35 degrees at count 0.
constexpr double kRadPerCount = 2.0 * kPi / (4.0 * 320.0) * 14.25 / 110.0;
constexpr double kRadAtZero = calibration::radFromDegrees(35.0);
constexpr std::array kTurn_rad{calibration::radFromDegrees(105.0), calibration::radFromDegrees(-15.0),
                               calibration::radFromDegrees(-135.0)};

constexpr int kMaxSteps = 15;
constexpr double kLongestStep_mm = 20.0, kCloseEnough_mm = 1e-10;

/// The shin's end in the frame of a leg, and that frame's axes.
struct Shin {
  glm::dvec3 u, v;
  double X, Z, V;

  Shin(std::size_t leg, const glm::dvec3& grip_mm)
      : u(std::cos(kTurn_rad[leg]), std::sin(kTurn_rad[leg]), 0.0),
        v(-u.y, u.x, 0.0),
        X(glm::dot(u, grip_mm) - kR + kC),
        Z(grip_mm.z),
        V(glm::dot(v, grip_mm) - kS + kF) {}
  bool reaches() const { return std::abs(V) < kB; }
  double flat() const { return std::sqrt(kB * kB - V * V); }
  double reach() const { return kDandE + flat(); }
};

/// What Newton brings to zero: excess distance of each knee from the grip, mm, and its gradient.
struct Misfit {
  glm::dvec3 mm{0.0};
  glm::dmat3 rows{0.0};  ///< transposed: column i belongs to leg i
  double size = std::numeric_limits<double>::infinity();

  Misfit(const FalconLegs& legs_rad, const glm::dvec3& grip_mm) {
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const Shin shin(leg, grip_mm);
      if (!shin.reaches()) return;
      const auto i = static_cast<glm::length_t>(leg);
      const double x = shin.X - kA * std::cos(legs_rad[i]), z = shin.Z - kA * std::sin(legs_rad[i]);
      const double far = std::hypot(x, z);
      if (!(far > 0.0)) return;
      mm[i] = far - shin.reach();
      rows[i] = x / far * shin.u + glm::dvec3(0.0, 0.0, z / far) + shin.V / shin.flat() * shin.v;
    }
    size = glm::length(mm);
  }
};

}  // namespace

FalconLegs falconLegs_rad(const std::array<std::int16_t, 3>& encoders) {
  FalconLegs legs_rad;
  for (std::size_t leg = 0; leg < 3; ++leg)
    legs_rad[static_cast<glm::length_t>(leg)] = kRadPerCount * encoders[leg] + kRadAtZero;
  return legs_rad;
}

std::optional<Point<Device>> falconGrip(const FalconLegs& legs_rad, const Point<Device>& near_D) {
  glm::dvec3 grip_mm = near_D.mm;
  Misfit misfit(legs_rad, grip_mm);
  if (!std::isfinite(misfit.size)) return std::nullopt;
  double damping = 1.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (!(std::abs(glm::determinant(misfit.rows)) > 1e-9)) return std::nullopt;
    glm::dvec3 move_mm = -(glm::inverse(glm::transpose(misfit.rows)) * misfit.mm);
    const double far_mm = glm::length(move_mm);
    if (far_mm > kLongestStep_mm) move_mm *= kLongestStep_mm / far_mm;
    const glm::dvec3 next_mm = grip_mm + damping * move_mm;
    const Misfit next(legs_rad, next_mm);

    // Halve a step that does not reduce the misfit.
    if (next.size < misfit.size || far_mm < kCloseEnough_mm) {
      grip_mm = next_mm;
      misfit = next;
      damping = std::min(1.0, 2.0 * damping);
      if (far_mm < kCloseEnough_mm) return Point<Device>{grip_mm};
    } else {
      if (misfit.size < kCloseEnough_mm) return Point<Device>{grip_mm};
      damping *= 0.5;
    }
  }
  return std::nullopt;
}

glm::dmat3 falconJacobian_mm(const FalconLegs& legs_rad, const Point<Device>& grip_D) {
  // The constraint of a leg, differentiated: n . dp = a (Z cos t - X sin t) dt, n along its shin.
  glm::dmat3 shins(0.0);
  glm::dvec3 levers_mm(0.0);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto i = static_cast<glm::length_t>(leg);
    const Shin shin(leg, grip_D.mm);
    if (!shin.reaches()) return glm::dmat3(0.0);
    const double c = std::cos(legs_rad[i]), s = std::sin(legs_rad[i]);
    const double x = shin.X - kA * c, z = shin.Z - kA * s, reach = shin.reach();
    shins[i] = (x * shin.u + glm::dvec3(0.0, 0.0, z) + reach * shin.V / shin.flat() * shin.v) / reach;
    levers_mm[i] = kA * (shin.Z * c - shin.X * s) / reach;
  }
  if (!(std::abs(glm::determinant(shins)) > 1e-6)) return glm::dmat3(0.0);
  glm::dmat3 jacobian = glm::inverse(glm::transpose(shins));
  for (glm::length_t leg = 0; leg < 3; ++leg) jacobian[leg] *= levers_mm[leg];
  return jacobian;
}

Point<Device> falconMiddle() { return {{0.0, 0.0, 125.0}}; }

}  // namespace haptics
