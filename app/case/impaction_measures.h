// What can be measured at an impacted lower third molar: its axis against the second molar's, its depth, the room
// before the ramus, the mandibular canal, the lingual plate, the second molar. Frame P, mm. Directions: distal along
// the arch, up along the second molar's axis in the sagittal plane of the arch (without a second molar: the scan's
// vertical). Any thread; about a second. Definitions: reference/product 3.2 and 3.3.
#pragma once

#include <optional>
#include <string>

#include "app/case/tooth_voxels.h"
#include "assets/patient.h"

namespace app {

/// A value, or why there is none.
struct Measured {
  std::optional<double> value;
  std::string missing;
};

enum class CanalPlace { below, buccal, lingual, between_roots };

struct ImpactionMeasures {
  Measured angle_deg;         ///< long axes in the sagittal plane of the arch, positive: crown to mesial
  Measured across_deg;        ///< of the third molar's axis out of that plane, positive: crown to buccal
  Measured depth_mm;          ///< highest point under the second molar's highest point
  Measured cervical_line_mm;  ///< of the second molar, mean, under the same
  Measured covered_share;     ///< of the crown's mesiodistal diameter, for which there is no room before the ramus
  Measured canal_mm;          ///< third molar to the canal's lumen, nearest points; 0: in contact
  CanalPlace canal_place = CanalPlace::below;  ///< where there is a canal
  Measured lingual_plate_mm;  ///< bone lingual of the roots, from 2.5 mm below the cervical line, where it is thinnest
                              ///< (2nd percentile)
  Measured second_molar_mm;   ///< to the second molar, nearest points
};

/// `third`: voxels of the operated tooth, not empty. The patient must have a site at a lower third molar.
ImpactionMeasures measureImpaction(const assets::Patient& patient, const ToothVoxels& third);

/// The directions of the measures, unit.
struct ArchFrame {
  glm::dvec3 distal_P, buccal_P, up_P;

  /// The mesial side of a tooth with this axis: across the axis, in the sagittal plane of the arch, however it lies.
  glm::dvec3 mesialSideOf(const glm::dvec3& axis_P) const {
    const double sign = glm::dot(glm::cross(buccal_P, up_P), distal_P) > 0.0 ? -1.0 : 1.0;
    return glm::normalize(sign * glm::cross(buccal_P, axis_P));
  }
};
ArchFrame archFrame(const assets::Patient& patient, const glm::dvec3& up_P = {0.0, 0.0, 1.0});

}  // namespace app
