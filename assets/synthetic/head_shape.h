// The head as one solid: skull, soft face, closed eyes, nose, opened mouth with its cavity. Signed distance, negative
// inside. Frame of the mandible with the operated side at +x (face_frames.h), mm. Immutable; any thread reads; about 1
// us a query. Measures: adult means of facial anthropometry (Farkas, Anthropometry of the Head and Face, 1994),
// rounded; shapes are our own modelling. Not a measured person.
#pragma once

#include "assets/synthetic/mouth_rim.h"

namespace assets {

class HeadShape {
 public:
  HeadShape();

  /// The whole head.
  double distance_mm(const glm::dvec3& p) const;
  /// The head with the mouth closed over: skin only.
  double closed_mm(const glm::dvec3& p) const;
  /// The hollow of the mouth, without the gums and palate that stand in it.
  double cavity_mm(const glm::dvec3& p) const;
  const MouthRim& rim() const { return rim_; }

 private:
  MouthRim rim_;
};

}  // namespace assets
