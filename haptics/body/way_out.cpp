#include "haptics/body/way_out.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "assets/ct_volume.h"
#include "haptics/body/distance_field.h"
#include "haptics/body/surface_points.h"
#include "haptics/body/way_bound.h"

namespace haptics {
namespace {

constexpr double kCoarse_mm = 1.0, kFine_mm = 0.5;        // surface points
constexpr double kShell_mm = 0.4, kShellDepth_mm = 0.8;   // points under the surface
constexpr double kLong_mm = 8.0;                          // reach beyond which moves are shorter
constexpr double kSolidPrice = 6.0;                       // mm of way per mm^3 that is cut
constexpr double kSolidEagerness = 3.0;                   // of the bound's price
constexpr std::size_t kPoses = 2000, kPosesInAll = 3000;  // of a search; with which no other is begun
constexpr double kBeyondAnyTooth_mm = 100.0;
constexpr double kToMiddle = 0.1;     // mm of depth that 1 mm from the centroid is worth
constexpr double kStraight_mm = 0.4;  // steps of a straight way
constexpr double kSettle_mm = 0.3;    // of a pose of the way that was found

/// What is searched with: the piece about the middle of its largest ball.
struct SearchedPiece {
  DistanceField field;
  glm::dvec3 middle_mm{0.0};
  double ball_mm = 0.0, reach_mm = 0.0;  ///< radius of the ball; farthest surface point from its middle
  SurfacePoints coarse, fine;
  std::vector<glm::vec3> shell_mm;  ///< from kPlay_mm to kShellDepth_mm deeper, each for kShell_mm cubed

  /// Inside the piece: negative. `p_mm` about the middle.
  double distance_mm(const glm::vec3& p_mm) const { return static_cast<double>(field.at(indexOf(p_mm)).distance_mm); }
  glm::vec3 indexOf(const glm::vec3& p_mm) const {
    return glm::vec3(field.grid().indexFromPoint(middle_mm + glm::dvec3(p_mm)));
  }
};

/// Two voxels of air all around, so that its surface closes.
DistanceField paddedField(const SolidVoxels& piece, const std::stop_token& stop) {
  constexpr int kAround = 2;
  const assets::VolumeGrid padded{piece.grid.size + 2 * kAround, piece.grid.spacing_mm,
                                  piece.grid.centre_P_mm(glm::ivec3(-kAround))};
  std::vector<std::uint8_t> solid(padded.voxelCount(), 0);
  assets::forVoxels(piece.grid,
                    [&](glm::ivec3 ijk, std::size_t v) { solid[padded.index(ijk + kAround)] = piece.solid[v]; });
  return {padded, solid, kBeyondAnyTooth_mm, stop};
}

/// None: nothing is solid, or it was stopped.
std::optional<SearchedPiece> searchedPiece(const SolidVoxels& volume, const std::stop_token& stop) {
  SearchedPiece piece{paddedField(volume, stop), {}, 0.0, 0.0, {}, {}, {}};
  const assets::VolumeGrid& grid = piece.field.grid();
  const assets::VoxelSum inside = assets::voxelSum(grid, [&](std::size_t v) { return piece.field.atVoxel(v) < 0.0F; });
  if (inside.count == 0.0 || stop.stop_requested()) return std::nullopt;
  // Of a root that is as thick everywhere, the place nearest to its middle.
  const glm::dvec3 centroid = inside.sum / inside.count;
  double best_mm = -kBeyondAnyTooth_mm;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double depth_mm = -static_cast<double>(piece.field.atVoxel(v));
    if (depth_mm <= 0.0) return;
    const double merit_mm = depth_mm - kToMiddle * grid.spacing_mm * glm::length(glm::dvec3(ijk) - centroid);
    if (merit_mm <= best_mm) return;
    best_mm = merit_mm;
    piece.ball_mm = depth_mm;
    piece.middle_mm = grid.centre_P_mm(ijk);
  });
  piece.coarse = surfacePoints(piece.field, piece.middle_mm, kCoarse_mm);
  piece.fine = surfacePoints(piece.field, piece.middle_mm, kFine_mm);
  if (stop.stop_requested()) return std::nullopt;
  for (const glm::vec3& p_mm : piece.fine.at_mm)
    piece.reach_mm = std::max(piece.reach_mm, static_cast<double>(glm::length(p_mm)));
  const int lattice = static_cast<int>(piece.reach_mm / kShell_mm) + 1;
  assets::forVoxels(glm::ivec3(-lattice), glm::ivec3(lattice + 1), [&](glm::ivec3 at) {
    const glm::vec3 p_mm = static_cast<float>(kShell_mm) * glm::vec3(at);
    const double depth_mm = -piece.distance_mm(p_mm);
    if (depth_mm > kPlay_mm && depth_mm < kPlay_mm + kShellDepth_mm) piece.shell_mm.push_back(p_mm);
  });
  return piece;
}

