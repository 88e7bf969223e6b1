// What a scripted hand does next to remove an impacted lower third molar, from how bone and tooth are now: part the
// tooth, break what still holds it, take away the bone in a piece's way, or take a piece out. It sees what the surgeon
// would see at best: the solid that is left, and the labels of the scan. Frame P, mm. Any thread, one at a time; some
// seconds a step; allocates. The same bytes give the same step.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "app/procedure/bodies_copy.h"
#include "app/procedure/third_molar/section_choice.h"
#include "app/procedure/third_molar/section_plan.h"
#include "app/procedure/ways_out.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// Gum that is whole is cut through or raised, as it was planned (flap_work).
struct FlapStep {
  bool raises = false;
};

/// A cut with the direction of the bur's shaft.
struct CutStep {
  assets::PlannedCut cut;
  bool bares_crown = false;  ///< the gutter, with the first bur of the tray
};

/// An elevator twisted in the slot that the last section left, which breaks a bridge (haptics/body/bridge_strength).
struct SplitStep {
  glm::dvec3 tip_P_mm{0.0};           ///< of the blade, over the slot's floor
  glm::dvec3 along_P{1.0, 0.0, 0.0};  ///< unit, along the slot: the blade's width
  glm::dvec3 out_P{0.0, 0.0, 1.0};    ///< unit, square to it: the shaft
};

struct DeliveryStep {
  std::size_t piece = 0;                      ///< of the bodies
  std::vector<haptics::PiecePose> path_X_PQ;  ///< from where it lies to outside
  glm::dvec3 grip_P_mm{0.0};                  ///< middle between the beaks
  glm::dvec3 rock_axis_P{1.0, 0.0, 0.0};      ///< unit: it is rocked to cheek and tongue about it
  glm::dvec3 out_P{0.0, 0.0, 1.0};            ///< unit
};

/// What cleans the socket, at the end.
enum class Cleaning : std::uint8_t { suction, curette, file, stitch };
inline constexpr std::size_t kCleanings = 4;

/// One place, an edge, a stretch of the wall.
struct CleaningPlace {
  /// On the surface of what is scraped or filed; else of the middle of the instrument's tip. Not empty.
  std::vector<glm::dvec3> way_P_mm;
  glm::dvec3 shaft_P{0.0, 0.0, 1.0};  ///< unit, to the handle: clear of bone and teeth
  std::vector<glm::dvec3> into_P;     ///< unit, into what is scraped or filed, one after the other; empty: nothing
};

struct CleaningStep {
  Cleaning what = Cleaning::suction;
  std::vector<CleaningPlace> places;  ///< not empty
  glm::dvec3 out_P{0.0, 0.0, 1.0};    ///< unit
};

struct EndStep {
  std::string why_not;  ///< the tooth could not be taken out; empty: it is out
};

struct OperationStep {
  std::variant<FlapStep, CutStep, SplitStep, DeliveryStep, CleaningStep, EndStep> what;
  std::string words;  ///< for people, "part the tooth"
};

class OperationPlanner {
 public:
  /// The patient as scanned, with an operated lower third molar of its own. `bur_radius_mm`: of a round one, for
  /// section and clearing. `with_elevator`: what no bur may cut is twisted apart.
  OperationPlanner(const assets::Patient& patient, double bur_radius_mm, bool with_elevator = false);

  /// Unit, out of the socket.
  const glm::dvec3& out_P() const { return up_.direction_P; }
  /// Outer surface of the jaw where it faces the tongue, as scanned.
  const std::vector<glm::dvec3>& tongue_P_mm() const { return tongue_P_mm_; }
  /// `first_voxel`: of the pieces' grid in the jaw's. Every call is a step: it counts what was tried.
  OperationStep next(const BodiesCopy& bodies, const assets::VolumeGrid& piece_grid, glm::ivec3 first_voxel);

 private:
  /// What is left, with the tooth as the servo has it: it fades into the bone and is broader than its labels by a part
  /// of a voxel.
  assets::Patient withToothOf(std::span<const std::uint8_t> tooth_solid, const assets::VolumeGrid& piece_grid,
                              glm::ivec3 first_voxel) const;
  std::optional<PlannedSection> planned(const SiteSolid& site, int pass, std::optional<double> tongue_mm) const;
  /// mm³ once this patient's first section was made; none: there is no such section.
  std::optional<double> inTheWayOf(const assets::Patient& patient, const UncutSite& uncut) const;
  std::optional<assets::PlannedCut> nextSection(const assets::Patient& patient);
  bool isParted(double largest_mm3) const;
  /// None: nothing worth a name is left, or it was tried often enough.
  std::optional<OperationStep> takeFragment(const BodiesCopy& bodies, const assets::VolumeGrid& piece_grid,
                                            const haptics::Components& tooth);
  OperationStep twist(const SplitStep& slot, double largest_mm3);
  static OperationStep cutStep(assets::PlannedCut cut, std::string words);
  OperationStep deliver(const PieceWay& way, const BodiesCopy& bodies, const assets::VolumeGrid& piece_grid,
                        const haptics::Components& tooth) const;

  assets::Patient now_;  ///< its solid is what is left
  std::vector<glm::dvec3> tongue_P_mm_;
  double bur_radius_mm_;
  bool with_elevator_;
  std::vector<SplitStep> slots_;      ///< of the sections, not twisted in yet
  std::optional<SplitStep> twisted_;  ///< the last step; none: another
  double twisted_mm3_ = 0.0;          ///< of the largest piece before it
  WayUp up_;
  double whole_mm3_ = 0.0;        ///< of the tooth before it was parted; 0: not looked at yet
  int spared_ = 0, through_ = 0;  ///< sections planned short of the tongue's side, and through
  bool is_cut_ = false;           ///< by one of them
  bool is_broad_ = false;         ///< sections are planned of the servo's tooth, not of its labels
  bool is_twist_due_ = false;     ///< what a spared section has left may break
  int fragments_tried_ = 0;
  int tries_ = 0;  ///< since a piece was taken out or parted
  std::size_t pieces_left_ = 0;
  /// A way along which a piece did not come out. What is in it is cut away, and the piece pulled along it once more:
  /// what the search finds next may be farther from free.
  struct Tried {
    PieceWay way;
    glm::dvec3 centroid_P_mm{0.0};  ///< of the piece
    bool is_cleared = false;
  };
  /// A small piece that was pulled at and did not come: it may hang together with another.
  bool isStuck(const haptics::ToothPiece& piece) const;
  static bool findAgain(Tried& tried, const haptics::Components& tooth, std::size_t pieces);
  std::optional<Tried> tried_;
  std::vector<glm::dvec3> pulled_P_mm_;  ///< centroids of small pieces, since one was taken out or parted
  bool was_tried_ = false;               ///< since a piece was taken out or parted
};

}  // namespace app
