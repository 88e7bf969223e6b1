#include "assets/scenery/rigid_fit.h"

#include <array>
#include <cmath>

namespace assets {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

// Eigenvector of the largest eigenvalue of a symmetric matrix.
std::array<double, 4> largestEigenvector(Matrix4 a) {
  Matrix4 v{};
  for (std::size_t i = 0; i < 4; ++i) v[i][i] = 1.0;
  for (int sweep = 0; sweep < 60; ++sweep) {
    double off = 0.0;
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        off += std::abs(a[p][q]);
        if (std::abs(a[p][q]) < 1e-300) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0);
        const double s = t * c;
        for (std::size_t k = 0; k < 4; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double pk = a[p][k], qk = a[q][k], vp = v[k][p], vq = v[k][q];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          v[k][p] = c * vp - s * vq;
          v[k][q] = s * vp + c * vq;
        }
      }
    }
    if (off < 1e-12) break;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i) best = a[i][i] > a[best][best] ? i : best;
  return {v[0][best], v[1][best], v[2][best], v[3][best]};
}

}  // namespace

RigidMotion rigidFit(std::span<const PointPair> pairs) {
  glm::dvec3 to_mean(0.0);
  glm::dvec3 from_mean(0.0);
  double weight = 0.0;
  for (const PointPair& pair : pairs) {
    to_mean += pair.weight * pair.to_mm;
    from_mean += pair.weight * pair.from_mm;
    weight += pair.weight;
  }
  to_mean /= weight;
  from_mean /= weight;

  // Cross covariance, then Horn's symmetric matrix.
  double s[3][3] = {};
  for (const PointPair& pair : pairs) {
    const glm::dvec3 a = pair.from_mm - from_mean;
    const glm::dvec3 b = pair.to_mm - to_mean;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) s[i][j] += pair.weight * a[i] * b[j];
    }
  }
  const Matrix4 n = {{{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                      {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                      {s[2][0] - s[0][2], s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
                      {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]}}};
  const std::array<double, 4> q = largestEigenvector(n);
  const glm::dquat rotation = glm::normalize(glm::dquat(q[0], q[1], q[2], q[3]));
  return {rotation, to_mean - rotation * from_mean};
}

}  // namespace assets
