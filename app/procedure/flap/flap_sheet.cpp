#include "app/procedure/flap/flap_sheet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "calibration/geometry/segment.h"

namespace app {
namespace {

constexpr int kSubsteps = 10;
// Inertia is not the flap's (0.5 mg a vertex) but eight times what a spring moves in a substep: then forces are those
// of springs, not of masses, after one pass. Wet tissue swings little and sinks back slowly.
constexpr double kInverseMass = 0.125 / (FlapSheet::kE_N_per_mm2 * FlapSheet::kMembrane_mm * 1e-6);
constexpr double kSinks_mm_per_s2 = 60.0;
constexpr double kKept = 0.995;  // of the speed, each substep
constexpr double kFastest_mm_per_s = 200.0;
constexpr double kStill_mm = 0.004;  // in a frame: the sheet has come to rest
constexpr int kStillFrames = 20;
constexpr double kFelt = 0.1;                           // of the newest frame in the force that is told
constexpr double kFolds = 0.05;                         // of the membrane's stiffness
constexpr double kAboveBone_mm = 0.6;                   // half of the gum's thickness
constexpr double kDeepest_mm = 3.0, kPushed_mm = 0.15;  // in bone, and out of it in a substep
constexpr int kHeldColumns = 21;                        // 12 mm, the width of a Minnesota retractor
constexpr double kTie_mm_per_N = 14.0;                  // of each vertex that lies on it

}  // namespace

FlapSheet::FlapSheet(int columns, int rows, std::vector<SheetVertex> vertices)
    : columns_(columns), rows_(rows), vertices_(std::move(vertices)), before_(vertices_.size()) {
  for (SheetVertex& v : vertices_) v.at_P_mm = v.home_P_mm, v.velocity_P_mm_per_s = glm::dvec3(0.0);
  addSprings();
}

void FlapSheet::addSpring(std::size_t a, std::size_t b, double N_per_mm, bool only_pushes) {
  const double rest_mm = glm::distance(vertices_[a].home_P_mm, vertices_[b].home_P_mm);
  springs_.push_back({a, b, rest_mm, 1.0 / N_per_mm, only_pushes});
}

void FlapSheet::addSprings() {
  const auto home = [&](int c, int r) {
    return vertices_[index(std::clamp(c, 0, columns_ - 1), std::clamp(r, 0, rows_ - 1))].home_P_mm;
  };
  const auto along_mm = [&](int c, int r) { return std::max(0.05, glm::distance(home(c, r), home(c + 1, r))); };
  const auto across_mm = [&](int c, int r) { return std::max(0.05, glm::distance(home(c, r), home(c, r + 1))); };
  constexpr double kMembrane = 0.75 * kE_N_per_mm2 * kMembrane_mm;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c) {
      // Half of the cells on either side of an edge; a border has one.
      const double wide_mm = 0.5 * ((r > 0 ? across_mm(c, r - 1) : 0.0) + (r + 1 < rows_ ? across_mm(c, r) : 0.0));
      const double long_mm = 0.5 * ((c > 0 ? along_mm(c - 1, r) : 0.0) + (c + 1 < columns_ ? along_mm(c, r) : 0.0));
      vertices_[index(c, r)].inverse_mass = kInverseMass;
      if (c + 1 < columns_) addSpring(index(c, r), index(c + 1, r), kMembrane * wide_mm / along_mm(c, r));
      if (r + 1 < rows_) addSpring(index(c, r), index(c, r + 1), kMembrane * long_mm / across_mm(c, r));
      if (c + 1 < columns_ && r + 1 < rows_) {
        addSpring(index(c, r), index(c + 1, r + 1), 0.5 * kMembrane);
        addSpring(index(c + 1, r), index(c, r + 1), 0.5 * kMembrane);
      }
      if (c + 2 < columns_) addSpring(index(c, r), index(c + 2, r), kFolds * kMembrane, true);
      if (r + 2 < rows_) addSpring(index(c, r), index(c, r + 2), kFolds * kMembrane, true);
    }
}

void FlapSheet::step(const Load& load) {
  if (load.elevator != nullptr) still_frames_ = 0;
  if (!any_free_ || still_frames_ >= kStillFrames) return;
  std::vector<glm::dvec3> from;
  for (const SheetVertex& v : vertices_) from.push_back(v.at_P_mm);
  held_sum_N_ = glm::dvec3(0.0);
  double held_N = 0.0;
  for (int n = 0; n < kSubsteps; ++n) {
    substep(load, kFrame_s / kSubsteps);
    held_N += glm::length(held_sum_N_) / kSubsteps;
  }
  bool moved = false;
  for (std::size_t n = 0; n < from.size(); ++n)
    moved = moved || glm::distance(from[n], vertices_[n].at_P_mm) > kStill_mm;
  still_frames_ = moved ? 0 : still_frames_ + 1;
  held_N_ = isHeld() ? held_N_ + kFelt * (held_N - held_N_) : 0.0;
}

