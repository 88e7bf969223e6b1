#include "calibration/fit/target_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"

namespace calibration {
namespace {

/// The jig block, and the crosses on the screen.
constexpr glm::dvec3 kJigHalf_mm{65.0, 45.0, 32.5};
constexpr glm::dvec2 kCrossesHalf_mm{65.0, 45.0};
constexpr glm::dvec3 kPlacesHalf_mm{60.0, 42.0, 30.0};

constexpr double kMaxTilt_deg = 25.0;  ///< an axis
constexpr int kFirstVerificationId = 101;
constexpr int kSwings = 12;

/// The smallest rotation that takes z to `there`.
glm::dquat rotationOfZ(const glm::dvec3& there) {
  const double cosine = there.z;
  if (cosine < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};
  return glm::normalize(glm::dquat(1.0 + cosine, -there.y, there.x, 0.0));
}

/// Tilted from the resting direction, sideways and upwards.
Vector<World> tilted(double side_deg, double up_deg) {
  const double side = radFromDegrees(side_deg), up = radFromDegrees(up_deg);
  const glm::dvec3 from_rest(std::sin(side) * std::cos(up), std::sin(up), std::cos(side) * std::cos(up));
  return {rotationOfZ(kRestingStylus_W.xyz) * from_rest};
}

/// From -1 to 1 in `count` steps.
double level(int index, int count) { return 2.0 * index / (count - 1) - 1.0; }

/// A grid in serpentine order. Every tilt goes with every column, row and layer alike (Latin squares), so that gimbal
/// errors are not confounded with arm errors.
std::vector<Target> grid(const glm::ivec3& count, const glm::dvec3& half_mm, const Pose<World, Board>& X_WB) {
  std::vector<Target> targets;
  const int tilts = std::max(count.x, count.y);
  for (int k = 0; k < count.z; ++k)
    for (int row = 0; row < count.y; ++row)
      for (int column = 0; column < count.x; ++column) {
        const int j = k % 2 == 0 ? row : count.y - 1 - row;
        const int i = (row + k * count.y) % 2 == 0 ? column : count.x - 1 - column;
        const glm::dvec3 at(level(i, count.x), level(j, count.y), count.z > 1 ? level(k, count.z) : 0.0);
        const double side = level((i + j + k) % tilts, tilts), up = level((i + 2 * j + 2 * k + 1) % tilts, tilts);
        targets.push_back({static_cast<int>(targets.size()) + 1, X_WB * Point<Board>{at * half_mm},
                           tilted(kMaxTilt_deg * side, kMaxTilt_deg * up)});
      }
  return targets;
}

/// A position in the block, in halves of it, and a tilt.
struct Hold {
  glm::dvec3 at{0.0};
  double side_deg = 0.0, up_deg = 0.0;
};

template <std::size_t n>
std::vector<Target> held(const std::array<Hold, n>& holds, int first_id, const Pose<World, Board>& X_WB) {
  std::vector<Target> targets;
  for (const Hold& hold : holds)
    targets.push_back({first_id + static_cast<int>(targets.size()), X_WB * Point<Board>{hold.at * kJigHalf_mm},
                       tilted(hold.side_deg, hold.up_deg)});
  return targets;
}

/// The corners.
constexpr std::array<Hold, 8> kCorners = {{{{-1, -1, -1}, -25, 20},
                                           {{1, -1, -1}, 5, -25},
                                           {{1, 1, -1}, -20, -15},
                                           {{-1, 1, -1}, 25, 10},
                                           {{-1, 1, 1}, -10, -25},
                                           {{1, 1, 1}, 25, -5},
                                           {{1, -1, 1}, -25, 5},
                                           {{-1, -1, 1}, 10, 25}}};

/// Between the fit's pits, each with two tilts that the fit has not seen.
constexpr std::array<Hold, 16> kBetween = {{{{-0.5, -0.5, -0.5}, -14, 22},
                                            {{-0.5, -0.5, -0.5}, 18, -10},
                                            {{0.5, -0.5, -0.5}, -20, -12},
                                            {{0.5, -0.5, -0.5}, 12, 18},
                                            {{0.5, 0.5, -0.5}, 22, -16},
                                            {{0.5, 0.5, -0.5}, -8, 12},
                                            {{-0.5, 0.5, -0.5}, 10, 20},
                                            {{-0.5, 0.5, -0.5}, -22, -6},
                                            {{-0.5, 0.5, 0.5}, 14, -22},
                                            {{-0.5, 0.5, 0.5}, -18, 10},
                                            {{0.5, 0.5, 0.5}, 20, 12},
                                            {{0.5, 0.5, 0.5}, -12, -18},
                                            {{0.5, -0.5, 0.5}, -22, 16},
                                            {{0.5, -0.5, 0.5}, 8, -12},
                                            {{-0.5, -0.5, 0.5}, -10, -20},
                                            {{-0.5, -0.5, 0.5}, 22, 6}}};

/// One pit, the handle swung about it in steps of 150 degrees at the largest tilt, every third at half of it.
std::vector<Target> swung(const Pose<World, Board>& X_WB) {
  std::vector<Target> targets;
  for (int i = 0; i < kSwings; ++i) {
    const double round = 2.0 * kPi * 5 * i / kSwings, max_deg = i % 3 == 2 ? 0.5 * kMaxTilt_deg : kMaxTilt_deg;
    targets.push_back({i + 1, X_WB * Point<Board>{}, tilted(max_deg * std::cos(round), max_deg * std::sin(round))});
  }
  return targets;
}

/// Four corners that are not neighbours, and the centre.
constexpr std::array<Hold, 5> kRezero = {
    {{{-1, -1, -1}, -20, 10}, {{1, 1, -1}, 15, -20}, {{0, 0, 0}, 0, 0}, {{-1, 1, 1}, 20, 20}, {{1, -1, 1}, -15, -15}}};

/// The other four corners.
constexpr std::array<Hold, 4> kCheck = {
    {{{1, -1, -1}, -15, 15}, {{-1, 1, -1}, 20, -10}, {{1, 1, 1}, -20, -15}, {{-1, -1, 1}, 15, 20}}};

}  // namespace

std::optional<TargetPlan> targetPlan(std::string_view method, const JigPose& jig) {
  TargetPlan plan{.method = std::string(method),
                  .kind = TargetKind::pit,
                  .precision = kPitPrecision,
                  .targets = {},
                  .one_pit = false};
  const Pose<World, Board> upright;
  if (method == "jig27") {
    plan.targets = grid({3, 3, 3}, kJigHalf_mm, jig.X_WB);
  } else if (method == "jig8") {
    plan.targets = held(kCorners, 1, jig.X_WB);
  } else if (method == "rezero5") {
    plan.targets = held(kRezero, 1, jig.X_WB);
  } else if (method == "check4") {
    plan.targets = held(kCheck, kFirstVerificationId, jig.X_WB);
  } else if (method == "verify8") {
    plan.targets = held(kBetween, kFirstVerificationId, jig.X_WB);
  } else if (method == "pivot12") {
    plan.targets = swung(jig.X_WB);
    plan.one_pit = true;
  } else if (method == "visual15" || method == "visual25") {
    plan.kind = TargetKind::cross;
    plan.precision = kCrossPrecision;
    plan.targets = grid({5, method == "visual15" ? 3 : 5, 1}, {kCrossesHalf_mm, 0.0}, upright);
  } else if (method == "webcam27") {
    plan.kind = TargetKind::webcam_place;
    plan.targets = grid({3, 3, 3}, kPlacesHalf_mm, upright);
  } else {
    return std::nullopt;
  }
  return plan;
}

Pose<World, Handle> handleHolding(const Target& target, const glm::dvec3& tip_H_mm) {
  const glm::dquat rotation = rotationOfZ(target.stylus_W.xyz);
  return {rotation, target.position_W.mm - rotation * tip_H_mm};
}

}  // namespace calibration
