// The tooth that is operated on. Frame P (LPS mm). Plain data; any thread.
#pragma once

#include <glm/glm.hpp>

namespace assets {

struct OperativeSite {
  int fdi = 48;                 ///< tooth.h
  glm::dvec3 centre_P_mm{0.0};  ///< centroid of its hard tissue
  glm::dvec3 axis_P{0, 0, 1};   ///< unit, along the tooth from root to crown
};

}  // namespace assets
