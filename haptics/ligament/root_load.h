// What a root passes on at each of its sections: the forces of ligament, wall and contact on all that lies beyond it,
// gathered in rounds of a few samples a tick, as what holds a piece changes slowly. RootGroups are made with the
// piece's site, on a worker (allocates); RootLoad is the servo's: some 2 us a tick for kMostRows rows of sixteen
// samples, a round of 600 samples takes 15 ticks; no allocation, no throw. Forces and torques in frame Q, N and N mm.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "haptics/body/root_section.h"
#include "haptics/ligament/piece_hold.h"
#include "haptics/wrench.h"

namespace haptics {

struct RootGroups {
  static constexpr int kMostRows = 4;

  /// Samples that lie beyond the same sections, all with ligament or all without; a multiple of sixteen.
  struct Chunk {
    int first = 0, count = 0;
    std::uint16_t beyond = 0;  ///< as in RootSections
    bool has_ligament = false;
  };
  std::vector<RootSection> sections;
  std::vector<Chunk> chunks;
  std::vector<std::int32_t> sample;  ///< of the hold; below 0: padding
  std::array<std::vector<float>, 3> place_mm, normal;
  std::vector<float> area_mm2, width_mm;
};

/// `grid`: of the sections. The samples are those of the site's hold.
RootGroups rootGroups(RootSections found, const assets::VolumeGrid& grid, const PieceSamples& samples);

/// What an instrument does to the piece.
struct RootTool {
  Wrench<calibration::Patient> on_piece{};
  glm::dvec3 at_P_mm{0.0};  ///< the torque is about this
};

/// The section that is loaded most.
struct RootLoaded {
  std::size_t section = 0;
  double share = 0.0;  ///< 1 breaks it
  double force_N = 0.0, bending_Nmm = 0.0;
};

class RootLoad {
 public:
  /// One tick of a piece that is held. A result once a round.
  std::optional<RootLoaded> follow(const RootGroups& groups, const PieceHold& hold, const DistanceField* obstacles,
                                   const RootTool& tool, double period_s) noexcept;
  /// Begins anew, with another piece or none.
  void restart() noexcept { *this = {}; }

 private:
  using Six = std::array<double, 6>;
  std::array<Six, kMostRootSections> sums_{};  ///< gradients beyond each section
  std::size_t next_ = 0;                       ///< chunk
};

}  // namespace haptics
