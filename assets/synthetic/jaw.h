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
inline constexpr int kSyntheticPatientRevision = 16;

struct JawParameters {
  bool right_side = true;
  /// -79..100: below -10 disto-angular, to 10 vertical, from 11 mesio-angular, from 80 horizontal.
  double winter_angle_deg = 45.0;
  double depth_mm = 8.0;                      ///< 0..12: top of the third molar below the second molar's occlusal plane
  double mandibular_canal_distance_mm = 1.0;  ///< 0..6: third molar to the canal's lumen, nearest points
  double spacing_mm = 0.25;                   ///< 0.15..1: edge of a voxel
  std::uint64_t seed = 1;                     ///< of noise, trabeculae and irregularities of the bone
};

/// Throws LoadError: a parameter out of range, or an impossible combination.
Patient syntheticJaw(const JawParameters& parameters, const ReportProgress& report = {});

}  // namespace assets
