// Face models between frames F and P. F: x to the patient's left, y up, z forward (glTF); P: x left, y posterior, z
// superior (LPS). mm in both; a rotation and a translation, scale 1:1. Any thread; a pass over the vertices.
#pragma once

#include <utility>

#include "assets/mesh.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace assets {

using FacePose = calibration::Pose<calibration::Patient, calibration::Face>;

/// Rotation from F to P about a common origin: up becomes z, forward becomes -y.
inline const FacePose kFaceAxes_PF{glm::dquat(0.70710678118654752, 0.70710678118654752, 0.0, 0.0), glm::dvec3(0.0)};

template <class To, class From>
MeshModel transformedModel(MeshModel model, const calibration::Pose<To, From>& X) {
  const glm::dmat3 rotation = glm::mat3_cast(X.rotation);
  for (MeshPart& part : model.parts) {
    for (glm::vec3& p : part.position_mm) p = glm::vec3(rotation * glm::dvec3(p) + X.translation_mm);
    for (glm::vec3& n : part.normal) n = glm::vec3(rotation * glm::dvec3(n));
  }
  return model;
}

inline MeshModel modelInPatientFrame(MeshModel model_F, const FacePose& X_PF = kFaceAxes_PF) {
  return transformedModel(std::move(model_F), X_PF);
}

inline MeshModel modelInFaceFrame(MeshModel model_P, const FacePose& X_PF = kFaceAxes_PF) {
  return transformedModel(std::move(model_P), X_PF.inverse());
}

}  // namespace assets