/// What stands around it.
struct Surroundings {
  SolidVoxels volume;
  DistanceField field;

  bool isSolid(const glm::vec3& index) const {
    const glm::vec3 up = index + 1.5F;
    const glm::ivec3 ijk = glm::ivec3(glm::max(up, glm::vec3(0.0F))) - 1;
    return volume.grid.contains(ijk) && volume.solid[volume.grid.index(ijk)] >= assets::kHalfSolid;
  }
};

struct Step {
  double length_mm, turn_rad;
};

Placement pushed(const Placement& placement, const Vector6& by) {
  return placement.moved({by[0], by[1], by[2]}, {by[3], by[4], by[5]});
}

/// Shortened so that no component exceeds `most`.
Vector6 limited(Vector6 by, const Step& most) {
  double excess = 1.0;
  for (std::size_t n = 0; n < 6; ++n)
    excess = std::max(excess, std::abs(by[n]) / (n < 3 ? most.length_mm : most.turn_rad));
  for (double& component : by) component /= excess;
  return by;
}

class Search {
 public:
  Search(const SearchedPiece& piece, const Surroundings& around, const WayOutGoal& goal)
      : piece_(piece), around_(around), goal_(goal) {
    const bool is_long = piece.reach_mm > kLong_mm;
    step_ = {is_long ? 0.4 : 0.5, is_long ? 0.05 : 0.06};
  }

  std::size_t poses() const { return poses_; }

