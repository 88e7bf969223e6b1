// What keeps the pieces of the operated tooth in, from a copy of the live bodies: the ways out (ways_out) in the words
// of the record, and the bone to take away before the next piece comes. Frame P, mm. Worker threads; 0.2 to 5 s a
// piece; allocates. The same bytes give the same findings.
#pragma once

#include <stop_token>
#include <vector>

#include "app/procedure/bodies_copy.h"
#include "app/procedure/ways_out.h"
#include "app/session/way_event.h"
#include "assets/patient.h"

namespace app {

struct WayFindings {
  WayRecord record;
  std::vector<glm::dvec3> bone_P_mm;  ///< middles of the voxels of bone in the way of nextKept()
  double voxel_mm = 0.0;              ///< their edge
};

class WaySearch {
 public:
  /// Borrows the patient, which has a site. `bodies`: before the first tick, with a tooth.
  WaySearch(const assets::Patient& patient, const haptics::Bodies& bodies);

  /// `bodies`: pieces as copyOfPieces() gave them, which are laid where they are. `pieces`: how many bodies the tooth
  /// is in.
  WayFindings find(BodiesCopy& bodies, std::size_t pieces, const std::stop_token& stop) const;

 private:
  std::vector<std::string> namesOf(const BodiesCopy& bodies, const haptics::Components& tooth, std::size_t count,
                                   bool is_whole) const;

  const assets::Patient& patient_;
  WayUp up_;
  assets::VolumeGrid piece_grid_;
  std::vector<std::uint8_t> label_;  ///< on the pieces' grid, at rest
  double enamel_voxels_ = 0.0;       ///< of the whole tooth
  glm::dvec3 middle_P_mm_{0.0};      ///< alike
};

}  // namespace app
