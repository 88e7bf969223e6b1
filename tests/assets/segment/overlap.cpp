#include "tests/assets/segment/overlap.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "assets/import/mandibular_canal_line.h"
#include "assets/tissue.h"

namespace tests {

std::map<int, ToothOverlap> toothOverlaps(const std::vector<std::uint8_t>& found,
                                          const std::vector<std::uint8_t>& truth) {
  std::map<int, std::array<std::size_t, 256>> both;
  std::array<std::size_t, 256> all{};
  std::map<int, std::size_t> true_voxels;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    ++all[found[v]];
    if (truth[v] == 0) continue;
    ++both[truth[v]][found[v]];
    ++true_voxels[truth[v]];
  }
  std::map<int, ToothOverlap> teeth;
  constexpr std::size_t kLeastVoxels = 200;
  for (auto& [fdi, count] : both) {
    if (true_voxels[fdi] < kLeastVoxels) continue;
    count[0] = 0;
    const auto best = static_cast<std::size_t>(std::ranges::max_element(count) - count.begin());
    teeth[fdi] = {static_cast<int>(best),
                  2.0 * static_cast<double>(count[best]) / static_cast<double>(true_voxels[fdi] + all[best])};
    if (best == 0) teeth[fdi].dice = 0.0;
  }
  return teeth;
}

std::size_t workingVoxels(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& true_tooth) {
  constexpr double kOverBite_mm = 25.0;
  int top = 0;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (true_tooth[v] != 0) top = std::max(top, ijk.z);
  });
  const int end = std::min(grid.size.z, top + static_cast<int>(kOverBite_mm / grid.spacing_mm));
  return static_cast<std::size_t>(end) * static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y);
}

CanalMisses canalMisses(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& tissue,
                        const assets::CanalProposal& canal) {
  const auto nearest = [](const std::vector<glm::dvec3>& points, const glm::dvec3& p) {
    double best = 1e9;
    for (const glm::dvec3& q : points) best = std::min(best, glm::distance(p, q));
    return best;
  };
  const auto truth = assets::mandibularCanalLine(grid, tissue, canal.line_P_mm[canal.line_P_mm.size() / 2]);
  constexpr double kNoTruth_mm = 1e9;
  if (!truth) return {kNoTruth_mm, kNoTruth_mm, kNoTruth_mm};
  CanalMisses misses;
  for (const glm::dvec3& p : truth->line_P_mm) {
    const double away = nearest(canal.line_P_mm, p);
    misses.from_truth_mm += away / static_cast<double>(truth->line_P_mm.size());
    misses.worst_mm = std::max(misses.worst_mm, away);
  }
  double count = 0.0;
  for (const glm::dvec3& p : canal.line_P_mm) {
    if (p.y < truth->line_P_mm.front().y || p.y > truth->line_P_mm.back().y) continue;
    misses.to_truth_mm += nearest(truth->line_P_mm, p);
    count += 1.0;
  }
  misses.to_truth_mm /= std::max(count, 1.0);
  return misses;
}

std::string comparison(const assets::VolumeGrid& grid, const assets::JawSegmentation& jaw,
                       const std::vector<std::uint8_t>& tissue, const std::vector<std::uint8_t>& tooth,
                       const std::vector<std::uint8_t>& mandible) {
  using assets::Tissue;
  const auto is = [](const std::vector<std::uint8_t>& values, Tissue wanted) {
    return [&values, wanted](std::size_t v) { return values[v] == static_cast<std::uint8_t>(wanted); };
  };
  const auto bone = [](const std::vector<std::uint8_t>& values) {
    return [&values](std::size_t v) { return values[v] == 1 || values[v] == 2 || values[v] == 7 || values[v] == 8; };
  };
  const std::size_t part = workingVoxels(grid, tooth);
  const auto jaw_found = [&](std::size_t v) { return jaw.label[v] != 0; };
  const auto jaw_true = [&](std::size_t v) { return mandible[v] != 0; };
  std::string text = fmt::format(
      "mandible {:.3f} (working part {:.3f}), bone without teeth {:.3f}, cortical {:.3f}, trabecular {:.3f}\n",
      diceOf(tooth.size(), jaw_found, jaw_true), diceOf(part, jaw_found, jaw_true),
      diceOf(part, bone(jaw.label), bone(tissue)),
      diceOf(part, is(jaw.label, Tissue::cortical), is(tissue, Tissue::cortical)),
      diceOf(part, is(jaw.label, Tissue::trabecular), is(tissue, Tissue::trabecular)));
  double sum = 0.0;
  int good = 0;
  const auto teeth = toothOverlaps(jaw.tooth, tooth);
  for (const auto& [fdi, overlap] : teeth) {
    text += fmt::format("  {} as {} {:.3f}", fdi, overlap.found_fdi, overlap.dice);
    sum += overlap.dice;
    good += overlap.dice >= 0.9 ? 1 : 0;
    if (fdi % 10 == 8) {
      const auto of_tooth = [&](Tissue wanted) {
        return diceOf(
            tooth.size(),
            [&](std::size_t v) {
              return jaw.tooth[v] == overlap.found_fdi && jaw.label[v] == static_cast<std::uint8_t>(wanted);
            },
            [&](std::size_t v) { return tooth[v] == fdi && tissue[v] == static_cast<std::uint8_t>(wanted); });
      };
      text += fmt::format(" (enamel {:.2f}, dentine {:.2f}, pulp {:.2f})", of_tooth(Tissue::enamel),
                          of_tooth(Tissue::dentine), of_tooth(Tissue::pulp));
    }
    text += "\n";
  }
  for (const assets::CanalProposal& canal : jaw.canals) {
    const auto [to_truth, from_truth, most] = canalMisses(grid, tissue, canal);
    text += fmt::format("canal {}: {} points, line to truth {:.2f} mm, truth to line {:.2f} mm, worst {:.1f} mm\n",
                        canal.is_right ? "right" : "left", canal.line_P_mm.size(), to_truth, from_truth, most);
  }
  text += fmt::format("teeth: mean {:.3f}, {} of {} at least 0.9\n", sum / static_cast<double>(teeth.size()), good,
                      teeth.size());
  return text;
}

}  // namespace tests