  /// From where it lies to the goal; empty: not within so many poses.
  std::vector<Placement> way(const WayBound& rest, double graze_price, std::size_t most_poses,
                             const std::stop_token& stop) {
    rest_ = &rest;
    nodes_.clear();
    best_.clear();
    open_ = {};
    const Placement start{piece_.middle_mm, {1.0, 0.0, 0.0, 0.0}};
    add({start, kNone, 0.0, overlap_mm3(piece_.coarse, start, around_.field, kPlay_mm)}, 0.0);
    for (std::size_t expanded = 0; expanded < most_poses && !open_.empty() && !stop.stop_requested();) {
      const std::size_t from = open_.top().second;
      open_.pop();
      if (!settle(from)) continue;
      const Node node = nodes_[from];
      ++expanded, ++poses_;
      if (along_mm(node.placement) >= goal_.distance_mm) return wayTo(from);
      for (int move = 0; move < 12; ++move) expand(node, from, move, graze_price);
    }
    return {};
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  struct Node {
    Placement placement;
    std::size_t from;
    double cost;            ///< without what is newly cut, until that is known
    double met_mm3;         ///< of the coarse surface
    bool is_known = false;  ///< what is newly cut
  };

  double along_mm(const Placement& placement) const {
    return glm::dot(placement.at_mm - piece_.middle_mm, goal_.direction);
  }

  /// Poses of the same cell of 0.8 moves are one.
  std::uint64_t keyOf(const Placement& placement) const {
    const glm::dquat& q = placement.rotation;
    const glm::dvec3 turn_rad = (q.w < 0.0 ? -2.0 : 2.0) * glm::dvec3(q.x, q.y, q.z);
    const glm::dvec3 cell = (placement.at_mm - piece_.middle_mm) / (0.8 * step_.length_mm);
    const glm::dvec3 turn = turn_rad / (0.8 * step_.turn_rad);
    std::uint64_t key = 0;
    for (const double value : {cell.x, cell.y, cell.z, turn.x, turn.y, turn.z})
      key = key << 10 | (static_cast<std::uint64_t>(std::lround(value) + 512) & 1023);
    return key;
  }

  void add(const Node& node, double dearer) {
    open_.emplace(node.cost + dearer + rest_->at(node.placement.at_mm), nodes_.size());
    nodes_.push_back(node);
  }

  void addKnown(Node next, const Placement& before) {
    const auto known = best_.try_emplace(keyOf(next.placement), std::numeric_limits<double>::infinity()).first;
    if (known->second <= next.cost) return;
    if (next.met_mm3 > 0.0) next.cost += kSolidPrice * newlyCut_mm3(next.placement, before);
    if (known->second <= next.cost) return;
    known->second = next.cost;
    next.is_known = true;
    add(next, 0.0);
  }

  /// What is newly cut costs most to find, so it is looked for in a pose that is next. True: it still is.
  bool settle(std::size_t index) {
    Node& node = nodes_[index];
    const auto known = best_.try_emplace(keyOf(node.placement), std::numeric_limits<double>::infinity()).first;
    if (node.is_known) return node.cost <= known->second;
    if (node.cost >= known->second) return false;
    if (node.met_mm3 > 0.0 && node.from != kNone)
      node.cost += kSolidPrice * newlyCut_mm3(node.placement, nodes_[node.from].placement);
    node.is_known = true;
    if (node.cost >= known->second) return false;
    known->second = node.cost;
    const double in_all = node.cost + rest_->at(node.placement.at_mm);
    if (open_.empty() || in_all <= open_.top().first) return true;
    open_.emplace(in_all, index);
    return false;
  }

  void expand(const Node& node, std::size_t index, int move, double graze_price) {
    glm::dvec3 by_mm(0.0), turn_rad(0.0);
    const double sign = move % 2 == 0 ? 1.0 : -1.0;
    if (move < 6)
      by_mm[move / 2] = sign * step_.length_mm;
    else
      turn_rad[move / 2 - 3] = sign * step_.turn_rad;
    Node next{node.placement.moved(by_mm, turn_rad), index, node.cost, 0.0};
    const double length_mm =
        glm::length(next.placement.at_mm - node.placement.at_mm) + (move < 6 ? 0.0 : 0.3 * step_.length_mm);
    const auto known = best_.find(keyOf(next.placement));
    if (known != best_.end() && known->second <= node.cost + length_mm) return;
    next.met_mm3 = overlap_mm3(piece_.coarse, next.placement, around_.field, kPlay_mm);
    next.cost += length_mm * (1.0 + graze_price * next.met_mm3);
    if (goal_.is_roomy) return addKnown(next, node.placement);
    add(next, kSolidPrice * std::max(0.0, next.met_mm3 - node.met_mm3));
  }

  /// Solid that the piece holds now and did not hold one pose before: paid once.
  double newlyCut_mm3(const Placement& now, const Placement& before) const {
    const assets::VolumeGrid& grid = around_.volume.grid;
    const float per_mm = static_cast<float>(1.0 / grid.spacing_mm);
    const glm::mat3 R(glm::mat3_cast(now.rotation));
    const glm::mat3 back(glm::mat3_cast(glm::conjugate(before.rotation) * now.rotation));
    const glm::vec3 origin(grid.indexFromPoint(now.at_mm));
    const glm::vec3 shift_mm(glm::conjugate(before.rotation) * (now.at_mm - before.at_mm));
    std::size_t cut = 0;
    for (const glm::vec3& p_mm : piece_.shell_mm)
      if (around_.isSolid(origin + per_mm * (R * p_mm)) && piece_.distance_mm(back * p_mm + shift_mm) >= -kPlay_mm)
        ++cut;
    return static_cast<double>(cut) * kShell_mm * kShell_mm * kShell_mm;
  }

  std::vector<Placement> wayTo(std::size_t index) const {
    std::vector<Placement> way;
    for (; index != kNone; index = nodes_[index].from) way.push_back(nodes_[index].placement);
    std::ranges::reverse(way);
    return way;
  }

  const SearchedPiece& piece_;
  const Surroundings& around_;
  const WayBound* rest_ = nullptr;
  WayOutGoal goal_;
  Step step_{};
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, double> best_;
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  std::size_t poses_ = 0;
};

/// To where it overlaps least, kSettle_mm away at most.
Placement settled(const Placement& start, const SearchedPiece& piece, const Surroundings& around) {
  Placement now = start;
  Overlap overlap = overlapOf(piece.fine, now, around.field, kPlay_mm);
  for (int n = 0; n < 8 && overlap.volume_mm3 > 1e-4; ++n) {
    const Placement next = pushed(now, limited(pushOut(overlap, 0.02), {0.15, 0.02}));
    const glm::dvec3 moved_mm = glm::abs(next.at_mm - start.at_mm);
    if (std::max({moved_mm.x, moved_mm.y, moved_mm.z}) > kSettle_mm) break;
    const Overlap less = overlapOf(piece.fine, next, around.field, kPlay_mm);
    if (less.volume_mm3 >= overlap.volume_mm3) break;
    now = next;
    overlap = less;
  }
  return now;
}

/// Solid voxels deeper than kPlay_mm in the piece at any pose of the way.
std::vector<std::size_t> sweptBy(const std::vector<Placement>& way, const SearchedPiece& piece,
                                 const Surroundings& around, const std::stop_token& stop) {
  const assets::VolumeGrid& grid = around.volume.grid;
  std::vector<std::uint8_t> is_swept(grid.voxelCount(), 0);
  for (const Placement& at : way) {
    if (stop.stop_requested()) return {};
    if (overlap_mm3(piece.fine, at, around.field, kPlay_mm) <= 0.0) continue;
    const glm::mat3 back(glm::mat3_cast(glm::conjugate(at.rotation)));
    const glm::dvec3 middle = grid.indexFromPoint(at.at_mm);
    const double reach = piece.reach_mm / grid.spacing_mm;
    const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(middle - reach)), glm::ivec3(0));
    const glm::ivec3 end = glm::min(glm::ivec3(glm::ceil(middle + reach)) + 1, grid.size);
    assets::forVoxels(low, end, [&](glm::ivec3 ijk) {
      const std::size_t v = grid.index(ijk);
      if (around.volume.solid[v] < assets::kHalfSolid || is_swept[v] != 0) return;
      if (piece.distance_mm(back * glm::vec3(grid.centre_P_mm(ijk) - at.at_mm)) < -kPlay_mm) is_swept[v] = 1;
    });
  }
  std::vector<std::size_t> swept;
  for (std::size_t v = 0; v < is_swept.size(); ++v)
    if (is_swept[v] != 0) swept.push_back(v);
  return swept;
}

