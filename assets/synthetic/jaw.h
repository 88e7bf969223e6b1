// The built-in patient: one side of an adult lower jaw with an impacted third molar, made by our own code from
// parameters. Frame P, LPS mm: origin at the edge between the lower central incisors, x to the patient's left, y
// posterior, z superior; the occlusal plane is z = 0, the midline x = 0. A right jaw is the exact mirror image of the
// left one. Any thread; works on all cores, about 5 s at 0.25 mm on two; the same bytes whatever the number of threads.
// It is anatomy to rehearse on, made after textbook measures; it is nobody's scan.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/patient.h"

namespace assets {

/// Rises when the jaw, its gingiva or the face is made differently, so that no copy kept from before passes for the new
/// one.
inline constexpr int kSyntheticPatientRevision = 3;

struct JawParameters {
  bool right_side = true;
  double winter_angle_deg =
      45.0;  ///< -79..100: below -10 disto-angular, to 10 vertical, from 11 mesio-angular, from 80 horizontal
  double depth_mm = 3.0;  ///< 0..8: highest point of the third molar below the second molar's occlusal plane
  double mandibular_canal_distance_mm =
      2.0;                   ///< 0.3..6: third molar to the lumen of the mandibular canal, nearest points
  double spacing_mm = 0.25;  ///< 0.15..1: edge of a voxel
  std::uint64_t seed = 1;    ///< noise, marrow and the small irregularities of the bone
};

struct ToothLandmark {
  int fdi = 0;
  glm::dvec3 centroid_P_mm{0.0};  ///< middle of the crown
};

/// Where the jaw lies in its head, for what is built round it.
struct JawLandmarks {
  std::vector<ToothLandmark> lower_teeth;  ///< both sides, incisors to second molars, and the impacted third molar
  glm::dvec3 incisor_edge_P_mm{0.0};       ///< midline point
  double occlusal_plane_mm = 0.0;          ///< z of the occlusal plane, horizontal in P
};

/// Throws LoadError, one line, when a parameter is out of its range or the anatomy can not be had.
Patient syntheticJaw(const JawParameters& parameters);

/// The same jaw's landmarks without making its voxels; about 1 s.
JawLandmarks syntheticLandmarks(const JawParameters& parameters);

}  // namespace assets
