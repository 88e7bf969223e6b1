// What the segmentation of a jaw reaches on scans with known teeth, and how long it takes: segment_bench PATIENTS
// [SPACING_MM…]: right_third_molar of the shared data's patients and its mirror image, or head phantoms of these
// voxels, plain or (m0.56) with metal. Dice against truth, seconds of the wall clock by stage.

#include <fmt/core.h>

#include <algorithm>
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

/// A side's true canal where it is labelled: where a root lies on it nobody knows its course.
struct TrueCanal {
  std::vector<glm::dvec3> line_P_mm, labelled_P_mm;
};
TrueCanal truthOf(const Case& scan, const assets::CanalProposal& canal) {
  const auto found = assets::mandibularCanalLine(scan.grid, scan.tissue, canal.line_P_mm[canal.line_P_mm.size() / 2]);
  if (!found || found->line_P_mm.size() < 10) return {};
  TrueCanal truth{{found->line_P_mm.begin() + 2, found->line_P_mm.end() - 2}, {}};
  for (const glm::dvec3& p : truth.line_P_mm) {
    const glm::ivec3 at(glm::floor(scan.grid.indexFromPoint(p) + 0.5));
    const std::uint8_t here = scan.grid.contains(at) ? scan.tissue[scan.grid.index(at)] : std::uint8_t{0};
    if (assets::Tissue{here} == assets::Tissue::mandibular_canal) truth.labelled_P_mm.push_back(p);
  }
  return truth;
}

/// Mean and most, mm, from points of the truth to a line, between its points too: these lie a millimetre apart.
std::pair<double, double> misses(const std::vector<glm::dvec3>& truth, const std::vector<glm::dvec3>& line) {
  double sum = 0.0, most = 0.0;
  for (const glm::dvec3& p : truth) {
    double away = 1e9;
    for (std::size_t n = 1; n < line.size(); ++n) {
      const glm::dvec3 way = line[n] - line[n - 1];
      const double share = std::clamp(glm::dot(p - line[n - 1], way) / std::max(glm::dot(way, way), 1e-12), 0.0, 1.0);
      away = std::min(away, glm::distance(p, line[n - 1] + share * way));
    }
    sum += away / static_cast<double>(truth.size());
    most = std::max(most, away);
  }
  return {sum, most};
}

/// Both ends clicked, each half a millimetre off, by 20 hands.
void judgeClicks(assets::JawFinder& finder, const Case& scan, const assets::CanalProposal& proposal) {
  const TrueCanal truth = truthOf(scan, proposal);
  if (truth.labelled_P_mm.empty()) return;
  std::mt19937 random(3);
  std::normal_distribution<double> error(0.0, 0.5 / std::sqrt(3.0));
  const auto near = [&](const glm::dvec3& p) { return p + glm::dvec3(error(random), error(random), error(random)); };
  std::vector<double> means;
  double most = 0.0;
  for (int hand = 0; hand < 20; ++hand) {
    const std::vector<glm::dvec3> ends{near(truth.line_P_mm.front()), near(truth.line_P_mm.back())};
    const assets::JawSegmentation jaw = finder.withClicks({{}, {ends}});
    for (const assets::CanalProposal& canal : jaw.canals) {
      if (!canal.is_confirmed) continue;
      const auto [mean, worst] = misses(truth.labelled_P_mm, canal.line_P_mm);
      means.push_back(mean);
      most = std::max(most, worst);
    }
  }
  std::ranges::sort(means);
  if (means.empty()) return;
  fmt::print("canal {} of two clicks, {} hands: median {:.2f}, 95 % {:.2f}, worst place {:.1f} mm\n",
             proposal.is_right ? "right" : "left", means.size(), means[means.size() / 2],
             means[static_cast<std::size_t>(0.95 * static_cast<double>(means.size() - 1))], most);
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
  assets::JawFinder finder(scan.grid, scan.grey, next);
  const assets::JawSegmentation jaw = finder.withClicks({}, next);
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
  for (const assets::CanalProposal& canal : jaw.canals) judgeClicks(finder, scan, canal);
  std::fputs(tests::comparison(scan.grid, jaw, scan.tissue, scan.tooth, scan.mandible).c_str(), stdout);
}

/// Left for right.
Case mirrored(const Case& scan) {
  Case out = scan;
  out.name = scan.name + ", mirrored";
  assets::forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t from = scan.grid.index({scan.grid.size.x - 1 - ijk.x, ijk.y, ijk.z});
    const std::uint8_t fdi = scan.tooth[from];
    out.grey[v] = scan.grey[from], out.tissue[v] = scan.tissue[from], out.mandible[v] = scan.mandible[from];
    out.tooth[v] = static_cast<std::uint8_t>(fdi == 0 ? 0 : fdi < 40 ? fdi + 10 : fdi - 10);
  });
  return out;
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
    judge(mirrored(dev));
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
