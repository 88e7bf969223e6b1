// What the segmentation of a jaw reaches on scans with known teeth, and how long it takes:
// segment_bench PATIENTS [SPACING_MM…]: the shared data's patients; right_third_molar, then head phantoms of these
// voxels, plain and with metal. Dice against truth, seconds of the wall clock by stage.

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>

#include "assets/import/grey_scale.h"
#include "assets/import/mandibular_canal_line.h"
#include "assets/import/shading.h"
#include "assets/scan/image_file.h"
#include "assets/segment/jaw_segmentation.h"
#include "assets/tissue.h"
#include "tests/assets/segment/head_phantom.h"
#include "tests/assets/segment/overlap.h"

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Case {
  std::string name;
  assets::VolumeGrid grid;
  std::vector<std::int16_t> grey;
  std::vector<std::uint8_t> tissue, tooth, mandible;
};

/// The true canal of a side without its outermost 2 mm.
std::vector<glm::dvec3> truthOf(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& tissue,
                                const assets::CanalProposal& canal) {
  const auto truth = assets::mandibularCanalLine(grid, tissue, canal.line_P_mm[canal.line_P_mm.size() / 2]);
  if (!truth || truth->line_P_mm.size() < 10) return {};
  return {truth->line_P_mm.begin() + 2, truth->line_P_mm.end() - 2};
}

/// Both ends of each proposed canal's truth, half a millimetre off.
assets::JawClicks clicksIn(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& tissue,
                           const assets::JawSegmentation& jaw) {
  std::mt19937 random(3);
  std::normal_distribution<double> error(0.0, 0.5 / std::sqrt(3.0));
  const auto near = [&](const glm::dvec3& p) { return p + glm::dvec3(error(random), error(random), error(random)); };
  assets::JawClicks clicks;
  for (const assets::CanalProposal& canal : jaw.canals)
    if (const auto truth = truthOf(grid, tissue, canal); !truth.empty())
      clicks.canals.push_back({near(truth.front()), near(truth.back())});
  return clicks;
}

/// Mean and most, mm, from the true line.
std::pair<double, double> missesBetween(const Case& scan, const assets::CanalProposal& canal) {
  const std::vector<glm::dvec3> truth = truthOf(scan.grid, scan.tissue, canal);
  double sum = 0.0, most = 0.0;
  for (const glm::dvec3& p : truth) {
    double away = 1e9;
    for (const glm::dvec3& q : canal.line_P_mm) away = std::min(away, glm::distance(p, q));
    sum += away / static_cast<double>(truth.size());
    most = std::max(most, away);
  }
  return {sum, most};
}

void judge(Case scan) {
  fmt::print("== {}: {} x {} x {} voxels of {} mm\n", scan.name, scan.grid.size.x, scan.grid.size.y, scan.grid.size.z,
             scan.grid.spacing_mm);
  Clock::time_point start = Clock::now();
  const assets::GreyJudgement judged = assets::judgeGreyScale(scan.grey, -32768);
  if (!judged.map) {
    fmt::print("no scale:");
    for (const auto& p : judged.peaks) fmt::print(" {:.0f} ({:.0f})", p.grey, p.height);
    fmt::print("\n");
    return;
  }
  assets::applyGreyMap(*judged.map, -32768, scan.grey);
  const double shading_hu = assets::flattenShading(scan.grid, scan.grey);
  fmt::print("HU = {:.3f} x + {:.0f}, shading {:.0f} HU, {:.1f} s\n", judged.map->slope, judged.map->offset_hu,
             shading_hu, secondsSince(start));
  std::string stage;
  std::map<std::string, double> seconds;
  start = Clock::now();
  Clock::time_point begun = start;
  const auto next = [&](std::string_view name) {
    if (!stage.empty()) fmt::print("  {:18} {:6.2f} s\n", stage, secondsSince(begun));
    stage = name;
    begun = Clock::now();
  };
  const assets::JawSegmentation jaw = assets::segmentJaw(scan.grid, scan.grey, next);
  next("");
  fmt::print("  {:18} {:6.2f} s\n", "all", secondsSince(start));
  if (jaw.refusal) {
    fmt::print("{}: {}\n", jaw.refusal->code, jaw.refusal->sentence);
    return;
  }
  fmt::print("levels: cortical {:.0f}, dentine {:.0f} HU\n", jaw.levels.cortical_hu, jaw.levels.dentine_hu);
  for (const assets::FoundTooth& tooth : jaw.teeth)
    fmt::print("  found {:2}: {:6.0f} mm3 at ({:.0f}, {:.0f}, {:.0f})\n", tooth.fdi, tooth.volume_mm3,
               tooth.centre_P_mm.x, tooth.centre_P_mm.y, tooth.centre_P_mm.z);
  if (const auto clicks = clicksIn(scan.grid, scan.tissue, jaw); !clicks.canals.empty()) {
    const assets::JawSegmentation clicked = assets::segmentJaw(scan.grid, scan.grey, {}, clicks);
    for (const assets::CanalProposal& canal : clicked.canals) {
      if (!canal.is_confirmed) continue;
      fmt::print("canal {} of two clicks: from truth {:.2f} mm, worst {:.1f} mm, between the clicks\n",
                 canal.is_right ? "right" : "left", missesBetween(scan, canal).first,
                 missesBetween(scan, canal).second);
    }
  }
  std::fputs(tests::comparison(scan.grid, jaw, scan.tissue, scan.tooth, scan.mandible).c_str(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::filesystem::path patients = argv[1];
  if (argc == 2) {
    Case dev;
    dev.name = "right_third_molar";
    assets::HounsfieldImage ct = assets::readHounsfield((patients / "right_third_molar/ct.nrrd").string());
    dev.grid = ct.grid, dev.grey = std::move(ct.hounsfield);
    dev.tissue = assets::readLabels((patients / "right_third_molar/labels.nrrd").string()).values;
    dev.tooth = tests::teethOfRightThirdMolar(patients);
    dev.mandible = dev.tissue;
    for (std::uint8_t& value : dev.mandible) value = value >= 1 && value <= 8 ? 1 : 0;
    judge(std::move(dev));
  }
  for (int n = 2; n < argc; ++n) {
    const bool has_metal = argv[n][0] == 'm';
    const double spacing_mm = std::atof(argv[n] + (has_metal ? 1 : 0));
    tests::HeadPhantom head = tests::headPhantom(patients, {.spacing_mm = spacing_mm, .has_metal = has_metal});
    judge({has_metal ? "head with metal" : "head", head.grid, std::move(head.grey), std::move(head.tissue),
           std::move(head.tooth), std::move(head.mandible)});
  }
}
