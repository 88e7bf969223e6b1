#include "calibration/fit/touch_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

constexpr std::size_t kFewestTouches = 4;
constexpr double kSameAngle_rad = 1e-7;
constexpr double kNarrow_mm = 3.0;  ///< a line of targets is no broader, root mean square
constexpr std::size_t kDirections = 400;

[[noreturn]] void refuseTouches(const std::string& what) { throw CalibrationError("touches: " + what); }

bool sameAngles(const RawJoints& a, const RawJoints& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > kSameAngle_rad) return false;
  return true;
}

void checkTwice(const std::vector<const Touch*>& touches) {
  std::vector<const Touch*> sorted = touches;
  std::ranges::stable_sort(sorted, {}, [](const Touch* touch) { return touch->joints_rad; });
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sameAngles(sorted[i - 1]->joints_rad, sorted[i]->joints_rad))
      refuseTouches("touch " + std::to_string(sorted[i]->id) + " is touch " + std::to_string(sorted[i - 1]->id) +
                    " again, with the same joint angles, remove one or touch anew");
}

/// A triangle of the hull, seen from outside counter-clockwise.
struct Facet {
  std::array<std::size_t, 3> corner;
  glm::dvec3 normal;  ///< unit
  double offset_mm;
};

class Hull {
 public:
  explicit Hull(std::vector<glm::dvec3> places) : places_(std::move(places)) {}

  /// False: they lie in a plane.
  bool begin() {
    const auto farthest = [&](auto&& distance) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < places_.size(); ++i)
        if (distance(places_[i]) > distance(places_[best])) best = i;
      return best;
    };
    const std::size_t a = farthest([&](const glm::dvec3& p) { return glm::distance(p, places_[0]); });
    const std::size_t b = farthest([&](const glm::dvec3& p) { return glm::distance(p, places_[a]); });
    const glm::dvec3 line = places_[b] - places_[a];
    const std::size_t c = farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(p - places_[a], line)); });
    const glm::dvec3 across = glm::cross(line, places_[c] - places_[a]);
    const std::size_t d = farthest([&](const glm::dvec3& p) { return std::abs(glm::dot(p - places_[a], across)); });
    if (glm::length(across) < 1e-3 || std::abs(glm::dot(places_[d] - places_[a], across)) < 0.1 * glm::length(across))
      return false;
    middle_ = 0.25 * (places_[a] + places_[b] + places_[c] + places_[d]);
    for (const auto& corner : {std::array{a, b, c}, std::array{a, b, d}, std::array{a, c, d}, std::array{b, c, d}})
      facets_.push_back(outward(corner));
    return true;
  }

  /// What sees the place goes; the rim it leaves is joined to the place.
  void add(std::size_t place) {
    std::vector<Facet> hidden, seen;
    for (const Facet& facet : facets_)
      (glm::dot(facet.normal, places_[place]) > facet.offset_mm + 1e-9 ? seen : hidden).push_back(facet);
    if (seen.empty()) return;
    std::vector<std::array<std::size_t, 2>> rim;
    for (const Facet& facet : seen)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = facet.corner[k], to = facet.corner[(k + 1) % 3];
        const auto back = std::ranges::find(rim, std::array{to, from});
        if (back != rim.end())
          rim.erase(back);
        else
          rim.push_back({from, to});
      }
    facets_ = std::move(hidden);
    for (const auto& edge : rim) facets_.push_back(outward({edge[0], edge[1], place}));
  }

  double volume_mm3() const {
    double six = 0.0;
    for (const Facet& facet : facets_) {
      const glm::dvec3 a = places_[facet.corner[0]] - middle_, b = places_[facet.corner[1]] - middle_,
                       c = places_[facet.corner[2]] - middle_;
      six += std::abs(glm::dot(a, glm::cross(b, c)));
    }
    return six / 6.0;
  }

 private:
  Facet outward(std::array<std::size_t, 3> corner) const {
    const glm::dvec3& a = places_[corner[0]];
    glm::dvec3 normal = glm::normalize(glm::cross(places_[corner[1]] - a, places_[corner[2]] - a));
    if (glm::dot(normal, middle_ - a) > 0.0) {
      normal = -normal;
      std::swap(corner[1], corner[2]);
    }
    return {corner, normal, glm::dot(normal, a)};
  }

  std::vector<glm::dvec3> places_;
  glm::dvec3 middle_{0.0};
  std::vector<Facet> facets_;
};

}  // namespace

