// The mucoperiosteal flap as it is held open: a relieving incision in front of the wound, and the flap folded over the
// cheek's side of the wound's edge, as thick as gingiva, its raw underside up. Signed distances, negative inside.
// Envelope flap with a relieving incision (Koerner 2006); how far it folds is our own choice: it stays under the cheek
// retractor. The flap keeps out of the wound, so it never stands between the cut and the eye. Frame P, mm. Any thread;
// a query takes about 0.5 us.
#pragma once

#include <functional>

#include "assets/planned_cut.h"
#include "assets/scenery/gingiva_surface.h"

namespace assets {

class ReflectedFlap {
 public:
  static constexpr double kFolded_mm = 4.2;  ///< from the fold to the free edge
  static constexpr double kLift_mm = 1.8;    ///< of the free edge
  static constexpr double kNone_mm = 10.0;   ///< the distance where there is no flap near
  /// The gingiva's distances are read up to here outside of it.
  static constexpr double kReach_mm = kFlapThickness_mm + kLift_mm + 1.65;
  /// mm outside the gingiva as it was before the wound was cut, negative inside.
  using GingivaDistance = std::function<double(const glm::dvec3& p_P_mm)>;

  /// `wound` is borrowed and must outlive this object.
  ReflectedFlap(const PlannedCut& cut, const Wound& wound, GingivaDistance gingiva_mm);

  /// Only there are flap and incision; elsewhere both distances are kNone_mm.
  bool isOnCheekSide(const glm::dvec3& p_P_mm) const;
  /// Distance to the folded flap.
  double distance_mm(const glm::dvec3& p_P_mm) const;
  /// Distance to the relieving incision.
  double incision_mm(const glm::dvec3& p_P_mm) const;

 private:
  double towardsCheek(const glm::dvec3& p_P_mm) const;

  const Wound& wound_;
  GingivaDistance gingiva_mm_;
  glm::dvec3 middle_P_mm_, buccal_P_, mesial_P_;
  glm::dvec3 corner_P_mm_, along_P_, across_P_;  ///< of the incision; across: forwards
};

}  // namespace assets
