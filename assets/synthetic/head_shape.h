// The head as one solid: skull, face, closed eyes, nose, open mouth with its cavity. Signed distance, negative inside.
// Frame of the mandible with the operated side at +x (face_frames.h), mm. Immutable; any thread; about 1 us a query.
// Measures: adult means (Farkas, Anthropometry of the Head and Face, 1994), rounded; shapes are our own modelling.
#pragma once

#include "assets/synthetic/face_frames.h"
#include "assets/synthetic/mouth_rim.h"

namespace assets {

class HeadShape {
 public:
  explicit HeadShape(const MouthOpening& opening);

  /// The whole head.
  double distance_mm(const glm::dvec3& p) const;
  /// Skin only, without mouth opening.
  double closed_mm(const glm::dvec3& p) const;
  /// The cavity of the mouth, without the gingiva and palate.
  double cavity_mm(const glm::dvec3& p) const;
  const MouthRim& rim() const { return rim_; }
  const MouthOpening& opening() const { return opening_; }

 private:
  MouthOpening opening_;
  double cheek_raised_mm_, cavity_raised_mm_;  ///< of their upper ends, which belong to the upper jaw
  MouthRim rim_;
};

}  // namespace assets