void FlapSheet::substep(const Load& load, double h_s) {
  int edge = 0;
  for (int c = 0; c < columns_; ++c) edge += vertices_[index(c, 0)].isFree() ? 1 : 0;
  for (std::size_t n = 0; n < vertices_.size(); ++n) {
    SheetVertex& v = vertices_[n];
    before_[n] = v.at_P_mm;
    if (!v.isFree()) continue;
    v.velocity_P_mm_per_s = kKept * (v.velocity_P_mm_per_s + kSinks_mm_per_s2 * h_s * load.down_P);
    if (n < static_cast<std::size_t>(columns_) && edge > 0)
      v.velocity_P_mm_per_s += h_s * v.inverse_mass / edge * load.pull_P_N;
    const double speed = glm::length(v.velocity_P_mm_per_s);
    if (speed > kFastest_mm_per_s) v.velocity_P_mm_per_s *= kFastest_mm_per_s / speed;
    v.at_P_mm += h_s * v.velocity_P_mm_per_s;
  }
  relax(h_s);
  keepOff(load);
  for (std::size_t n = 0; n < vertices_.size(); ++n)
    if (vertices_[n].isFree()) vertices_[n].velocity_P_mm_per_s = (vertices_[n].at_P_mm - before_[n]) / h_s;
}

void FlapSheet::relax(double h_s) {
  for (const Spring& spring : springs_) {
    SheetVertex &a = vertices_[spring.a], &b = vertices_[spring.b];
    const double wa = a.isFree() ? a.inverse_mass : 0.0, wb = b.isFree() ? b.inverse_mass : 0.0;
    if (wa + wb == 0.0 || a.is_torn || b.is_torn) continue;
    const glm::dvec3 d = a.at_P_mm - b.at_P_mm;
    const double length_mm = glm::length(d), off_mm = length_mm - spring.rest_mm;
    if (!(length_mm > 1e-9) || (spring.only_pushes && off_mm >= 0.0)) continue;
    const double lambda = -off_mm / (wa + wb + spring.compliance_mm_per_N / (h_s * h_s));
    a.at_P_mm += wa * lambda / length_mm * d;
    b.at_P_mm -= wb * lambda / length_mm * d;
  }
  // Ties last: their multipliers over h² are the force on the retractor.
  held_sum_N_ = glm::dvec3(0.0);
  for (const Tie& tie : ties_) {
    SheetVertex& v = vertices_[tie.vertex];
    if (!v.isFree()) continue;
    const glm::dvec3 lambda = (tie.goal_P_mm - v.at_P_mm) / (v.inverse_mass + kTie_mm_per_N / (h_s * h_s));
    v.at_P_mm += v.inverse_mass * lambda;
    held_sum_N_ += lambda / (h_s * h_s);
  }
}

/// Out of the elevator, then out of the bone.
void FlapSheet::keepOff(const Load& load) {
  for (SheetVertex& v : vertices_) {
    if (!v.isFree()) continue;
    if (load.elevator != nullptr) {
      const glm::dvec3 off = v.at_P_mm - load.elevator->tip_P_mm;
      const double along_mm = std::clamp(glm::dot(off, load.elevator->shaft_P), 0.0, load.elevator->length_mm);
      const glm::dvec3 away = off - along_mm * load.elevator->shaft_P;
      const double mm = glm::length(away);
      if (mm < kElevator_mm) v.at_P_mm += (kElevator_mm - mm) * (mm > 1e-6 ? away / mm : v.normal_P);
    }
    const Ground ground = load.ground(v.at_P_mm);
    // Gently, and not across a tooth that stands beside it.
    const double missing_mm = kAboveBone_mm - ground.above_mm;
    if (missing_mm > 0.0 && missing_mm < kDeepest_mm) v.at_P_mm += std::min(missing_mm, kPushed_mm) * ground.out_P;
  }
}

int FlapSheet::peel(const glm::dvec3& tip_P_mm) {
  std::vector<std::size_t> ready;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c) {
      const SheetVertex& v = vertices_[index(c, r)];
      if (v.is_attached || v.stuck <= 0.0) continue;
      // The tip works somewhere between gum and bone.
      if (calibration::distanceToSegment(tip_P_mm, v.home_P_mm, v.bone_P_mm) > kPeel_mm) continue;
      bool is_next = v.is_cut;
      for (int step = 0; step < 9 && !is_next; ++step) {
        const int nc = c + step % 3 - 1, nr = r + step / 3 - 1;
        is_next = nc >= 0 && nr >= 0 && nc < columns_ && nr < rows_ && vertices_[index(nc, nr)].isFree();
      }
      if (is_next) ready.push_back(index(c, r));
    }
  int freed = 0;
  for (const std::size_t n : ready) {
    vertices_[n].stuck -= kFrame_s / kPeel_s;
    freed += vertices_[n].stuck <= 0.0 ? 1 : 0;
  }
  any_free_ = any_free_ || freed > 0;
  if (freed > 0) still_frames_ = 0;
  return freed;
}

