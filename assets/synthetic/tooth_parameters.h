// Dimensions of a lower tooth: crown outline, cusps, grooves, roots, pulp. Tooth frame, mm: x mesial, y buccal, z
// occlusal; origin in the middle of the cervix. Plain data. Crown heights, diameters and root lengths: means of Ash and
// Nelson, Wheeler's Dental Anatomy, 9th ed.; shapes of cusps and grooves are our own modelling after its plates.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "assets/synthetic/implicit_shape.h"

namespace assets {

/// A rounded pyramid with four ridges.
struct CuspParameters {
  glm::dvec2 tip_mm{0.0};
  double height_mm = 7.0;
  double slope = 0.62;     ///< fall per mm, mean over directions
  double ridge_rad = 0.0;  ///< direction of one of the four ridges
};

/// A ridge of enamel between two points of the crown: marginal, transverse.
struct RidgeParameters {
  glm::dvec2 from_mm{0.0};
  glm::dvec2 to_mm{0.0};
  double height_mm = 5.5;
};

/// A developmental groove running down the side of the crown.
struct GrooveParameters {
  double direction_rad = 0.0;  ///< about z, 0 = mesial, pi/2 = buccal
  double depth = 0.08;         ///< fraction of the radius
  double width_rad = 0.2;
};

/// An ellipse swept from neck to apex along a curved path.
struct RootParameters {
  glm::dvec2 neck_mm{0.0};
  glm::dvec2 apex_mm{0.0};
  double length_mm = 13.0;
  glm::dvec2 neck_half_mm{2.3, 4.2};
  glm::dvec2 apex_half_mm{0.8, 1.2};
  double bow_mm = 0.6;  ///< mesial curvature at half length
  double hollow = 0.0;  ///< depth of the long grooves on mesial and distal face, fraction of the half width
  int canals = 1;
};

struct ToothParameters {
  std::vector<ProfileKnot> mesial_mm;  ///< half width of the crown towards mesial by height
  std::vector<ProfileKnot> distal_mm;
  std::vector<ProfileKnot> buccal_mm;
  std::vector<ProfileKnot> lingual_mm;
  double squareness = 2.6;  ///< exponent of the superellipse outline
  std::vector<CuspParameters> cusps;
  std::vector<RidgeParameters> ridges;
  std::vector<GrooveParameters> grooves;
  std::vector<RootParameters> roots;
  double pulp = 1.0;  ///< size of chamber and canals, 1 = adult, larger when young
};

/// The lower tooth at `position` 1..8 from the midline (central incisor .. third molar).
const ToothParameters& lowerToothParameters(int position);

}  // namespace assets
