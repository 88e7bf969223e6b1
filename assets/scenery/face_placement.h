// Where a face model belongs around an imported jaw: tooth on tooth, rigid, 1:1, never scaled.
// A face comes with teeth.json: for each tooth ("LR8") the centroid of the whole tooth with the mouth open
// (`open_mean_m`), metres, axes of F. The jaw has labels: lower teeth (by number, or one label for all), and the tooth
// at the site. Fit: chewing plane on chewing plane from several directions; then voxels are assigned to the nearest
// tooth and both sets of centroids brought together (iterative closest point, Besl and McKay 1992; rotation after Horn
// 1987), the worst fifth left out. The residual comes with the result; faces of other people differ, some millimetres
// are normal. Frames P (its z roughly up) and F, mm. Any thread; below 1 s.
#pragma once

#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/patient.h"
#include "assets/scenery/face_frame.h"

namespace assets {

struct FaceTooth {
  int fdi = 0;
  glm::dvec3 open_F_mm{0.0};  ///< centroid with the mouth open
};

struct FacePlacement {
  FacePose X_PF;
  double rms_mm = 0.0;      ///< between the teeth's centroids of jaw and face, the one at the site not counted
  double at_site_mm = 0.0;  ///< how far the tooth at the site lies from where the face has it; 0 if it has none
  int teeth = 0;            ///< teeth used, the one at the site not counted
};

/// The lower teeth of a teeth.json. Throws LoadError.
std::vector<FaceTooth> readFaceTeeth(const std::string& path);

/// Throws LoadError if fewer than three teeth agree. A site helps with its tooth, where the face has it.
FacePlacement fitFace(const CtVolume& ct, const std::optional<OperativeSite>& site,
                      const std::vector<FaceTooth>& teeth);

}  // namespace assets
