// The patient of a rehearsal: CT, mandibular canal, operative site, gingiva and face, all in frame P (LPS mm). Contains
// no name, date or identifier of a person; the folder's name names the case. Immutable after loading; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/mesh.h"
#include "assets/metal_fragment.h"
#include "assets/operative_site.h"
#include "assets/prepared_tooth.h"
#include "assets/proposed.h"
#include "assets/tooth_canals.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace assets {

/// Solid fraction from grey values: solid = cdf((HU - iso) / sigma), see solid_fraction.h.
struct Classification {
  double iso_hu = 300.0;
  double sigma_hu = 75.0;
};

/// What a person has confirmed of what the program found in a scan without labels.
struct Confirmation {
  bool tooth = false, canal = false;
};

struct Patient {
  std::string title;                  ///< one line, e.g. "built-in patient, right, mesio-angular 45°"
  std::optional<Confirmation> found;  ///< none: tooth and canal came with the scan
  CtVolume ct;
  Classification classification;
  std::optional<OperativeSite> site;              ///< none: no suitable tooth is labelled
  std::optional<ToothCanals> canals;              ///< of the tooth that the volume holds, for root-canal treatment
  std::vector<MetalFragment> fragments;           ///< of files that broke in it before
  std::optional<PreparedTooth> prepared;          ///< for a restoration; the volume holds it and its neighbours
  glm::dvec3 jaw_P_mm{0.0};                       ///< centre of the lower jaw, or of all solid
  std::vector<glm::dvec3> mandibular_canal_P_mm;  ///< centre line of the mandibular canal, empty if unknown
  double mandibular_canal_radius_mm = 1.4;
  MeshModel gingiva;  ///< surface with the flap raised around the site; may be empty
  MeshModel face;     ///< may be empty
  /// It is the built-in one, placed by the teeth: what a face is like, not the patient's.
  bool has_built_in_face = false;
  /// The head around the jaw, by the lower teeth; none: as the scan lies.
  std::optional<calibration::Pose<calibration::Patient, calibration::Face>> X_PF;
  /// A layer of usual thickness over the bone, not the patient's (import/modelled_gum.h).
  bool has_modelled_gum = false;

  Proposed proposed() const {
    if (!found) return {};
    return {(site || canals) && !found->tooth, !mandibular_canal_P_mm.empty() && !found->canal};
  }
  bool isProposed() const { return proposed().any(); }
  /// For people: the title, and what it is to be taken with.
  std::string shownTitle() const { return title + (isProposed() ? std::string(kNotConfirmedTitle) : ""); }
  /// Centre of the view.
  glm::dvec3 focus_P_mm() const { return site ? site->centre_P_mm : jaw_P_mm; }
  /// Decides the patient's position; the default site where none is known.
  int operatedTooth() const {
    if (prepared) return prepared->fdi;
    return site ? site->fdi : canals ? canals->fdi : OperativeSite{}.fdi;
  }
};

}  // namespace assets
