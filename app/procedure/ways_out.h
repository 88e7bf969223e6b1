// Can each piece of a tooth come out of the jaw as it is now, in which order, and what is in the way, in a dentist's
// words. Frame P, mm. Worker threads or a command; 0.2 to 5 s a piece; allocates. What is said to be in the way is
// enough to take away, not the least (haptics/body/way_out.h).
#pragma once

#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "app/case/impaction_measures.h"
#include "haptics/body/components.h"
#include "haptics/body/way_out.h"

namespace app {

/// All but the tooth, as it is now.
struct AroundTooth {
  assets::VolumeGrid grid;                     ///< the pieces' grid lies on its lattice
  std::vector<std::uint8_t> solid;             ///< in the order of the grid, without the tooth
  std::span<const std::uint8_t> label, tooth;  ///< Tissue and FDI number; empty: unknown
};

/// Which way is out, and how places are named; without an arch, by their tissue alone.
struct WayUp {
  glm::dvec3 direction_P{0.0, 0.0, 1.0};  ///< unit; occlusal and buccal
  std::optional<ArchFrame> arch;
  bool is_roomy = false;  ///< haptics::WayOutGoal
};
/// Of an operated lower tooth: up and to the cheek, as the surgeon takes it out.
WayUp wayUp(const assets::Patient& patient);

struct InTheWay {
  std::string words;  ///< "distobuccal bone"
  double volume_mm3 = 0.0;
  glm::dvec3 centre_P_mm{0.0};
};

struct PieceWay {
  std::size_t piece = 0;
  std::vector<std::size_t> after;  ///< pieces that come out before it
  haptics::WayOut way;
  std::vector<InTheWay> in_the_way;                       ///< the most first
  std::vector<glm::dvec3> blockers_P_mm;                  ///< middles of the voxels in the way
  std::vector<glm::dvec3> bone_P_mm;                      ///< of these, those that are neither tooth nor piece
  double voxel_mm = 0.0;                                  ///< their edge
  std::map<std::string, double> in_the_way_mm3_by_label;  ///< by key of the tissue, "tooth_47" or "piece_1"
};

bool canCome(const haptics::WayOut& way);

/// In the order in which they come out; those that cannot come last, by number. `pieces`: how many of the components.
/// Of a search that was stopped, whatever was found.
std::vector<PieceWay> waysOut(const AroundTooth& around, const haptics::Components& tooth, std::size_t pieces,
                              const WayUp& up, const std::stop_token& stop = {});

/// "piece 0: free", "piece 1, once piece 0 is out: distobuccal bone 3.1 mm³, tooth 47 0.4 mm³ in the way".
std::string wordsOf(const PieceWay& piece);

}  // namespace app
