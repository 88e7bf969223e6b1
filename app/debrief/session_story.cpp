#include "app/debrief/session_story.h"

#include <algorithm>

#include "app/session/measures/clearance_measures.h"
#include "haptics/tool/clearance.h"

namespace app {

void SessionStory::follow(const haptics::Tick& tick, const haptics::Command& command) {
  marks_.follow(tick, command.tool);
  if (tick.t_s < next_sample_s_) return;
  next_sample_s_ = tick.t_s + kBetweenSamples_s - 0.5 * tick.dt_s;
  StorySample sample;
  sample.t_s = static_cast<float>(tick.t_s);
  sample.at_P_mm = glm::vec3(tick.proxy_P.mm);
  sample.force_N = static_cast<float>(glm::length(tick.law_force_P_N.xyz));
  sample.drilling = tick.drilling;
  if (!command.tool.grips && !has(tick.faults, haptics::Fault::bad_pose)) {
    const haptics::Clearances near_mm = haptics::clearances_mm(risks_, command.tool, heldPose(tick));
    for (std::size_t n = 0; n < near_mm.size(); ++n)
      if (near_mm[n]) sample.level = std::max(sample.level, assets::riskLevel(n, *near_mm[n]));
  }
  most_force_N_ = std::max(most_force_N_, static_cast<double>(sample.force_N));
  samples_.push_back(sample);
}

std::span<const StorySample> SessionStory::samplesBefore(double t_s, double length_s) const {
  const auto first = std::ranges::lower_bound(samples_, static_cast<float>(t_s - length_s), {}, &StorySample::t_s);
  const auto last = std::ranges::lower_bound(samples_, static_cast<float>(t_s), {}, &StorySample::t_s);
  return first < last ? std::span(first, last) : std::span<const StorySample>();
}

std::vector<render::Bead> trailOf(std::span<const StorySample> samples, TrailColour colour) {
  constexpr float kLeastApart_mm = 0.25F;
  constexpr double kRadius_mm = 0.18;
  std::vector<render::Bead> beads;
  if (colour == TrailColour::none) return beads;
  glm::vec3 last_P_mm(1e9F);
  for (const StorySample& sample : samples) {
    if (glm::distance(sample.at_P_mm, last_P_mm) < kLeastApart_mm) continue;
    last_P_mm = sample.at_P_mm;
    render::Bead bead;
    bead.at_P.mm = glm::dvec3(sample.at_P_mm);
    bead.radius_mm = kRadius_mm;
    bead.kind = render::BeadKind::trail;
    bead.number =
        colour == TrailColour::clearance
            ? static_cast<std::uint64_t>(sample.level)
            : static_cast<std::uint64_t>((sample.force_N > 1.0F) + (sample.force_N > 2.0F) + (sample.force_N > 4.0F));
    beads.push_back(bead);
  }
  return beads;
}

}  // namespace app
