// What a scripted hand does next to remove an impacted lower third molar, from how bone and tooth are now: part the
// tooth, take away the bone in a piece's way, or take a piece out. It sees what the surgeon would see at best: the
// solid that is left, and the labels of the scan. Frame P, mm. Any thread, one at a time; some seconds a step;
// allocates. The same bytes give the same step.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/procedure/ways_out.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "haptics/body/bodies.h"

namespace app {

/// Bytes of the bodies in the order of their grids; pieces that were set aside are empty.
struct BodiesCopy {
  std::vector<std::uint8_t> jaw;
  std::array<std::vector<std::uint8_t>, haptics::kMaxPieces> piece;
};
/// As the writing thread has them, or as a reading thread sees them; some 30 ms.
BodiesCopy copyOf(const haptics::Bodies& bodies);

/// A cut with the handpiece's direction.
struct CutStep {
  assets::PlannedCut cut;
  bool is_section = false;
};

struct DeliveryStep {
  std::size_t piece = 0;                              ///< of the bodies
  std::vector<haptics::Bodies::PiecePose> path_X_PQ;  ///< from where it lies to outside
  glm::dvec3 grip_P_mm{0.0};                          ///< middle between the beaks
  glm::dvec3 rock_axis_P{1.0, 0.0, 0.0};              ///< unit: it is rocked to cheek and tongue about it
  glm::dvec3 out_P{0.0, 0.0, 1.0};                    ///< unit
};

/// Nothing more to do, or to be done.
struct EndStep {
  bool is_done = false;
  std::string why;  ///< not done
};

struct OperationStep {
  std::variant<CutStep, DeliveryStep, EndStep> what;
  std::string words;  ///< for people, "part the tooth"
};

class OperationPlanner {
 public:
  /// The patient as scanned, with an operated lower third molar of its own. `bur_radius_mm`: of a round one, for
  /// section and clearing.
  OperationPlanner(const assets::Patient& patient, double bur_radius_mm);

  /// `first_voxel`: of the pieces' grid in the jaw's. Every call is a step: it counts what was tried.
  OperationStep next(const BodiesCopy& bodies, const assets::VolumeGrid& piece_grid, glm::ivec3 first_voxel);

 private:
  OperationStep cutStep(assets::PlannedCut cut, bool is_section, std::string words) const;
  OperationStep deliver(const PieceWay& way, const BodiesCopy& bodies, const assets::VolumeGrid& piece_grid,
                        const haptics::Components& tooth) const;

  assets::Patient now_;  ///< its solid is what is left
  double bur_radius_mm_;
  WayUp up_;
  std::size_t sections_ = 0;
  int tries_ = 0;  ///< since a piece was taken out or parted
  std::size_t pieces_left_ = 0;
  bool is_parted_ = false;
  /// A way that was not quite clear and did not lead out: cleared, then gone once more.
  struct Tried {
    PieceWay way;
    bool is_cleared = false;
  };
  std::optional<Tried> tried_;
  bool was_tried_ = false;  ///< since a piece was taken out or parted
};

}  // namespace app
