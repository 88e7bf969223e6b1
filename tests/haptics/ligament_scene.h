// Roots for tests of the ligament: a cylinder without ends, and two tapered roots as in reference/extraction 3.3.
// mm; origin at the alveolar crest, z up.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "haptics/ligament/piece_hold.h"
#include "tests/haptics/way_out_scene.h"

namespace haptics::phantom {

inline void addRing(std::vector<SamplePoint>& points, const glm::dvec3& middle, double radius, double area_mm2,
                    double spacing_mm, double phase, double lean, double width_mm) {
  const int count = std::max(6, static_cast<int>(std::lround(2.0 * std::numbers::pi * radius / spacing_mm)));
  for (int n = 0; n < count; ++n) {
    const double angle = 2.0 * std::numbers::pi * (n + phase) / count;
    const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
    points.push_back({.p_Q_mm = middle + radius * out,
                      .outward = glm::normalize(out + glm::dvec3(0.0, 0.0, -lean)),
                      .area_mm2 = area_mm2 / count,
                      .width_mm = width_mm,
                      .has_ligament = true});
  }
}

inline std::vector<SamplePoint> cylinder(double radius_mm, double length_mm, double spacing_mm, double width_mm) {
  std::vector<SamplePoint> points;
  const int rings = static_cast<int>(std::lround(length_mm / spacing_mm));
  const double ring_mm2 = 2.0 * std::numbers::pi * radius_mm * length_mm / rings;
  for (int n = 0; n < rings; ++n)
    addRing(points, {0.0, 0.0, length_mm * ((n + 0.5) / rings - 0.5)}, radius_mm, ring_mm2, spacing_mm, 0.0, 0.0,
            width_mm);
  return points;
}

/// From 2.5 mm radius at the crest to 0.9 mm at 11 mm depth, rounded at the tip; 5.2 mm apart.
inline std::vector<SamplePoint> twoRoots(double spacing_mm, double width_mm = 0.2) {
  constexpr double kLength_mm = 11.0, kTop_mm = 2.5, kTip_mm = 0.9;
  std::vector<SamplePoint> points;
  const double lean = (kTop_mm - kTip_mm) / kLength_mm, slant = std::hypot(1.0, lean);
  for (const double side : {-2.6, 2.6}) {
    const int rings = static_cast<int>(std::lround(kLength_mm * slant / spacing_mm));
    for (int n = 0; n < rings; ++n) {
      const double share = (n + 0.5) / rings, radius = kTop_mm + (kTip_mm - kTop_mm) * share;
      addRing(points, {side, 0.0, -kLength_mm * share}, radius,
              2.0 * std::numbers::pi * radius * kLength_mm * slant / rings, spacing_mm, 0.5 * (n & 1), lean, width_mm);
    }
    const int caps = std::max(1, static_cast<int>(std::lround(kTip_mm / spacing_mm)));
    for (int n = 0; n < caps; ++n) {
      const double from = 0.5 * std::numbers::pi * n / caps, to = 0.5 * std::numbers::pi * (n + 1) / caps;
      const double angle = 0.5 * (from + to);
      addRing(points, {side, 0.0, -kLength_mm - kTip_mm * std::cos(angle)}, kTip_mm * std::sin(angle),
              2.0 * std::numbers::pi * kTip_mm * kTip_mm * (std::cos(from) - std::cos(to)), spacing_mm, 0.0,
              std::cos(angle) / std::sin(angle), width_mm);
    }
  }
  return points;
}

inline HoldSums sumsAt(const PieceHold& hold, const PiecePose& X_PQ, const DistanceField* obstacles = nullptr) {
  const auto [law, samples, place] = hold.inputAt(X_PQ, obstacles, 1e-3);
  return sumHold(law, samples, place);
}

/// A tapered root with a crown, and bone around the root at a distance of 0.25 mm; the crown touches nothing.
struct SocketScene {
  ToothPhantom bone, piece;

  std::vector<SamplePoint> points(const DistanceField& around, double spacing_mm = 0.5) const {
    return surfaceSamples(
        view(piece), around, [](const glm::dvec3& p, const glm::dvec3&) { return p.z < 0.0; }, LigamentLaw{},
        spacing_mm);
  }
  PieceHold hold(const DistanceField& around) const { return {arranged(points(around)), LigamentLaw{}}; }
};

inline double rootDistance_mm(const glm::dvec3& p) {
  const double share = std::clamp(-p.z / 11.0, 0.0, 1.0), radius = 3.2 - 1.6 * share;
  return glm::length(glm::dvec3(p.x, p.y, p.z + std::clamp(-p.z, 0.0, 10.0))) - radius;
}

inline SocketScene rootInSocket(double spacing_mm = 0.2) {
  const auto tooth = [](const glm::dvec3& p) {
    const double crown = boxDistance_mm(p - glm::dvec3(0, 0, 3.0), {3.2, 3.2, 2.0}) - 0.8;
    return std::min(crown, std::max(rootDistance_mm(p), p.z - 1.0));
  };
  const auto size = [&](double x, double z) { return glm::ivec3(glm::ceil(glm::dvec3(x, x, z) / spacing_mm)); };
  return {solidOf(size(12.0, 32.0), spacing_mm,
                  [](const glm::dvec3& p) { return std::max(p.z + 0.4, 0.25 - rootDistance_mm(p)); }),
          solidOf(size(9.0, 30.0), spacing_mm, tooth)};
}

/// A hand that goes somewhere else every 0.2 s, up to a force and a torque.
class RandomHand {
 public:
  RandomHand(unsigned seed, double way_mm, double turn_rad) : random_(seed), way_mm_(way_mm), turn_rad_(turn_rad) {
    drive_.spring.stiffness_N_per_mm = 500.0;
    drive_.spring.stiffness_Nmm_per_rad = 2e4;
    drive_.spring.most_force_N = 200.0;
    drive_.spring.most_torque_Nmm = 3000.0;
    drive_.spring.grip_Q.mm = {0.0, 0.0, 4.0};
  }

  const PieceDrive& next() {
    if (tick_++ % 200 == 0) {
      from_ = to_;
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      for (double& part : to_) part = unit(random_);
      to_[2] = 0.5 + 0.5 * to_[2];
    }
    const double share = (tick_ - 1) % 200 / 200.0;
    std::array<double, 6> at{};
    for (std::size_t n = 0; n < 6; ++n) at[n] = from_[n] + share * (to_[n] - from_[n]);
    PiecePose& target = drive_.spring.target_X_PQ;
    target.translation_mm = way_mm_ * glm::dvec3(at[0], at[1], at[2]);
    target.rotation = glm::normalize(glm::dquat(1.0, 0.5 * turn_rad_ * glm::dvec3(at[3], at[4], at[5])));
    return drive_;
  }

 private:
  std::mt19937 random_;
  double way_mm_, turn_rad_;
  int tick_ = 0;
  std::array<double, 6> from_{}, to_{};
  PieceDrive drive_;
};

/// A hold that pulls towards z without a turn.
inline PieceDrive pulledUp(double to_mm, double N_per_mm = 5e3, double turn_Nmm_per_rad = 1e7) {
  PieceDrive drive;
  drive.spring.stiffness_N_per_mm = N_per_mm;
  drive.spring.stiffness_Nmm_per_rad = turn_Nmm_per_rad;
  drive.spring.target_X_PQ.translation_mm.z = to_mm;
  return drive;
}

}  // namespace haptics::phantom