bool FlapSheet::isOpenAt(const glm::dvec3& tip_P_mm) const {
  constexpr double kOpen_mm = kPeel_mm + 1.0;
  return std::ranges::any_of(vertices_, [&](const SheetVertex& v) {
    return (v.is_cut || v.isFree()) && calibration::distanceToSegment(tip_P_mm, v.home_P_mm, v.bone_P_mm) < kOpen_mm;
  });
}

bool FlapSheet::hold() {
  ties_.clear();
  still_frames_ = 0;
  int first = -1, last = -1;
  for (int c = 0; c < columns_; ++c)
    if (vertices_[index(c, 0)].isFree()) first = first < 0 ? c : first, last = c;
  if (first < 0) return false;
  const int middle = (first + last) / 2;
  for (int c = std::max(first, middle - kHeldColumns / 2); c <= std::min(last, middle + kHeldColumns / 2); ++c)
    for (int r = 0; r + 1 < rows_; ++r)
      if (const SheetVertex& v = vertices_[index(c, r)]; v.isFree())
        ties_.push_back({index(c, r), v.at_P_mm - v.home_P_mm, v.at_P_mm, v.at_P_mm});
  return !ties_.empty();
}

void FlapSheet::pull(double part, const std::function<glm::dvec3(std::size_t vertex)>& goal_P_mm,
                     const std::function<glm::dvec3(const glm::dvec3&)>& shift_mm) {
  glm::dvec3 middle(0.0);
  for (Tie& tie : ties_) middle += tie.goal_P_mm = goal_P_mm(tie.vertex) + (1.0 - part) * tie.off_mm;
  const glm::dvec3 by_mm = shift_mm(middle / static_cast<double>(std::max<std::size_t>(1, ties_.size())));
  for (Tie& tie : ties_) {
    tie.goal_P_mm += by_mm;
    if (glm::distance(tie.goal_P_mm, tie.before_P_mm) > 1e-4) still_frames_ = 0;
    tie.before_P_mm = tie.goal_P_mm;
  }
}

int FlapSheet::tear(const glm::dvec3& at_P_mm, double reach_mm) {
  int torn = 0;
  for (SheetVertex& v : vertices_) {
    if (v.is_torn || glm::distance(v.at_P_mm, at_P_mm) > reach_mm) continue;
    v.is_torn = true;
    ++torn;
  }
  if (torn > 0) still_frames_ = 0;
  return torn;
}

double FlapSheet::freeArea_mm2() const {
  double sum_mm2 = 0.0;
  for (int r = 0; r + 1 < rows_; ++r)
    for (int c = 0; c + 1 < columns_; ++c) {
      const SheetVertex &a = vertices_[index(c, r)], &b = vertices_[index(c + 1, r)], &d = vertices_[index(c, r + 1)];
      if (a.isFree()) sum_mm2 += glm::length(glm::cross(b.home_P_mm - a.home_P_mm, d.home_P_mm - a.home_P_mm));
    }
  return sum_mm2;
}

double FlapSheet::columnLength_mm(int column) const {
  double sum_mm = 0.0;
  for (int r = 0; r + 1 < rows_; ++r)
    sum_mm += glm::distance(vertices_[index(column, r)].home_P_mm, vertices_[index(column, r + 1)].home_P_mm);
  return sum_mm;
}

void FlapSheet::takeOver(const FlapSheet& former) {
  constexpr double kSame_mm = 0.7;
  for (SheetVertex& v : vertices_) {
    const auto nearest = std::ranges::min_element(
        former.vertices_, {}, [&](const SheetVertex& old) { return glm::distance(old.home_P_mm, v.home_P_mm); });
    if (nearest == former.vertices_.end() || glm::distance(nearest->home_P_mm, v.home_P_mm) > kSame_mm) continue;
    v.stuck = v.is_attached ? 1.0 : nearest->stuck;
    v.is_torn = nearest->is_torn;
    if (v.isFree()) v.at_P_mm = nearest->at_P_mm + v.home_P_mm - nearest->home_P_mm;
    any_free_ = any_free_ || v.isFree();
  }
}

double FlapSheet::worstStretch() const {
  double worst = 0.0;
  for (const Spring& spring : springs_) {
    const SheetVertex &a = vertices_[spring.a], &b = vertices_[spring.b];
    if (spring.only_pushes || a.is_torn || b.is_torn) continue;
    worst = std::max(worst, glm::distance(a.at_P_mm, b.at_P_mm) / spring.rest_mm - 1.0);
  }
  return worst;
}

std::uint64_t FlapSheet::digest() const {
  std::uint64_t digest = 0xcbf29ce484222325u;
  const auto add = [&](double value) { digest = (digest ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u; };
  for (const SheetVertex& v : vertices_) add(v.at_P_mm.x), add(v.at_P_mm.y), add(v.at_P_mm.z), add(v.stuck);
  return digest;
}

}  // namespace app
