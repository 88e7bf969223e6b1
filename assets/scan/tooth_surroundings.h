// What lies around a tooth, from the labels of its scan: the distance to hard tissue that is not its own, and which
// tissue a place is. Labels of a scan are steps of its voxels; the distance between them is smooth. Frame P, mm.
// Immutable; any thread; some 30 ms of CPU to make, 10 ns a point.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/structure_distance.h"

namespace assets {

class ToothSurroundings {
 public:
  /// Around the box; a volume of no voxels: air.
  ToothSurroundings(const CtVolume& ct, int fdi, const glm::dvec3& low_P_mm, const glm::dvec3& high_P_mm);

  /// Negative in bone and other teeth; at most 2 mm.
  double hard_mm(const glm::dvec3& p_P_mm) const {
    return hard_.isEmpty() ? StructureDistance::kReach_mm : hard_.near_mm(p_P_mm);
  }
  /// Of the nearest voxel, as hard or as soft tissue, whatever it is labelled.
  std::uint8_t label(const glm::dvec3& p_P_mm, bool is_hard) const;
  /// The label of all places of a box; none: they differ.
  std::optional<std::uint8_t> label(const glm::dvec3& low_P_mm, const glm::dvec3& high_P_mm, bool is_hard) const;

 private:
  glm::ivec3 nearest(const glm::dvec3& p_P_mm) const;
  const std::vector<std::uint8_t>& labels(bool is_hard) const { return is_hard ? hard_label_ : soft_label_; }

  VolumeGrid grid_;
  StructureDistance hard_;
  std::vector<std::uint8_t> hard_label_, soft_label_;
};

}  // namespace assets