WayOut wayOutAlong(const std::vector<Placement>& way, const SearchedPiece& piece, const Surroundings& around,
                   const std::stop_token& stop) {
  WayOut out;
  std::vector<Placement> tight = way;
  for (Placement& at : tight)
    if (!stop.stop_requested()) at = settled(at, piece, around);
  for (std::size_t n = 0; n < tight.size(); ++n) {
    const Placement& at = tight[n];
    if (n > 0) out.length_mm += glm::length(at.at_mm - tight[n - 1].at_mm);
    const glm::dvec3 sine(at.rotation.x, at.rotation.y, at.rotation.z);
    out.turned_rad = std::max(out.turned_rad, 2.0 * std::atan2(glm::length(sine), std::abs(at.rotation.w)));
    out.path_X_PQ.push_back({at.rotation, at.at_mm - at.rotation * piece.middle_mm});
  }
  out.in_the_way = sweptBy(tight, piece, around, stop);
  out.in_the_way_mm3 = static_cast<double>(out.in_the_way.size()) * around.volume.grid.voxelVolume_mm3();
  out.answer = out.in_the_way_mm3 < kGrazes_mm3    ? WayOutAnswer::free
               : out.in_the_way_mm3 < kBlocked_mm3 ? WayOutAnswer::grazes
                                                   : WayOutAnswer::blocked;
  return out;
}

