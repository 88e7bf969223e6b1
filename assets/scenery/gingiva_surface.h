// Gingiva as a surface with the mucoperiosteal flap raised for a planned cut: bone and tooth are bare over the whole
// cut and 2 mm around it, also where gingiva would stand between the cut and the eye; the wound's edge is rounded and
// darker, and the flap lies folded over on the cheek's side (reflected_flap.h). Its underside lies a little inside the
// bone, so the surfaces do not coincide. Never changed by a bur. Envelope flap with buccal reflection (Koerner 2006);
// the margin is our own choice. Frame P, mm. Any thread; about 1 s per 10^6 labelled voxels.
#pragma once

#include <optional>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/mesh.h"
#include "assets/planned_cut.h"
#include "assets/volume_grid.h"

namespace assets {

/// Bone bared around the cut.
inline constexpr double kFlapMargin_mm = 2.0;
/// Of the folded flap; mucoperiosteum is 1.5 to 2 mm thick.
inline constexpr double kFlapThickness_mm = 1.7;

/// Where the flap is raised for a planned cut: over the cut, between it and the eye, and in front above that too, so
/// that no papilla is left without the gingiva it stood on.
class Wound {
 public:
  explicit Wound(const PlannedCut& cut);

  /// Signed distance, negative where gingiva is removed; at most some millimetres.
  double distance_mm(const glm::dvec3& p_P_mm) const;
  glm::dvec3 low_P_mm() const { return grid_.origin_P_mm; }
  glm::dvec3 high_P_mm() const { return grid_.centre_P_mm(grid_.size - 1); }

 private:
  void sweepUp(double up, double middle_y_P_mm);

  VolumeGrid grid_;
  std::vector<float> mm_;  ///< in the order of the grid
};

/// Of wet gum at a place, and of the raw underside of a raised one; linear.
glm::vec3 gumColour(const glm::dvec3& p_P_mm);
glm::vec3 rawGumColour(const glm::dvec3& p_P_mm);
/// Of the edge of a wound.
inline constexpr glm::vec3 kWoundColour{0.30f, 0.035f, 0.03f};
inline constexpr float kWetGumRoughness = 0.16f;

/// Closed gum in two parts, the one that is raised for the cut as "Gum flap"; drawn, they are one.
MeshModel withFlapPart(const MeshModel& closed, const PlannedCut& cut);

/// "Gum" and, where there is a cut, the flap raised for it as "Gum flap"; no part where nothing is labelled gingiva.
/// Throws LoadError if labels and grid do not fit.
MeshModel gingivaSurface(const CtVolume& ct, const std::optional<PlannedCut>& cut);

}  // namespace assets
