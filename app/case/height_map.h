// A map of the bone around a crown, seen along the bur's way in: lines along `outward` on a square lattice, one number
// each, the height of the bur's centre. For gutter_plan.h and procedure/third_molar. Frame P, mm. Any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace app {

/// Axes of the map: distal, across (buccal), outward.
struct WayIn {
  glm::dvec3 middle_P_mm, along, across, outward;

  glm::dvec3 local(const glm::dvec3& p) const {
    const glm::dvec3 q = p - middle_P_mm;
    return {glm::dot(q, along), glm::dot(q, across), glm::dot(q, outward)};
  }
  glm::dvec3 inPatient(const glm::dvec3& q) const { return middle_P_mm + q.x * along + q.y * across + q.z * outward; }
};

/// No number, below every height.
inline constexpr double kNoHeight_mm = -1e9;

/// One number per column of the map.
class HeightMap {
 public:
  HeightMap() : mm_(kColumns, kNoHeight_mm) {}
  static constexpr double kReach_mm = 12.0;  ///< from the crown's middle
  static constexpr double kColumn_mm = 0.3;  ///< from line to line
  static constexpr int kHalf = static_cast<int>(kReach_mm / kColumn_mm), kSide = 2 * kHalf + 1;
  static constexpr std::size_t kColumns = static_cast<std::size_t>(kSide) * kSide;

  /// Where a column stands in a list of all kColumns of them.
  static std::size_t column(int i, int j) { return static_cast<std::size_t>(j) * kSide + static_cast<std::size_t>(i); }
  double& at(int i, int j) { return mm_[column(i, j)]; }
  double at(int i, int j) const { return mm_[column(i, j)]; }
  static double place_mm(int i) { return kColumn_mm * (i - kHalf); }

  /// visit(i, j, squared distance) for the columns within a radius.
  template <class Visit>
  static void near(const glm::dvec3& q, double radius_mm, const Visit& visit) {
    const auto bound = [](double mm) {
      return static_cast<int>(std::ceil(std::clamp(mm / kColumn_mm, -1e6, 1e6))) + kHalf;
    };
    for (int j = std::max(bound(q.y - radius_mm), 0); j < std::min(bound(q.y + radius_mm), kSide); ++j)
      for (int i = std::max(bound(q.x - radius_mm), 0); i < std::min(bound(q.x + radius_mm), kSide); ++i) {
        const double x = place_mm(i) - q.x, y = place_mm(j) - q.y, square = x * x + y * y;
        if (square < radius_mm * radius_mm) visit(i, j, square);
      }
  }
  /// Rests a ball of this radius on a point.
  void rest(const glm::dvec3& q, double radius_mm) {
    near(q, radius_mm, [&](int i, int j, double square) {
      at(i, j) = std::max(at(i, j), q.z + std::sqrt(radius_mm * radius_mm - square));
    });
  }

 private:
  std::vector<double> mm_;
};

/// Heights of the bur's centre on each line along the way in.
struct Heights {
  HeightMap bone;    ///< touching bone from above
  HeightMap tooth;   ///< resting on the operated tooth
  HeightMap lowest;  ///< that is allowed
  HeightMap crown;   ///< any number where the line belongs to crown or gutter
};

}  // namespace app
