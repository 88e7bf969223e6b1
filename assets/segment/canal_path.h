// A proposal for the mandibular canal of each side: the cheapest way through dark tubes (tubeness.h) inside the bone,
// at a high cost through teeth and along the surface, then centred on the darkness across it. Between its ends it
// follows the canal; the ends, in the ramus above the bite and in the body below the premolars, are guesses of anatomy
// and may miss by several millimetres. A person must confirm it before distances to it count. Frame P, mm. Any thread
// but the servo; 10 s for both sides at 0.35 mm on two cores. Where a person has clicked both ends (and points between)
// the way leads through those places instead: then only its course is computed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assets/segment/half_jaw.h"
#include "assets/segment/tooth_numbers.h"

namespace assets {

struct CanalProposal {
  bool is_right = true;
  std::vector<glm::dvec3> line_P_mm;  ///< about 1 mm apart, from the front
  double radius_mm = 1.3;             ///< usual in the body of the jaw; not measured
  bool is_confirmed = false;          ///< a person gave its ends
};

/// Of the canals that a person has clicked that of one side; empty: none. Throws LoadError for a second one.
std::vector<glm::dvec3> canalClicksOn(const JawArch& arch, std::span<const std::vector<glm::dvec3>> clicks,
                                      bool is_right);

/// The canal of one side; none without a way from end to end. `clicks`: where a person has clicked it, from one end to
/// the other, or none. Throws LoadError for clicks off the bone or nearer than 15 mm.
std::optional<CanalProposal> canalOn(const CanalScene& scene, const std::vector<FoundTooth>& teeth,
                                     const std::vector<glm::dvec3>& clicks, bool is_right);

/// A fingerprint of what of the teeth a side's canal depends on: where they are, and where its premolars are.
std::uint64_t canalTeeth(const CanalScene& scene, const std::vector<FoundTooth>& teeth, bool is_right);

}  // namespace assets
