#include "calibration/fit/rigid_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <glm/gtc/type_ptr.hpp>

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t kOfFour = 4;
constexpr int kTries = 400;
constexpr std::size_t kAllAreTried = 12;  ///< points up to which all sets of four are tried
constexpr double kLimitGrowth = 1.5;
constexpr double kOnALine = 1e-3;  ///< relative to the longest extent

/// All sets of four, or the same four hundred random ones.
std::vector<std::array<std::size_t, kOfFour>> foursOf(std::size_t n) {
  std::vector<std::array<std::size_t, kOfFour>> fours;
  if (n <= kAllAreTried) {
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        for (std::size_t c = b + 1; c < n; ++c)
          for (std::size_t d = c + 1; d < n; ++d) fours.push_back({a, b, c, d});
    return fours;
  }
  std::mt19937 rng(11);
  for (int i = 0; i < kTries; ++i) {
    std::array<std::size_t, kOfFour> four{};
    for (std::size_t k = 0; k < kOfFour; ++k) do
        four[k] = rng() % n;
      while (std::find(four.begin(), four.begin() + static_cast<std::ptrdiff_t>(k), four[k]) !=
             four.begin() + static_cast<std::ptrdiff_t>(k));
    fours.push_back(four);
  }
  return fours;
}

class Agreement {
 public:
  Agreement(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to, Handedness handedness)
      : from_(from), to_(to), handedness_(handedness), fours_(foursOf(from.size())) {}

  /// The largest agreeing set; of two equally large ones the closer.
  RigidAgreement largest(double limit_mm) const {
    RigidAgreement best;
    for (const auto& four : fours_) {
      const auto rough = fit(four);
      if (!rough) continue;
      // A map of four points is rough far from them: accept twice the limit before refitting.
      RigidAgreement candidate;
      candidate.agreeing = within(*rough, 2.0 * limit_mm);
      if (candidate.agreeing.size() < std::max(kOfFour, best.agreeing.size())) continue;
      refit(candidate, limit_mm);
      if (candidate.agreeing.size() > best.agreeing.size() ||
          (candidate.agreeing.size() == best.agreeing.size() && candidate.rms_mm < best.rms_mm))
        best = std::move(candidate);
    }
    return best;
  }

  /// Refit and reselect until the set is stable.
  void refit(RigidAgreement& agreement, double limit_mm) const {
    for (int round = 0; round < 4; ++round) {
      const auto map = fit(agreement.agreeing);
      if (!map) return agreement.agreeing.clear();
      agreement.map = *map;
      agreement.limit_mm = limit_mm;
      const Indices now = within(*map, limit_mm);
      const bool stays = now == agreement.agreeing;
      agreement.agreeing = now;
      agreement.rms_mm = rms(*map, now);
      if (stays) return;
    }
  }

 private:
  std::optional<RigidMap> fit(std::span<const std::size_t> which) const {
    std::vector<PointPair> pairs;
    for (const std::size_t i : which) pairs.push_back({to_[i], from_[i]});
    return rigidFit(pairs, handedness_);
  }
  double error(const RigidMap& map, std::size_t i) const { return glm::distance(map(from_[i]), to_[i]); }
  Indices within(const RigidMap& map, double limit_mm) const {
    Indices near;
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (error(map, i) < limit_mm) near.push_back(i);
    return near;
  }
  double rms(const RigidMap& map, const Indices& which) const {
    double sum = 0.0;
    for (const std::size_t i : which) sum += error(map, i) * error(map, i);
    return which.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(which.size()));
  }

  std::span<const glm::dvec3> from_, to_;
  Handedness handedness_;
  std::vector<std::array<std::size_t, kOfFour>> fours_;
};

}  // namespace

std::optional<RigidMap> rigidFit(std::span<const PointPair> pairs, Handedness handedness) {
  if (pairs.size() < 3) return std::nullopt;
  double weight = 0.0;
  glm::dvec3 from_middle{0.0}, to_middle{0.0};
  for (const PointPair& pair : pairs) {
    weight += pair.weight;
    from_middle += pair.weight * pair.from_mm;
    to_middle += pair.weight * pair.to_mm;
  }
  from_middle /= weight, to_middle /= weight;
  glm::dmat3 together(0.0);
  for (const PointPair& pair : pairs)
    together += pair.weight / weight * glm::outerProduct(pair.to_mm - to_middle, pair.from_mm - from_middle);

  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(Eigen::Matrix3d::Map(glm::value_ptr(together)),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& w = svd.singularValues();
  if (!(w[1] > kOnALine * kOnALine * w[0]) || !std::isfinite(w[0])) return std::nullopt;
  const double wanted = handedness == Handedness::kept ? 1.0 : -1.0;
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() * wanted < 0.0 ? -1.0 : 1.0;
  const Eigen::Matrix3d rotation =
      svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  RigidMap map;
  map.rotation = glm::make_mat3(rotation.data());
  map.translation_mm = to_middle - map.rotation * from_middle;
  return map;
}

std::optional<RigidAgreement> rigidAgreement(std::span<const glm::dvec3> from_mm, std::span<const glm::dvec3> to_mm,
                                             Handedness handedness, double min_limit_mm, double max_limit_mm) {
  const std::size_t n = from_mm.size(), needed = std::max(kOfFour, (2 * n + 2) / 3);
  const Agreement agreement(from_mm, to_mm, handedness);
  for (double limit_mm = min_limit_mm; limit_mm <= max_limit_mm; limit_mm *= kLimitGrowth) {
    RigidAgreement best = agreement.largest(limit_mm);
    if (best.agreeing.size() < needed) continue;
    // The limit follows the spread, so that an arm far from its model does not turn into outliers.
    for (int round = 0; round < 3; ++round) agreement.refit(best, std::max(limit_mm, 3.0 * best.rms_mm));
    if (best.agreeing.size() >= needed) return best;
  }
  return std::nullopt;
}

}  // namespace calibration
