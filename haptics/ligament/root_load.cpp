#include "haptics/ligament/root_load.h"

#include <algorithm>
#include <cmath>

#include "haptics/body/bridge_strength.h"

namespace haptics {
namespace {

constexpr int kMostInChunk = RootGroups::kMostRows * static_cast<int>(kSampleLanes);
constexpr double kBesideTip_mm = 2.0;  ///< beyond a section's edge an instrument is at another root

/// What the samples remember now, beside what the groups hold.
struct Gathered {
  alignas(64) float rest_gap[kMostInChunk], torn[kMostInChunk], fluid[kMostInChunk], strain[kMostInChunk],
      widened[kMostInChunk];
};

void gather(const RootGroups& groups, const RootGroups::Chunk& chunk, const HoldSamples& from, Gathered& now) {
  for (int n = 0; n < chunk.count; ++n) {
    const std::int32_t sample = groups.sample[static_cast<std::size_t>(chunk.first + n)];
    const bool is_bound = chunk.has_ligament && sample >= 0;
    now.rest_gap[n] = sample >= 0 ? from.rest_gap[sample] : -1e3F;
    now.torn[n] = is_bound ? from.torn[sample] : 0.0F;
    now.fluid[n] = is_bound ? from.fluid[sample] : 0.0F;
    now.strain[n] = is_bound ? from.strain[sample] : 0.0F;
    now.widened[n] = is_bound ? from.widened[sample] : 0.0F;
  }
}

bool isBeyond(const Bridge& section, const glm::dvec3& p_Q_mm) {
  const glm::dvec3 off = p_Q_mm - section.centre_mm;
  const double along_mm = glm::dot(off, section.normal);
  return along_mm > 0.0 && glm::length(off - along_mm * section.normal) < section.half_width_mm + kBesideTip_mm;
}

}  // namespace

std::optional<RootLoaded> RootLoad::follow(const RootGroups& groups, const PieceHold& hold,
                                           const DistanceField* obstacles, const RootTool& tool,
                                           double period_s) noexcept {
  if (groups.chunks.empty() || groups.sections.empty()) return {};
  const PiecePose& X_PQ = hold.state().X_PQ;
  if (next_ < groups.chunks.size()) {
    const RootGroups::Chunk& chunk = groups.chunks[next_];
    const PieceHold::KernelInput input = hold.inputAt(X_PQ, obstacles, period_s);
    Gathered now;
    gather(groups, chunk, input.samples, now);
    const auto at = [&](const std::vector<float>& of) { return of.data() + chunk.first; };
    const HoldSamples some{at(groups.place_mm[0]),
                           at(groups.place_mm[1]),
                           at(groups.place_mm[2]),
                           at(groups.normal[0]),
                           at(groups.normal[1]),
                           at(groups.normal[2]),
                           at(groups.area_mm2),
                           at(groups.width_mm),
                           now.rest_gap,
                           now.torn,
                           now.fluid,
                           now.strain,
                           now.widened,
                           chunk.has_ligament ? chunk.count : 0,
                           chunk.count};
    const HoldSums sums = sumHold(input.law, some, input.place);
    for (std::size_t section = 0; section < groups.sections.size(); ++section)
      if ((chunk.beyond >> section & 1U) != 0)
        for (std::size_t axis = 0; axis < 6; ++axis) sums_[section][axis] += sums.gradient[axis];
    ++next_;
  }
  if (next_ < groups.chunks.size()) return {};

  const glm::dquat from_P = glm::conjugate(X_PQ.rotation);
  const glm::dvec3 tool_Q_mm = from_P * (tool.at_P_mm - X_PQ.translation_mm);
  const glm::dvec3 tool_N = from_P * tool.on_piece.force_N.xyz, tool_Nmm = from_P * tool.on_piece.torque_Nmm.xyz;
  RootLoaded most;
  for (std::size_t n = 0; n < groups.sections.size(); ++n) {
    const Bridge& section = groups.sections[n].section;
    const Six& sum = sums_[n];
    glm::dvec3 force_N = -1.0 * (from_P * glm::dvec3(sum[0], sum[1], sum[2]));
    glm::dvec3 moment_Nmm = -1.0 * (from_P * glm::dvec3(sum[3], sum[4], sum[5])) +
                            glm::cross(hold.samples().centre_Q_mm - section.centre_mm, force_N);
    if (isBeyond(section, tool_Q_mm)) {
      force_N += tool_N;
      moment_Nmm += tool_Nmm + glm::cross(tool_Q_mm - section.centre_mm, tool_N);
    }
    const BridgeLoad load{glm::dot(force_N, section.normal), glm::dot(moment_Nmm, section.width_axis),
                          glm::dot(moment_Nmm, section.floorwards())};
    const double share = shareOfBreakingRoot(section, groups.sections[n].enamel_share, load);
    if (share > most.share)
      most = {n, share, glm::length(force_N),
              std::sqrt(load.bending_u_Nmm * load.bending_u_Nmm + load.bending_v_Nmm * load.bending_v_Nmm)};
  }
  restart();
  return most;
}

}  // namespace haptics
