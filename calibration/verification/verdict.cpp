#include "calibration/verification/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace calibration {
namespace {

constexpr VerificationLimits kFull{{0.5, 1.0}, {0.8, 1.8}, {1.2, 2.5}, {0.3, 0.6}};
// By eye the RMS has limits of its own; the others keep their ratio to it.
constexpr VerificationLimits kByEyes{{0.8, 1.5}, {1.3, 2.7}, {1.9, 3.75}, {0.5, 0.9}};
// Of four touches, which one translation may explain: the bias has the RMS's limits.
constexpr VerificationLimits kSessionCheck{{0.6, 1.2}, {1.0, 2.0}, {1.0, 2.0}, {0.6, 1.2}};

constexpr int kMinForGreen = 4;
constexpr double kOneSided95 = 1.65;

double length(const Vector<World>& v) { return glm::length(v.xyz); }

/// Linear interpolation, as in spreadsheets and numpy.
double percentile(std::vector<double> sorted, double share) {
  std::ranges::sort(sorted);
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// NaN is red.
Verdict against(double value_mm, const VerificationLimit& limit) {
  return value_mm <= limit.green_mm ? Verdict::green : value_mm <= limit.amber_mm ? Verdict::amber : Verdict::red;
}

/// NaN if a component is.
double largestOf(const glm::dvec3& v) {
  const glm::dvec3 size = glm::abs(v);
  return std::isfinite(size.x + size.y + size.z) ? std::max({size.x, size.y, size.z}) : size.x + size.y + size.z;
}

}  // namespace

std::string_view nameOf(Verdict verdict) {
  return verdict == Verdict::green ? "green" : verdict == Verdict::amber ? "amber" : "red";
}

std::string_view nameOf(VerificationKind kind) {
  return kind == VerificationKind::full ? "full" : kind == VerificationKind::by_eyes ? "by_eyes" : "session_check";
}

TargetErrors targetErrors(const std::vector<Residual>& residuals) {
  TargetErrors errors;
  std::vector<double> lengths;
  glm::dvec3 sum{0.0}, squares{0.0};
  for (const Residual& residual : residuals) {
    if (!residual.used) continue;
    lengths.push_back(length(residual.error_mm));
    sum += residual.error_mm.xyz;
    squares += residual.error_mm.xyz * residual.error_mm.xyz;
    errors.mean_mm += lengths.back();
  }
  if (lengths.empty()) return errors;
  const double n = static_cast<double>(lengths.size());
  errors.n = static_cast<int>(lengths.size());
  errors.mean_mm /= n;
  errors.rms_mm = std::sqrt((squares.x + squares.y + squares.z) / n);
  errors.p95_mm = percentile(lengths, 0.95);
  errors.max_mm = *std::ranges::max_element(lengths);
  errors.bias_mm = {sum / n};
  errors.in_plane_rms_mm = std::sqrt((squares.x + squares.y) / n);
  errors.along_sight_rms_mm = std::sqrt(squares.z / n);
  return errors;
}

const VerificationLimits& limitsOf(VerificationKind kind) {
  return kind == VerificationKind::full ? kFull : kind == VerificationKind::by_eyes ? kByEyes : kSessionCheck;
}

Assessment assess(const TargetErrors& errors, VerificationKind kind) {
  Assessment assessment;
  if (errors.n == 0) {
    assessment.reason = "no touch to check against";
    return assessment;
  }
  const VerificationLimits& limits = limitsOf(kind);
  assessment.rms_upper_bound_mm = errors.rms_mm * (1.0 + kOneSided95 / std::sqrt(6.0 * errors.n));
  struct Quantity {
    const char* what;
    double value_mm;
    VerificationLimit limit;
  };
  const std::array quantities = {
      Quantity{"root mean square at most {:.2f} mm (95 % sure)", assessment.rms_upper_bound_mm, limits.rms},
      Quantity{"95 of 100 touches within {:.2f} mm", errors.p95_mm, limits.p95},
      Quantity{"the worst touch {:.2f} mm off", errors.max_mm, limits.max},
      Quantity{"all touches off in one direction by {:.2f} mm", largestOf(errors.bias_mm.xyz), limits.bias}};

  // The worst colour decides; within a colour the largest ratio to its limit.
  const auto beyond = [](const Quantity& q) { return q.value_mm / q.limit.green_mm; };
  const auto worse = [&](const Quantity& a, const Quantity& b) {
    const Verdict va = against(a.value_mm, a.limit), vb = against(b.value_mm, b.limit);
    return va != vb ? va < vb : beyond(a) < beyond(b);
  };
  const Quantity& deciding = *std::ranges::max_element(quantities, worse);
  assessment.verdict = against(deciding.value_mm, deciding.limit);
  const double limit_mm = assessment.verdict == Verdict::red ? deciding.limit.amber_mm : deciding.limit.green_mm;
  assessment.reason = fmt::format(fmt::runtime(deciding.what), deciding.value_mm) +
                      (assessment.verdict == Verdict::green ? fmt::format(", {:.2f} mm are allowed", limit_mm)
                                                            : fmt::format(", more than {:.2f} mm", limit_mm));
  if (errors.n < kMinForGreen && assessment.verdict == Verdict::green) {
    assessment.verdict = Verdict::amber;
    assessment.reason = std::to_string(errors.n) + " touches are too few to be sure, 4 are needed";
  }
  return assessment;
}

std::string worstErrorSentence(const std::vector<Residual>& residuals, const Point<World>& middle_W) {
  const Residual* worst = nullptr;
  glm::dvec3 reach_mm{0.0};
  for (const Residual& residual : residuals) {
    if (!residual.used) continue;
    reach_mm = glm::max(reach_mm, glm::abs(residual.target_W.mm - middle_W.mm));
    if (!worst || length(residual.error_mm) > length(worst->error_mm)) worst = &residual;
  }
  if (!worst) return "no touches";
  const glm::dvec3 from_middle = worst->target_W.mm - middle_W.mm;
  std::string position;
  const auto say = [&](int axis, const char* negative, const char* positive) {
    if (std::abs(from_middle[axis]) <= reach_mm[axis] / 3.0 || reach_mm[axis] < 1.0) return;
    position += (position.empty() ? "" : " ") + std::string(from_middle[axis] < 0.0 ? negative : positive);
  };
  say(2, "back", "front");
  say(0, "left", "right");
  say(1, "low", "high");
  return fmt::format("worst: {}, {:.1f} mm", position.empty() ? "in the middle" : position, length(worst->error_mm));
}

}  // namespace calibration
