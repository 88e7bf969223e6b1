// The dental arch of a scan, found from grey values alone: what is as dense as dentine lies on it. In polar coordinates
// about a centre behind the front teeth: angle 0 forward, positive to the patient's left; the radius of the row of
// teeth by angle. A scan of one side has its centre at that side's end towards the midline. Frame P, mm, Hounsfield.
// Pure; any thread but the servo.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "assets/segment/cell_masks.h"

namespace assets {

inline constexpr int kArchBins = 96;
inline constexpr double kArchEnd_rad = 0.62 * 3.14159265358979323846;

struct JawArch {
  glm::dvec2 centre_P_mm{0.0};  ///< x, y
  bool is_one_sided = false;
  std::array<double, kArchBins> radius_mm{};     ///< of the row of teeth
  std::array<double, kArchBins> dense_z_P_mm{};  ///< height of its middle
  std::array<bool, kArchBins> has_teeth{};
  CellMask dense;  ///< the row, in the cells it was found in

  double angleOf(const glm::dvec3& p_P_mm) const;
  static int binOf(double angle_rad);  ///< within the arch; ends are extended
  static double angleAt(int bin) { return kArchEnd_rad * ((2.0 * bin + 1.0) / kArchBins - 1.0); }
  /// Of a point, from the centre, less the arch's radius there.
  double outside_mm(const glm::dvec3& p_P_mm) const;
  /// On the arch, `outside_mm` away from it.
  glm::dvec2 pointAt(int bin, double outside_mm) const;
};

/// `smooth_hu`: on cells of about 0.7 mm. None without a row of dense tissue.
std::optional<JawArch> findJawArch(const VolumeGrid& cells, const std::vector<float>& smooth_hu);

}  // namespace assets
