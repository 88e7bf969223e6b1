// Volumetric sample points as published (Gajananan; Morris et al. 2006) against this program's heads, in one run: the
// same bone, the same burs, the same way over a square edge.
// Published: points a voxel apart inside the head; each looks into the nearest voxel and counts from half density;
// d = d0 u^(1/m), F = k rho d n, rho the mean density over 100 ticks, n by the rule of the shape.
// Time: CPU time of this thread for one look in contact, median; air costs nothing to ours and is left out. Roughness:
// largest change of the force over 5 um of way, and rms of its second difference, both of the largest force.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <string>
#include <vector>

#include "haptics/contact/law.h"
#include "tests/haptics/head_distance.h"
#include "tests/haptics/phantom.h"

namespace {

using namespace haptics;
using namespace haptics::phantom;
using assets::BurProfile;
using ToolPose = calibration::Pose<Patient, calibration::Tool>;

double threadTime_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

/// The published way.
class SamplePoints {
 public:
  SamplePoints(const BurShape& head, double spacing_mm) : head_(head) {
    const double half = halfHeight_mm(head), R = head.radius_mm;
    for (double z = -half + 0.5 * spacing_mm; z < half; z += spacing_mm)
      for (double y = -R + 0.5 * spacing_mm; y < R; y += spacing_mm)
        for (double x = -R + 0.5 * spacing_mm; x < R; x += spacing_mm)
          if (headDistance_mm(head, {{x, y, z}}) < 0.0) points_T_.emplace_back(x, y, z);
  }

  glm::dvec3 force(const SolidField& field, const ToolPose& X_PT) {
    glm::dvec3 sum(0.0);
    double count = 0.0, dense = 0.0;
    const double half = 0.5 * head_.length_mm, slant = std::hypot(head_.radius_mm, head_.length_mm);
    for (const glm::dvec3& p_T : points_T_) {
      const glm::ivec3 ijk(glm::round(field.grid.indexFromPoint(X_PT.rotation * p_T + X_PT.translation_mm)));
      if (!field.grid.contains(ijk)) continue;
      const double solid = field.solidAt(ijk);
      if (solid < 127.5) continue;
      count += 1.0, dense += solid / 255.0;
      glm::dvec3 out = p_T;
      if (head_.kind == ShapeKind::cylinder) out.z = 0.0;
      if (head_.kind == ShapeKind::capsule) out.z -= std::clamp(p_T.z, -half, half);
      if (head_.kind == ShapeKind::cone) {
        const double rho = std::max(1e-9, std::hypot(p_T.x, p_T.y));
        out = glm::dvec3(p_T.x / rho, p_T.y / rho, 0.0) * (head_.length_mm / slant);
        out.z = -head_.radius_mm / slant;
      }
      sum -= out;
    }
    if (count == 0.0) return {};
    density_.push_back(dense / count);
    if (density_.size() > 100) density_.pop_front();
    double mean = 0.0;
    for (const double one : density_) mean += one;
    mean /= static_cast<double>(density_.size());
    const double m = head_.kind == ShapeKind::sphere ? 2.0 : head_.kind == ShapeKind::cone ? 3.0 : 1.5;
    const double depth_mm = 2.0 * head_.radius_mm * std::pow(count / static_cast<double>(points_T_.size()), 1.0 / m);
    const double length = glm::length(sum);
    return length > 0.0 ? X_PT.rotation * (0.8 * mean * depth_mm / length * sum) : glm::dvec3(0.0);
  }

  std::size_t size() const { return points_T_.size(); }

