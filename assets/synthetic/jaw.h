// The built-in patient: one side of an adult lower jaw with an impacted third molar, generated from parameters after
// textbook measures. Frame P, LPS mm: origin at the edge between the lower central incisors, x to the patient's left, y
// posterior, z superior; occlusal plane z = 0, midline x = 0. A right jaw is the exact mirror image of the left one.
// Any thread; parallel, about 3 s at 0.25 mm on two cores; the same bytes for any number of threads.
#pragma once

#include <cstdint>

#include "assets/patient.h"
#include "assets/progress.h"

namespace assets {

/// Part of the cache name; to be incremented with any change of the generated jaw, gingiva or face.
inline constexpr int kSyntheticPatientRevision = 17;

/// Between the incisal edges with the mouth open. Healthy adults reach 35 to 50 mm (Gray's Anatomy); less than 35 mm is
/// trismus (Dijkstra 2006, Int. J. Oral Maxillofac. Surg. 35:337). The least is our own choice: the scripted handpiece
/// then brushes the lip.
inline constexpr double kUsualOpening_mm = 37.0, kLeastOpening_mm = 25.0, kMostOpening_mm = 50.0;

struct JawParameters {
  bool right_side = true;
  /// -79..100: below -10 disto-angular, to 10 vertical, from 11 mesio-angular, from 80 horizontal.
  double winter_angle_deg = 45.0;
  double depth_mm = 8.0;                      ///< 0..12: top of the third molar below the second molar's occlusal plane
  double mandibular_canal_distance_mm = 1.0;  ///< 0..6: third molar to the canal's lumen, nearest points
  double spacing_mm = 0.25;                   ///< 0.15..1: edge of a voxel
  std::uint64_t seed = 1;                     ///< of noise, trabeculae and irregularities of the bone
  double opening_mm = kUsualOpening_mm;       ///< kLeastOpening_mm..kMostOpening_mm: of the mouth; the face's alone
};

/// Throws LoadError: a parameter out of range, or an impossible combination.
Patient syntheticJaw(const JawParameters& parameters, const ReportProgress& report = {});

}  // namespace assets