void checkTouches(const TouchSet& set) {
  if (!findPhantomModel(set.device_model))
    refuseTouches("device model '" + set.device_model + "' is not known, correct it");
  std::vector<const Touch*> used;
  std::vector<glm::dvec3> places;
  for (const Touch& touch : set.touches) {
    double sum = touch.target_W.mm.x + touch.target_W.mm.y + touch.target_W.mm.z;
    for (const double angle_rad : touch.joints_rad) sum += angle_rad;
    if (!std::isfinite(sum))
      refuseTouches("touch " + std::to_string(touch.id) + " holds a number that is none, touch it again");
    if (!touch.used) continue;
    used.push_back(&touch);
    places.push_back(touch.target_W.mm);
  }
  if (!(set.precision.in_plane_mm >= 0.0) || !(set.precision.along_sight_mm >= 0.0) ||
      !std::isfinite(set.precision.in_plane_mm + set.precision.along_sight_mm))
    refuseTouches("their precision is none, give one sigma in mm");
  if (used.size() < kFewestTouches)
    refuseTouches(std::to_string(used.size()) +
                  " are used, at least 4 are needed, touch more (16 for a good calibration)");
  checkTwice(used);
  const Extent extent = extentOf(places);
  if (extent.spread_mm[0] < kNarrow_mm)
    refuseTouches("all targets are in one place, touch targets that are spread out");
  if (extent.spread_mm[1] < kNarrow_mm) refuseTouches("all targets lie on a line, touch some to the sides of it");
}

void checkUnseen(const TouchSet& fitted, const TouchSet& proof) {
  const auto must_agree = [](const std::string& what, const std::string& a, const std::string& b) {
    if (!a.empty() && !b.empty() && a != b)
      refuseTouches("they were made with " + what + " '" + a + "', those to prove them by with '" + b +
                    "', give touches of one device");
  };
  must_agree("device model", fitted.device_model, proof.device_model);
  must_agree("serial", fitted.serial, proof.serial);
  must_agree("mount", fitted.mount, proof.mount);
  for (const Touch& one : proof.touches)
    for (const Touch& seen : fitted.touches)
      if (one.used && seen.used && sameAngles(one.joints_rad, seen.joints_rad))
        refuseTouches("touch " + std::to_string(one.id) + " of the proof is touch " + std::to_string(seen.id) +
                      " of the fit, which proves nothing, touch other places");
}

double pairSpread_deg(const std::vector<glm::dvec3>& directions) {
  std::vector<double> angles;
  for (std::size_t a = 0; a < directions.size(); ++a)
    for (std::size_t b = a + 1; b < directions.size(); ++b)
      angles.push_back(std::acos(std::clamp(glm::dot(directions[a], directions[b]), -1.0, 1.0)));
  if (angles.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(angles.size() - 1));
  std::nth_element(angles.begin(), angles.begin() + at, angles.end());
  return degreesFromRad(angles[static_cast<std::size_t>(at)]);
}

double tiltSpread_deg(const PhantomGeometry& geometry, const std::vector<Touch>& touches,
                      std::span<const std::size_t> which) {
  std::vector<glm::dvec3> in_room, against_forearm;
  const std::size_t stride = which.size() / kDirections + 1;
  for (std::size_t i = 0; i < which.size(); i += stride) {
    const RawJoints& raw = touches[which[i]].joints_rad;
    in_room.push_back(handlePose(geometry, ArmCorrection{}, raw).rotation * glm::dvec3(0.0, 0.0, 1.0));
    const RawJoints gimbal_alone{0.0, 0.0, 0.0, raw[3], raw[4], raw[5]};
    against_forearm.push_back(handlePose(geometry, ArmCorrection{}, gimbal_alone).rotation * glm::dvec3(0.0, 0.0, 1.0));
  }
  return std::min(pairSpread_deg(in_room), pairSpread_deg(against_forearm));
}

double hullVolume_mm3(const std::vector<glm::dvec3>& places_mm) {
  if (places_mm.size() < kFewestTouches) return 0.0;
  // Grids have four and more in a plane: a hundred-thousandth of a millimetre aside, none has.
  std::mt19937 chance(5);
  std::vector<glm::dvec3> aside = places_mm;
  for (glm::dvec3& p : aside)
    for (int c = 0; c < 3; ++c) p[c] += 1e-5 * (static_cast<double>(chance()) / 4294967296.0 - 0.5);
  Hull hull(aside);
  if (!hull.begin()) return 0.0;
  for (std::size_t i = 0; i < aside.size(); ++i) hull.add(i);
  return hull.volume_mm3();
}

Extent extentOf(const std::vector<glm::dvec3>& places_mm) {
  Extent extent;
  if (places_mm.empty()) return extent;
  const double share = 1.0 / static_cast<double>(places_mm.size());
  for (const glm::dvec3& p : places_mm) extent.middle_mm += share * p;
  cv::Matx33d about_middle = cv::Matx33d::zeros();
  for (const glm::dvec3& p : places_mm)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) about_middle(r, c) += share * (p - extent.middle_mm)[r] * (p - extent.middle_mm)[c];
  cv::Matx31d values;
  cv::Matx33d vectors;
  cv::eigen(about_middle, values, vectors);
  for (int k = 0; k < 3; ++k) {
    extent.spread_mm[k] = std::sqrt(std::max(0.0, values(k)));
    extent.axes[k] = {vectors(k, 0), vectors(k, 1), vectors(k, 2)};
  }
  return extent;
}

}  // namespace calibration