/// Without a turn, in the direction of a cone around the goal's in which least is met: there always is one.
std::vector<Placement> straightWay(const SearchedPiece& piece, const Surroundings& around, const WayOutGoal& goal) {
  const glm::dvec3 aside =
      glm::normalize(std::abs(goal.direction.x) < 0.7 ? glm::cross(goal.direction, glm::dvec3(1.0, 0.0, 0.0))
                                                      : glm::cross(goal.direction, glm::dvec3(0.0, 1.0, 0.0)));
  const glm::dvec3 across = glm::cross(goal.direction, aside);
  std::vector<Placement> best;
  double least_mm3 = 0.0;
  for (int ring = 0; ring < 4; ++ring)
    for (int n = 0; n < (ring == 0 ? 1 : 12); ++n) {
      const double tilt = 0.25 * ring, angle = n * std::numbers::pi / 6.0;
      const glm::dvec3 step = goal.direction + tilt * (std::cos(angle) * aside + std::sin(angle) * across);
      std::vector<Placement> way;
      double met_mm3 = 0.0;
      for (double along_mm = 0.0; along_mm < goal.distance_mm + kStraight_mm; along_mm += kStraight_mm) {
        way.push_back({piece.middle_mm + along_mm * step, {1.0, 0.0, 0.0, 0.0}});
        met_mm3 += overlap_mm3(piece.coarse, way.back(), around.field, kPlay_mm);
      }
      if (!best.empty() && met_mm3 >= least_mm3) continue;
      best = std::move(way);
      least_mm3 = met_mm3;
    }
  return best;
}

}  // namespace

WayOut findWayOut(const SolidVoxels& obstacles, const SolidVoxels& volume, const WayOutGoal& goal,
                  const std::stop_token& stop) {
  assert(obstacles.solid.size() == obstacles.grid.voxelCount() && volume.solid.size() == volume.grid.voxelCount());
  const std::optional<SearchedPiece> piece = searchedPiece(volume, stop);
  if (!piece || stop.stop_requested()) return {};
  const Surroundings around{obstacles, {obstacles.grid, obstacles.solid, std::max(1.5, piece->ball_mm + 0.5), stop}};
  if (stop.stop_requested()) return {};
  WayOut best;
  const auto keep = [&](const std::vector<Placement>& way) {
    if (way.empty() || stop.stop_requested()) return;
    WayOut found = wayOutAlong(way, *piece, around, stop);
    if (best.answer == WayOutAnswer::not_found || found.in_the_way.size() < best.in_the_way.size())
      best = std::move(found);
  };
  keep(straightWay(*piece, around, goal));
  if (stop.stop_requested()) return {};
  if (best.answer == WayOutAnswer::free) return best;

  const auto bound = [&](double per_mm) {
    return WayBound(around.field, {piece->middle_mm, piece->ball_mm}, goal.direction, goal.distance_mm, per_mm,
                    kSolidEagerness * kSolidPrice, stop);
  };
  const WayBound patient = bound(3.0);
  if (stop.stop_requested()) return {};
  const WayBound eager = bound(8.0);
  Search search(*piece, around, goal);
  // A price of grazing keeps it off the walls but makes it wander; the least that is cut wins. Those that find a way at
  // once cost next to nothing.
  struct Attempt {
    const WayBound& rest;
    double graze_price;
  };
  for (const Attempt& attempt :
       {Attempt{patient, 0.0}, Attempt{eager, 1.0}, Attempt{eager, 4.0}, Attempt{patient, 1.0}, Attempt{patient, 4.0}})
    if (best.answer != WayOutAnswer::free && search.poses() < kPosesInAll)
      keep(search.way(attempt.rest, attempt.graze_price, kPoses, stop));
  if (stop.stop_requested()) return {};
  best.poses = search.poses();
  return best;
}

}  // namespace haptics
