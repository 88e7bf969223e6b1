// A face of our own making around the operated jaw: a draped head with open mouth, closed eyes and one cheek held away.
// Frame P (LPS mm); origin between the lower incisal edges in their place with the mouth OPEN, so the jaw of the scan
// stands in the mouth as it is. Context only: drawn, never touched, not a measured person.
// Parts: Face, Mouth, Tongue, UpperTeeth, LowerTeeth, Hair, Cap, Drape, Retractor. Deterministic; any thread; some
// seconds on two cores. The scanned side of the lower jaw from the first premolar back is left out of gums and teeth.
#pragma once

#include <cstdint>

#include "assets/mesh.h"

namespace assets {

struct FaceParameters {
  int tooth_fdi = 48;         ///< 48: right cheek held away, 38: left
  double voxel_mm = 1.1;      ///< of the face; teeth and tongue are finer
  std::uint32_t seed = 2026;  ///< hairs and the skin's mottling
};

/// Throws LoadError if a parameter is out of range.
MeshModel syntheticFace(const FaceParameters& parameters);

/// Unit vector from the tooth to the surgeon's eye, frame P: in front, to the operated side, above a lower tooth and
/// below an upper one.
glm::dvec3 surgeonEyeDirection(int tooth_fdi);

}  // namespace assets
