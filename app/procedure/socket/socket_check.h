// What a surgeon looks for in the socket before closing: tooth that is left, the mandibular canal laid open, the
// lingual plate broken through, sharp edges of bone. Frame P, mm. Worker or command; some 50 ms; allocates. A pure
// function of the bytes. Definitions: reference/extraction 9, product O5, O11.
//   canal    faces between voxels of the canal and of the socket: what was solid before and is gone, and ligament
//            within kThroughLigament_mm of it; by the root: those where that is tooth (or was mostly the
//            tooth's) or ligament
//   lingual  voxels of bone that lay at the outer lingual surface, and all bone behind them up to the socket or
//            kPlate_mm deep: gone. What was open before does not count, nor what leaves with the tooth: where the plate
//            is thinner than a voxel, most of that is the tooth's
//   left     components of tooth of at least kLeastPiece_mm3 that are still in the mouth (haptics/body/components)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/procedure/socket/sharp_edges.h"
#include "app/session/socket_event.h"

namespace app {

inline constexpr double kThroughLigament_mm = 0.6, kPlate_mm = 4.0;
inline constexpr double kLeastHole_mm2 = 0.5;  ///< smaller ones are voxels at the rim

/// The whole site in the order of `grid` (assert); labels must be known.
struct SiteState {
  const assets::VolumeGrid& grid;
  std::span<const std::uint8_t> label;
  std::span<const std::uint8_t> before;      ///< solid, jaw and tooth
  std::span<const std::uint8_t> before_jaw;  ///< the jaw's share of it (assets/scan/tooth_division)
  std::span<const std::uint8_t> jaw;         ///< solid now, without the tooth
  std::span<const std::uint8_t> tooth;       ///< what is left of it in the mouth, where it lay at rest
};

/// Unit.
struct SiteDirections {
  glm::dvec3 lingual_P{1.0, 0.0, 0.0}, up_P{0.0, 0.0, 1.0};
};

struct SocketFindings {
  SocketRecord record;
  std::vector<SharpEdge> edges;  ///< those of the record, and all shorter ones, with their course
};

SocketFindings checkSocket(const SiteState& site, const SiteDirections& directions);

}  // namespace app
