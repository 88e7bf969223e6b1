// Fits a face model to an imported jaw by its teeth: rigid, scale 1:1.
// The face comes with teeth.json: per tooth ("LR8") the centroid of the whole tooth with the mouth open
// (`open_mean_m`), in metres, axes of F. The jaw has labels: lower teeth (by number, else one label for all), and the
// tooth at the site. Method: occlusal planes are aligned from several directions; then voxels are assigned to the
// nearest tooth and both sets of centroids matched (iterative closest point, Besl and McKay 1992; rotation after Horn
// 1987), the worst fifth left out. The residual is returned; some millimetres are normal between different people.
// Frames P (its z roughly up) and F, mm. Any thread; below 1 s.
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
  double rms_mm = 0.0;      ///< between tooth centroids of jaw and face, without the site's
  double at_site_mm = 0.0;  ///< residual of the tooth at the site; 0 if the face has none
  int teeth = 0;            ///< teeth used, without the site's
};

/// The lower teeth of a teeth.json. Throws LoadError.
std::vector<FaceTooth> readFaceTeeth(const std::string& path);

/// Throws LoadError if fewer than three teeth agree. The tooth at the site is used if the face has it.
FacePlacement fitFace(const CtVolume& ct, const std::optional<OperativeSite>& site,
                      const std::vector<FaceTooth>& teeth);

}  // namespace assets
