// Synthetic face around the operated jaw: a draped head with open mouth, closed eyes and one cheek retracted. Frame P
// (LPS mm), origin between the lower incisal edges with the mouth open, so the scanned jaw fits without a transform.
// Drawn only. Parts: Face, Mouth, Tongue, UpperTeeth, LowerTeeth, Hair, Cap, Drape, Retractor. Deterministic; any
// thread; some seconds on two cores. The scanned side of the lower jaw from the first premolar back is left out of
// gingiva and teeth.
#pragma once

#include <cstdint>

#include "assets/mesh.h"
#include "assets/progress.h"
#include "assets/synthetic/jaw.h"

namespace assets {

struct FaceParameters {
  int tooth_fdi = 48;  ///< 48: right cheek retracted, 38: left
  double opening_mm = kUsualOpening_mm;
  double voxel_mm = 1.1;      ///< of the face; teeth and tongue are finer
  std::uint32_t seed = 2026;  ///< of hairs and skin mottling
};

/// Throws LoadError if a parameter is out of range.
MeshModel syntheticFace(const FaceParameters& parameters, const ReportProgress& report = {});

/// Unit vector from the tooth to the surgeon's eye, frame P: in front, to the operated side, above a lower tooth and
/// below an upper one.
glm::dvec3 surgeonEyeDirection(int tooth_fdi);

}  // namespace assets
