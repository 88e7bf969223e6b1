// Chips that have come loose, as particles: they fall through blood and water, slide down what is steeper than their
// friction, and rest on bone, tooth or soft tissue, until a suction tip takes them. Each is also known by the voxel
// where it broke off: solid there again, by an undo, it is back in the bone; and loose again with the redo. A function
// of ticks, bytes and tips alone: 100 steps a second of the rehearsal. Frame P, mm. Main thread; a microsecond a moving
// chip and step. Numbers are our defaults (reference/extraction 9).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/procedure/debris/suction_tip.h"
#include "assets/soft_tissue_field.h"
#include "haptics/body/bodies.h"
#include "haptics/body/chip_plan.h"
#include "haptics/servo/tick.h"

namespace app {

inline constexpr double kChipFriction = 0.6, kChipFall_mm_per_s = 30.0;

struct LooseChip {
  enum class State : std::uint8_t { loose, taken, in_bone };
  haptics::Chip chip;
  State state = State::loose;
  glm::dvec3 at_P_mm{0.0}, broke_off_P_mm{0.0};
  double radius_mm = 0.1;  ///< of a ball of its volume
  bool rests = false;
  double restored_mm3 = 0.0;  ///< Tick::restored_total_mm3 when it went back
};

class LooseChips {
 public:
  /// Borrows bodies and soft tissue. `down_P`: unit, along gravity.
  LooseChips(const haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P);

  /// Chips that have just left the volumes, with the poses of the pieces.
  void add(const haptics::ChipPlan& plan, const haptics::Tick& tick);
  /// Bricks of the jaw's grid that have changed; pieces that have moved count as gone.
  void followBone(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);
  /// Every tick, in order. `tip`: of the tool in the hand; none: it is no suction.
  void follow(const haptics::Tick& tick, const std::optional<SuctionTip>& tip);

  const std::vector<LooseChip>& chips() const { return chips_; }
  /// Jaw and pieces at rest, in the order of the jaw's grid, as followBone() saw them.
  std::span<const std::uint8_t> solid() const { return solid_; }
  /// Nothing solid is nearer than that, as followBone() saw it.
  bool isBare(const glm::dvec3& p_P_mm, double within_mm) const;
  /// Still in the mouth; taken out.
  std::vector<const LooseChip*> left() const;
  std::vector<const LooseChip*> taken() const;

 private:
  double densityAt(const glm::dvec3& p_P_mm) const;
  bool isFree(const glm::dvec3& p_P_mm) const { return densityAt(p_P_mm) < 0.5; }
  glm::dvec3 outward(const glm::dvec3& p_P_mm) const;
  void fall(LooseChip& chip) const;
  bool isBackInBone(const LooseChip& chip) const;

  const haptics::Bodies& bodies_;
  const assets::SoftTissueField& soft_tissue_;
  glm::dvec3 down_P_;
  std::vector<std::uint8_t> solid_;  ///< jaw and pieces at rest, in the order of the jaw's grid
  std::array<bool, haptics::kMaxPieces> at_rest_{};
  std::vector<LooseChip> chips_;
  double step_s_ = 0.0;  ///< since the last step
};

}  // namespace app