 private:
  BurShape head_;
  std::vector<glm::dvec3> points_T_;
  std::deque<double> density_;
};

struct Figures {
  double us = 0.0, jump = 0.0, ripple = 0.0;
};

/// Along x, 0.3 mm deep, a cone 1 mm, whose tip else holds no point; from the middle of a block over its edge.
template <class Force>
Figures over(const BurShape& head, Force&& force) {
  const glm::dquat turn = glm::normalize(glm::dquat(1.0, 0.06, -0.03, 0.02));
  const glm::dvec3 axis = turn * glm::dvec3(0.0, 0.0, 1.0);
  const double deep_mm = head.kind == ShapeKind::cone ? 1.0 : 0.3;
  constexpr int kSteps = 700;
  std::vector<glm::dvec3> felt;
  std::vector<double> us;
  for (int n = 0; n < kSteps; ++n) {
    const ToolPose X_PT{turn, {0.2 + 0.005 * n, 0.013, 1.9 + reach_mm(head, -axis.z) - deep_mm}};
    const double began = threadTime_us();
    felt.push_back(force(X_PT));
    const double took = threadTime_us() - began;
    if (glm::length(felt.back()) > 0.0) us.push_back(took);
  }
  if (us.empty()) return {};
  Figures figures;
  double most = 0.0, sum2 = 0.0;
  for (const glm::dvec3& one : felt) most = std::max(most, glm::length(one));
  for (std::size_t n = 1; n + 1 < felt.size(); ++n) {
    figures.jump = std::max(figures.jump, glm::length(felt[n] - felt[n - 1]));
    const double second = glm::length(felt[n + 1] - 2.0 * felt[n] + felt[n - 1]);
    sum2 += second * second;
  }
  std::sort(us.begin(), us.end());
  figures.us = us[us.size() / 2];
  figures.jump /= most;
  figures.ripple = std::sqrt(sum2 / static_cast<double>(felt.size())) / most;
  return figures;
}

}  // namespace

int main() {
  const std::vector<std::pair<std::string, BurShape>> heads = {
      {"sphere", {ShapeKind::sphere, 0.8, 0.0}},
      {"cylinder", {ShapeKind::cylinder, 0.8, 4.0}},
      {"capsule", {ShapeKind::capsule, 0.8, 2.4}},
      {"cone", {ShapeKind::cone, 0.8, 4.0}},
      {"flame", {ShapeKind::revolved, 0.8, 4.0, BurProfile::flame}},
      {"torpedo", {ShapeKind::revolved, 0.8, 4.0, BurProfile::torpedo}},
      {"round-taper", {ShapeKind::revolved, 0.8, 4.0, BurProfile::round_taper}},
      {"pear", {ShapeKind::revolved, 0.8, 2.0, BurProfile::pear}},
      {"wheel", {ShapeKind::revolved, 1.5, 1.0, BurProfile::wheel}}};
  std::printf("one contact and the way over a square edge; published / ours: above 1 ours is better\n");
  std::printf("%-12s %4s %-16s %8s %8s %9s %9s %9s %9s %9s\n", "head", "s", "law", "points", "us", "jump %", "ripple %",
              "time", "jump", "ripple");
  for (const double s : {0.1, 0.05}) {
    const Phantom phantom = block(1.9, s);
    const SolidField field = phantom.field();
    for (const auto& [name, head] : heads) {
      SamplePoints published(head, s);
      const bool is_known = head.kind != ShapeKind::revolved;
      Figures theirs;
      if (is_known) {
        theirs = over(head, [&](const ToolPose& X_PT) { return published.force(field, X_PT); });
        std::printf("%-12s %4.2f %-16s %8zu %8.1f %9.3f %9.4f\n", name.c_str(), s, "published", published.size(),
                    theirs.us, 100.0 * theirs.jump, 100.0 * theirs.ripple);
      }
      for (const LawKind kind : {LawKind::points, LawKind::agus, LawKind::shell}) {
        LawSettings law;
        law.kind = kind;
        LawState state;
        const BurShape& one = head;
        const Figures ours = over(head, [&](const ToolPose& X_PT) {
          const ToolInBone at{field, one, X_PT, law.tissue, {}};
          const Contact contact = contactOf(law, at, state);
          updateLawState(law, at, contact, state);
          return contact.force_P_N.xyz;
        });
        std::printf("%-12s %4.2f %-16s %8s %8.1f %9.3f %9.4f", name.c_str(), s,
                    std::string(kLaws[static_cast<std::size_t>(kind)].key).c_str(), "", ours.us, 100.0 * ours.jump,
                    100.0 * ours.ripple);
        if (is_known)
          std::printf(" %9.2f %9.2f %9.2f", theirs.us / ours.us, theirs.jump / ours.jump, theirs.ripple / ours.ripple);
        std::printf("\n");
      }
    }
  }
  return 0;
}
