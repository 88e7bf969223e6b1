// The gum over the operated site as a map: cylinder coordinates about a line inside the ridge along the dental arch.
// Every place is (m, angle, r): m mm forwards along the arch, angle about the line from straight up, positive towards
// the cheek, r mm from the line. A lattice holds the outer surface of the closed gum and of what lies under it as
// scanned, bone or tooth; between its points bilinear. So a point's depth in the gum and the place over it cost some
// tens of ns, whatever the mesh. Frame P, mm, rad. Immutable; any thread. Building: about 0.2 s.
// Not for gum that a ray from the line would cross twice: the outer crossing counts.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/mesh.h"
#include "assets/planned_cut.h"

namespace app {

struct ChartPlace {
  double m_mm = 0.0, angle_rad = 0.0;
};

class GumChart {
 public:
  static constexpr double kColumn_mm = 0.5, kRow_rad = 0.04;
  static constexpr double kLowest_rad = -1.6, kHighest_rad = 2.2;

  /// `gum_P`: closed. The map lies around the cut, 12 mm beyond it along the arch.
  GumChart(const assets::MeshModel& gum_P, const assets::CtVolume& ct, const assets::PlannedCut& cut);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  ChartPlace node(int column, int row) const { return {low_m_mm_ + kColumn_mm * column, kLowest_rad + kRow_rad * row}; }
  bool isGum(int column, int row) const { return gum_[index(column, row)] != 0; }

  ChartPlace placeOf(const glm::dvec3& p_P_mm) const;
  double radiusOf_mm(const glm::dvec3& p_P_mm) const;
  glm::dvec3 point_P_mm(const ChartPlace& at, double r_mm) const;
  bool contains(const ChartPlace& at) const;
  /// The nearest point of the lattice is gum, not a tooth that stands free.
  bool isGum(const ChartPlace& at) const;
  /// Places beyond the map have the values of its edge.
  double gum_mm(const ChartPlace& at) const { return value(gum_mm_, at); }
  double bone_mm(const ChartPlace& at) const { return value(bone_mm_, at); }
  glm::dvec3 surface_P_mm(const ChartPlace& at) const { return point_P_mm(at, gum_mm(at)); }
  glm::dvec3 outward_P(const ChartPlace& at) const;  ///< away from the line, unit
  glm::dvec3 normal_P(const ChartPlace& at) const;   ///< of the gum's surface, unit
  /// Below the gum's surface, along its normal; negative above it.
  double depth_mm(const glm::dvec3& p_P_mm) const;

  const glm::dvec3& mesial_P() const { return mesial_P_; }
  const glm::dvec3& buccal_P() const { return buccal_P_; }
  const glm::dvec3& up_P() const { return up_P_; }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row);
  }
  double value(const std::vector<double>& of, const ChartPlace& at) const;
  void takeGum(const assets::MeshModel& gum_P);
  void takeSolid(const assets::CtVolume& ct);

  glm::dvec3 origin_P_mm_, mesial_P_, buccal_P_, up_P_;
  double low_m_mm_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<double> gum_mm_, bone_mm_;
  std::vector<std::uint8_t> gum_;
};

}  // namespace app
