// Blocks of bone for practice, each with one task and the volume that is to go: a plate to be thinned from 3 to 1 mm
// over 10 x 8 mm, a groove 6 mm long and 2 mm deep for a bur of 2 mm, and a ball of enamel under 2 mm of bone, in a
// shell of soft tissue, to be uncovered down to its middle without touching it. Frame P, mm, the middle of the block's
// face at the origin; frame of the block: x along the work, y across, z out of the face, which leans towards the
// surgeon's eye. No tooth, no canal, no soft tissue. Any thread; about 0.1 s.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "assets/patient.h"
#include "assets/planned_cut.h"

namespace assets {

enum class PracticeTask : std::uint8_t { plate, groove, ball };

struct PracticeText {
  std::string_view key;          ///< in sessions and as a case: "block-plate"
  std::string_view title;        ///< of the patient
  std::string_view instruction;  ///< for the surgeon, one line
  double bur_radius_mm;          ///< of the round bur that it is made for
};
inline constexpr std::array<PracticeText, 3> kPracticeTasks{
    {{"block-plate", "practice block: a plate to thin",
      "Thin the plate to 1 mm over 10 x 8 mm, without breaking through", 1.5},
     {"block-groove", "practice block: a groove", "Cut a groove 6 mm long and 2 mm deep, as wide as the 2 mm bur", 1.0},
     {"block-ball", "practice block: a buried ball", "Uncover the ball down to its middle, without touching it", 1.0}}};
inline const PracticeText& textOf(PracticeTask task) { return kPracticeTasks[static_cast<std::size_t>(task)]; }
std::optional<PracticeTask> practiceTaskOf(std::string_view key);

/// Of all: 0.15 to 1 mm.
inline constexpr double kPracticeVoxel_mm = 0.2;

Patient practiceBlock(PracticeTask task, double spacing_mm = kPracticeVoxel_mm);

/// From P into the frame of the block, which has the same origin.
glm::dvec3 inBlock(const glm::dvec3& p_P_mm);
/// From the frame of the block.
glm::dvec3 fromBlock(const glm::dvec3& q_mm);

/// Signed distance to what is to go, negative inside; beyond the block's face it goes on outwards.
double fromTarget_mm(PracticeTask task, const glm::dvec3& p_P_mm);

/// The strokes of a round bur that take what is to go, for a scripted hand.
PlannedCut practiceCut(PracticeTask task, double bur_radius_mm);

/// Of the plate, where its thickness is measured, and of the ball.
inline constexpr glm::dvec2 kPlateWindow_mm{4.5, 3.5};  ///< half edges
inline constexpr double kPlateBack_mm = -3.0, kPlateLeft_mm = 1.0, kBallRadius_mm = 2.5, kBallMiddle_mm = -4.5;

}  // namespace assets
