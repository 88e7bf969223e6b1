// The file of the published simulator, for comparison: links as torsion springs with inertia,
//   K (th_i - th_(i-1)) - K (th_(i+1) - th_i) + B th' + I th'' = M_i,  M_i = l S_i . dt_i/dth_i, in one plane,
// by the classical Runge-Kutta method. Its inertia is not the file's: at 1 kHz the method is stable only with
// I >= K dt^2 / 2, so I is inflated to 1.3 times that, and the file settles in tens of ms (#25, 16 links: 153 ms); B is
// twice I times the first frequency. Rest is that of file_in_canal to 1e-9. mm, rad, N, N mm, s. Servo thread; no
// allocation; 0.4 µs a substep of 16 links. Source: reference/sisters 1.7, physics 1.7.
#pragma once

#include "haptics/file/file_chain.h"

namespace haptics {

class Rk4Chain {
 public:
  Rk4Chain(const FileChain& chain, double period_s, int substeps) noexcept;

  /// More substeps with the same inertia.
  void refine(int times) noexcept;

  /// A tick under forces on the nodes: x across the handle's axis, y along it.
  void step(const PerNode<glm::dvec2>& force_N) noexcept;

  glm::dvec2 node_mm(std::size_t node) const noexcept;  ///< x across, y along, from node 0
  const PerNode<double>& angle_rad() const noexcept { return angle_rad_; }
  double inertia_Nmm_s2() const noexcept { return inertia_; }
  double damping_Nmm_s() const noexcept { return damping_; }

 private:
  PerNode<double> accelerations(const PerNode<double>& angle, const PerNode<double>& rate,
                                const PerNode<glm::dvec2>& beyond_N) const noexcept;

  FileChain chain_;
  double substep_s_;
  int substeps_;
  double inertia_ = 0.0, damping_ = 0.0;
  PerNode<double> angle_rad_{}, rate_rad_per_s_{};
};

}  // namespace haptics
