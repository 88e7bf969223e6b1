// The patient of a rehearsal: CT, mandibular canal, operative site and the scenery around it, all in frame P (LPS mm).
// Carries no name, date or identifier of a person: the folder's name is the case's name.
// Immutable after loading; any thread may read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/mesh.h"
#include "assets/operative_site.h"

namespace assets {

/// How grey values become solid fraction: solid = cdf((HU - iso) / sigma), sigma at least what makes the
/// transition a voxel wide (see solid_fraction.h).
struct Classification {
  double iso_hu = 300.0;
  double sigma_hu = 75.0;
};

struct Patient {
  std::string title;  ///< one line for people: "built-in patient, right, mesio-angular 45 deg", never a person's name
  CtVolume ct;
  Classification classification;
  std::optional<OperativeSite> site;              ///< none: no tooth is labelled that could be it
  glm::dvec3 jaw_P_mm{0.0};                       ///< where to look without a site: the lower jaw, or what there is
  std::vector<glm::dvec3> mandibular_canal_P_mm;  ///< centre line of the mandibular canal, empty if unknown
  double mandibular_canal_radius_mm = 1.4;
  MeshModel gingiva;  ///< gingiva as a surface, with the flap raised around the site; may be empty
  MeshModel face;     ///< context only; may be empty

  glm::dvec3 focus_P_mm() const { return site ? site->centre_P_mm : jaw_P_mm; }
  /// The tooth whose side and jaw decide how the patient lies; the usual one where none is known.
  int operatedTooth() const { return site ? site->fdi : OperativeSite{}.fdi; }
};

}  // namespace assets
