// A root canal in closed form: straight from the orifice, an arc, straight to the apex; round, its radius linear along
// the way, or the same everywhere. Frame of its own: the orifice at the origin, down is -z, the arc bends towards +x;
// above the orifice lies the open pulp chamber; the root around it is as thick everywhere, the apex open. mm, rad.
// Pure; any thread; some 30 ns a point. Distances in closed form, so that a field of any spacing can be filled (a canal
// of 0.1 to 0.3 mm lies between the voxels of a scan).
#pragma once

#include <cstdint>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

struct RootCanal {
  double straight_mm = 10.0, arc_radius_mm = 5.0, arc_rad = 0.0, apical_mm = 0.0;
  double orifice_radius_mm = 0.3, apex_radius_mm = 0.125;
  double wall_mm = 1.0;   ///< of dentine around it
  double flare_mm = 0.0;  ///< radius of the orifice's edge, less than the wall and than the straight part; 0: sharp

  struct Place {
    glm::dvec3 p_mm, along;  ///< of the centre line, towards the apex
  };

  double length_mm() const { return straight_mm + arc_radius_mm * arc_rad + apical_mm; }
  double radius_mm(double along_mm) const;
  Place at(double along_mm) const;
  /// Of the nearest place of the centre line.
  double nearest_mm(const glm::dvec3& p_mm) const;
  /// Into the dentine: positive in the wall, negative in the canal.
  double depth_mm(const glm::dvec3& p_mm) const;
  /// Between the axis at the orifice and the line from where it is left to the apex.
  double schneider_rad() const;
};

struct CanalField {
  VolumeGrid grid;
  std::vector<std::uint8_t> solid;
};

/// Solid fractions of the root on a grid that holds it, with air around.
CanalField canalField(const RootCanal& canal, double spacing_mm);

}  // namespace assets
