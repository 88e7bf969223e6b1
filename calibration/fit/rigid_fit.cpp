#include "calibration/fit/rigid_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <opencv2/core.hpp>

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t kOfFour = 4;
constexpr int kTries = 400;
constexpr std::size_t kAllAreTried = 12;  ///< places, of which every four can be tried
constexpr double kLimitGrowth = 1.5;
constexpr double kOnALine = 1e-3;  ///< of the longest extent

/// Every four of a few, or the same four hundred of many.
std::vector<std::array<std::size_t, kOfFour>> foursOf(std::size_t n) {
  std::vector<std::array<std::size_t, kOfFour>> fours;
  if (n <= kAllAreTried) {
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        for (std::size_t c = b + 1; c < n; ++c)
          for (std::size_t d = c + 1; d < n; ++d) fours.push_back({a, b, c, d});
    return fours;
  }
  std::mt19937 chance(11);
  for (int i = 0; i < kTries; ++i) {
    std::array<std::size_t, kOfFour> four{};
    for (std::size_t k = 0; k < kOfFour; ++k) do
        four[k] = chance() % n;
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

  /// The largest set within the limit; of two as large the closer.
  RigidAgreement largest(double limit_mm) const {
    RigidAgreement best;
    for (const auto& four : fours_) {
      const auto rough = rigidFit(from_, to_, four, handedness_);
      if (!rough) continue;
      // A map of four is rough far from them: what is twice as near has its say before the count.
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

  /// Map and RMS of its set, then the set within the limit of that map, until it stays.
  void refit(RigidAgreement& agreement, double limit_mm) const {
    for (int round = 0; round < 4; ++round) {
      const auto map = rigidFit(from_, to_, agreement.agreeing, handedness_);
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

std::optional<RigidMap> rigidFit(std::span<const glm::dvec3> from_mm, std::span<const glm::dvec3> to_mm,
                                 std::span<const std::size_t> which, Handedness handedness) {
  if (which.size() < 3) return std::nullopt;
  const double share = 1.0 / static_cast<double>(which.size());
  glm::dvec3 from_middle{0.0}, to_middle{0.0};
  for (const std::size_t i : which) from_middle += share * from_mm[i], to_middle += share * to_mm[i];
  cv::Matx33d together = cv::Matx33d::zeros();
  for (const std::size_t i : which)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) together(r, c) += share * (to_mm[i] - to_middle)[r] * (from_mm[i] - from_middle)[c];

  cv::Matx33d u, vt;
  cv::Matx31d w;
  cv::SVD::compute(together, w, u, vt);
  if (!(w(1) > kOnALine * kOnALine * w(0)) || !std::isfinite(w(0))) return std::nullopt;
  const double wanted = handedness == Handedness::kept ? 1.0 : -1.0;
  const double sign = cv::determinant(u) * cv::determinant(vt) * wanted < 0.0 ? -1.0 : 1.0;
  const cv::Matx33d turn = u * cv::Matx33d::diag({1.0, 1.0, sign}) * vt;
  RigidMap map;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) map.turn[c][r] = turn(r, c);
  map.shift_mm = to_middle - map.turn * from_middle;
  return map;
}

std::optional<RigidAgreement> rigidAgreement(std::span<const glm::dvec3> from_mm, std::span<const glm::dvec3> to_mm,
                                             Handedness handedness, double least_limit_mm, double most_limit_mm) {
  const std::size_t n = from_mm.size(), needed = std::max(kOfFour, (2 * n + 2) / 3);
  const Agreement agreement(from_mm, to_mm, handedness);
  for (double limit_mm = least_limit_mm; limit_mm <= most_limit_mm; limit_mm *= kLimitGrowth) {
    RigidAgreement best = agreement.largest(limit_mm);
    if (best.agreeing.size() < needed) continue;
    // The limit follows the spread of those who agree, so that an untrue arm is no crowd of outliers.
    for (int round = 0; round < 3; ++round) agreement.refit(best, std::max(limit_mm, 3.0 * best.rms_mm));
    if (best.agreeing.size() >= needed) return best;
  }
  return std::nullopt;
}

}  // namespace calibration
