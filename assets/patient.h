// The patient of a rehearsal: CT, canal, operating site and the scenery around it, all in frame P (LPS mm).
// Carries no name, date or identifier of a person: the folder's name is the case's name.
// Immutable after loading; any thread may read.
#pragma once

#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/mesh.h"

namespace assets {

/// How grey values become solid fraction: solid = cdf((HU - iso) / sigma), sigma at least what makes the
/// transition a voxel wide (see solid_fraction.h).
struct Classification {
  double iso_hu = 300.0;
  double sigma_hu = 75.0;
};

/// Where the operation happens.
struct OperatingSite {
  bool known = false;                     ///< false: no third molar was labelled
  int tooth_fdi = 48;                     ///< 48 right, 38 left lower third molar
  glm::dvec3 third_molar_P_mm{0.0};       ///< centroid of its hard tissue
  glm::dvec3 crown_direction_P{0, 0, 1};  ///< unit, root to crown
};

struct Patient {
  std::string title;  ///< one line for people: "built-in patient, right, mesio-angular 45 deg", never a person's name
  CtVolume ct;
  Classification classification;
  OperatingSite site;
  std::vector<glm::dvec3> canal_P_mm;  ///< centre line of the mandibular canal, empty if unknown
  double canal_radius_mm = 1.4;
  MeshModel gum;   ///< gingiva as a surface, with the flap raised around the site; may be empty
  MeshModel face;  ///< context only; may be empty
};

}  // namespace assets
