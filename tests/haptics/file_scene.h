// Files, canals and hands for the tests and the bench of haptics/file: a canal of closed form as a field, and a hand
// that wanders, seeded: from goal to goal, pushes, pulls, turns and tilts, up to 25 mm/s.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "assets/synthetic/root_canal.h"
#include "haptics/bone/cubelets.h"
#include "haptics/file/file_in_canal.h"

namespace haptics::phantom {

struct CanalWall {
  assets::RootCanal canal;
  assets::CanalField field;
  Cubelets cubelets;
  SolidField wall;

  explicit CanalWall(const assets::RootCanal& of, double spacing_mm = 0.04)
      : canal(of),
        field(assets::canalField(of, spacing_mm)),
        cubelets(field.grid, field.solid, {}),
        wall(cubelets.field()) {}
};

/// Schneider 30 degrees, R 5, 16 mm: the canal of the reference.
/// Its orifice sharp, as there, or with a round edge, as an access cavity leaves it.
inline assets::RootCanal bentCanal(double flare_mm = 0.0) {
  return {10.14, 5.0, std::numbers::pi / 4.0, 1.93, 0.30, 0.125, 1.0, flare_mm};
}

/// The handle straight above the orifice, the tip `above_mm` over it.
inline FilePose above(const FileChain& chain, double above_mm) {
  FilePose X_PT;
  X_PT.translation_mm = {0.0, 0.0, chain.length_mm() + above_mm};
  return X_PT;
}

inline FileChain steelFile(int size, std::size_t links = kUsualLinks, int length_mm = 21) {
  return fileChain(*assets::kFile(size, length_mm, assets::KFileMetal::steel), links);
}

/// The same friction in every direction.
inline FileLaw evenFriction(double friction = 0.15) {
  FileLaw law;
  law.friction_along = law.friction_across = friction;
  return law;
}

class WanderingHand {
 public:
  WanderingHand(unsigned seed, const FilePose& start, double deepest_mm)
      : random_(seed), start_(start), at_(start), deepest_mm_(deepest_mm) {}

  /// One tick of 1 ms later.
  FilePose next() {
    if (left_ == 0) choose();
    --left_;
    for (std::size_t n = 0; n < kWays; ++n) {
      soft_[n] += (goal_[n] - soft_[n]) * 0.015;
      now_[n] += (soft_[n] - now_[n]) * 0.015;
    }
    at_ = start_;
    at_.translation_mm += glm::dvec3(now_[0], now_[1], -now_[2]);
    at_.rotation = glm::normalize(start_.rotation * glm::angleAxis(now_[3], glm::dvec3(0.0, 0.0, -1.0)) *
                                  glm::angleAxis(now_[4], glm::dvec3(1.0, 0.0, 0.0)) *
                                  glm::angleAxis(now_[5], glm::dvec3(0.0, 1.0, 0.0)));
    return at_;
  }

 private:
  static constexpr std::size_t kWays = 6;
  static constexpr double kLeast_mm = 1.0;

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  void choose() {
    left_ = static_cast<int>(between(100.0, 600.0));
    goal_[0] = between(-1.5, 1.5);
    goal_[1] = between(-1.5, 1.5);
    // A stroke most of the time, all along the canal now and then; the tip stays in it.
    goal_[2] = between(0.0, 1.0) < 0.15 ? between(kLeast_mm, deepest_mm_) : goal_[2] + between(-2.5, 2.8);
    goal_[2] = std::clamp(goal_[2], kLeast_mm, deepest_mm_);
    goal_[3] += between(-1.5, 1.5);
    goal_[4] = between(-0.06, 0.06);
    goal_[5] = between(-0.06, 0.06);
  }

  std::mt19937 random_;
  FilePose start_, at_;
  double deepest_mm_;
  int left_ = 0;
  std::array<double, kWays> now_{}, soft_{}, goal_{};
};

}  // namespace haptics::phantom
