#include "assets/segment/jaw_segmentation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "assets/segment/cell_filters.h"
#include "assets/segment/edited_teeth.h"
#include "assets/segment/tooth_regions.h"
#include "assets/segment/tooth_surface.h"
#include "assets/segment/tooth_tissue.h"
#include "assets/tissue.h"

namespace assets {
namespace {

constexpr double kCell_mm = 0.7, kCellSmooth_mm = 0.6;
constexpr double kLeastLower_mm3 = 300.0, kLeastUpperRow_mm3 = 500.0, kLeastJaw_mm3 = 3000.0;

JawSegmentation refused(JawRefusal refusal) {
  JawSegmentation out;
  out.refusal = std::move(refusal);
  return out;
}

double volume_mm3(const VolumeGrid& grid, const CellMask& mask) {
  return static_cast<double>(std::ranges::count(mask, std::uint8_t{1})) * grid.voxelVolume_mm3();
}

void beginStage(const ReportStage& report, std::string_view stage) {
  if (report) report(stage);
}

/// Bone and tissues of teeth, into the scan.
void labelJaw(const VolumeGrid& scan, const Mandible& jaw, const ToothRegions& teeth,
              const std::vector<std::uint8_t>& tissue, JawSegmentation& out) {
  out.label.assign(scan.voxelCount(), 0);
  out.tooth.assign(scan.voxelCount(), 0);
  tbb::parallel_for(0, jaw.grid.size.z, [&](int k) {
    forVoxels({0, 0, k}, {jaw.grid.size.x, jaw.grid.size.y, k + 1}, [&](glm::ivec3 ijk) {
      const std::size_t v = jaw.grid.index(ijk);
      if (jaw.solid[v] == 0) return;
      const bool is_cortical = static_cast<double>(jaw.smooth_hu[v]) > out.levels.thinBone_hu();
      out.label[scan.index(jaw.first + ijk)] =
          static_cast<std::uint8_t>(is_cortical ? Tissue::cortical : Tissue::trabecular);
    });
  });
  std::vector<std::uint8_t> fdi(static_cast<std::size_t>(teeth.count) + 1, 0);
  std::vector<std::uint8_t> is_tooth(fdi.size(), 0);
  for (const FoundTooth& tooth : out.teeth) {
    fdi[static_cast<std::size_t>(tooth.part)] = static_cast<std::uint8_t>(tooth.fdi);
    is_tooth[static_cast<std::size_t>(tooth.part)] = 1;
  }
  const glm::ivec3 size = teeth.box.size(), first = jaw.first + teeth.box.low;
  forCells(size, [&](glm::ivec3 ijk, std::size_t n) {
    if (is_tooth[teeth.part[n]] == 0) return;
    const std::uint8_t number = fdi[teeth.part[n]];
    // Tissues are those of a tooth with a number.
    out.label[scan.index(first + ijk)] = number != 0 ? tissue[n] : static_cast<std::uint8_t>(Tissue::other_teeth);
    out.tooth[scan.index(first + ijk)] = number;
  });
}

/// Bone within the canal's usual radius of its line.
void labelCanal(const VolumeGrid& scan, const CanalProposal& canal, std::vector<std::uint8_t>& label) {
  const int reach = static_cast<int>(std::ceil(canal.radius_mm / scan.spacing_mm)) + 1;
  for (const glm::dvec3& p : canal.line_P_mm) {
    const glm::ivec3 at(glm::floor(scan.indexFromPoint(p) + 0.5));
    forVoxels(glm::max(at - reach, glm::ivec3(0)), glm::min(at + reach + 1, scan.size), [&](glm::ivec3 ijk) {
      std::uint8_t& tissue = label[scan.index(ijk)];
      const bool is_bone = Tissue{tissue} == Tissue::cortical || Tissue{tissue} == Tissue::trabecular;
      if (is_bone && glm::distance(scan.centre_P_mm(ijk), p) < canal.radius_mm)
        tissue = static_cast<std::uint8_t>(Tissue::mandibular_canal);
    });
  }
}

}  // namespace

bool canHoldJaw(const VolumeGrid& grid) {
  return std::min({grid.size.x, grid.size.y, grid.size.z}) * grid.spacing_mm >= kLeastJaw_mm;
}

struct JawFinder::Jaw {
  JawArch arch;
  BiteSheet sheet;
  Mandible mandible;
  GreyLevels levels;
  ToothRegions regions;
  double hard_within_arch = 0.0;
  ToothSurfaces surfaces;
  ToothTissues tissues;
};

struct JawFinder::Teeth {
  std::vector<ToothClick> clicks;
  ToothRegions regions;
  std::vector<FoundTooth> teeth;
  std::vector<std::uint8_t> tissue;
  std::optional<JawRefusal> refusal;
};

struct JawFinder::Canal {
  struct OfSide {
    std::uint64_t teeth = 0;  ///< what of them the canal depends on
    std::vector<glm::dvec3> clicks;
    std::optional<CanalProposal> found;
  };
  std::array<std::optional<OfSide>, 2> of_side;  ///< right, left
};

JawFinder::~JawFinder() = default;

JawFinder::JawFinder(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield, const ReportStage& report,
                     const ReportJaw& so_far)
    : scan_(grid), canals_(std::make_unique<Canal>()) {
  beginStage(report, "row of teeth");
  const int edge = std::max(1, static_cast<int>(std::lround(kCell_mm / grid.spacing_mm)));
  const VolumeGrid cells = meanGrid(grid, edge);
  std::vector<float> smooth_hu = meansOfCubes(grid, hounsfield, edge);
  smoothCells(cells.size, kCellSmooth_mm / cells.spacing_mm, smooth_hu);
  std::optional<JawArch> arch = findJawArch(cells, smooth_hu);
  if (!arch) {
    refusal_ = toothlessJaw();
    return;
  }
  const BiteSheet sheet = findBiteSheet(cells, smooth_hu, *arch);
  if (sheet.lower_dense_mm3 < kLeastLower_mm3) {
    refusal_ = sheet.upper_dense_mm3 > kLeastUpperRow_mm3 ? upperArch() : toothlessJaw();
    return;
  }
  beginStage(report, "lower jaw");
  const CellMask jaw_cells = mandibleCells(cells, smooth_hu, *arch, sheet);
  if (volume_mm3(cells, jaw_cells) < kLeastJaw_mm3) {
    refusal_ = toothlessJaw();
    return;
  }
  const double hard_within_arch = hardWithinArch(cells, smooth_hu, *arch, sheet);
  Mandible mandible = mandibleIn(grid, hounsfield, cells, jaw_cells, edge);
  smooth_hu = {};
  if (so_far) so_far({&mandible, nullptr, nullptr});
  const GreyLevels levels = greyLevelsOf(mandible, sheet);
  beginStage(report, "teeth");
  ToothRegions regions = findToothRegions(mandible, levels);
  if (so_far) so_far({&mandible, &regions, nullptr});
  jaw_ = std::make_unique<Jaw>(
      Jaw{std::move(*arch), sheet, std::move(mandible), levels, std::move(regions), hard_within_arch, {}, {}});
}

JawSegmentation JawFinder::withClicks(const JawClicks& clicks, const ReportStage& report, const ShowTeeth& show,
                                      const ReportJaw& so_far) {
  if (refusal_) return refused(*refusal_);
  const Mandible& mandible = jaw_->mandible;
  const bool had_teeth = teeth_ && !teeth_->refusal, is_new = !teeth_ || teeth_->clicks != clicks.teeth;
  if (is_new) {
    Teeth found;
    found.clicks = clicks.teeth;
    ToothRegions edited = jaw_->regions;
    const ToldParts told = editTeeth(mandible, jaw_->levels, clicks.teeth, edited);
    beginStage(report, "tooth surfaces");
    found.regions = jaw_->surfaces.placed(mandible, edited);
    if (so_far) so_far({&mandible, &found.regions, nullptr});
    const auto measure = [&] {
      found.teeth = measuredTeeth(mandible, found.regions, jaw_->levels);
      told.tell(found.teeth);
    };
    measure();
    found.refusal = judgeJaw(mandible.grid, found.teeth);
    if (!found.refusal)
      found.refusal = judgeSigns(jawSigns(mandible, jaw_->arch, jaw_->sheet, found.teeth), jaw_->hard_within_arch);
    if (!found.refusal) {
      numberTeeth(jaw_->arch, found.teeth);
      if (joinSpareParts(mandible, found.teeth, found.regions)) {
        measure();
        numberTeeth(jaw_->arch, found.teeth);
      }
      found.refusal = judgeCount(found.teeth);
    }
    if (!found.refusal) {
      beginStage(report, "tissues");
      found.tissue = jaw_->tissues.of(mandible, found.regions, jaw_->levels);
    }
    teeth_ = std::make_unique<Teeth>(std::move(found));
  }
  if (teeth_->refusal) return refused(*teeth_->refusal);

  JawSegmentation out;
  out.levels = jaw_->levels;
  out.teeth = teeth_->teeth;
  beginStage(report, "labels");
  labelJaw(scan_, mandible, teeth_->regions, teeth_->tissue, out);
  if (so_far) so_far({nullptr, nullptr, &out});
  // What canals depend on, right and left.
  const CanalScene scene{mandible, teeth_->regions, jaw_->arch, jaw_->sheet};
  struct Asked {
    std::vector<glm::dvec3> clicks;
    std::uint64_t teeth = 0;
    bool is_known = false;
  };
  std::array<Asked, 2> asked;
  for (const bool is_right : {true, false}) {
    const std::size_t side = is_right ? 0 : 1;
    const std::optional<Canal::OfSide>& known = canals_->of_side[side];
    Asked& one = asked[side];
    one.clicks = canalClicksOn(jaw_->arch, clicks.canals, is_right);
    one.teeth = canalTeeth(scene, teeth_->teeth, is_right);
    one.is_known = known && known->teeth == one.teeth && known->clicks == one.clicks;
  }
  const auto with_canals = [&](JawSegmentation jaw) {
    for (const std::optional<Canal::OfSide>& side : canals_->of_side)
      if (side && side->found) jaw.canals.push_back(*side->found);
    for (const CanalProposal& canal : jaw.canals) labelCanal(scan_, canal, jaw.label);
    return jaw;
  };
  if (show && had_teeth && is_new && !(asked[0].is_known && asked[1].is_known)) show(with_canals(out));
  for (const bool is_right : {true, false}) {
    Asked& one = asked[is_right ? 0 : 1];
    if (one.is_known) continue;
    beginStage(report, is_right ? "right canal" : "left canal");
    std::optional<CanalProposal> found = canalOn(scene, teeth_->teeth, one.clicks, is_right);
    canals_->of_side[is_right ? 0 : 1] = Canal::OfSide{one.teeth, std::move(one.clicks), std::move(found)};
  }
  return with_canals(std::move(out));
}

HalfJaw JawFinder::halfOf(bool is_right) const {
  if (!jaw_ || !teeth_ || teeth_->refusal) return {};
  const CanalScene scene{jaw_->mandible, teeth_->regions, jaw_->arch, jaw_->sheet};
  return halfIn(scene, boxOfHalf(scene, is_right), coarseEdge(jaw_->mandible.grid));
}

JawSegmentation segmentJaw(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                           const ReportStage& report, const JawClicks& clicks, const ReportJaw& so_far) {
  return JawFinder(grid, hounsfield, report, so_far).withClicks(clicks, report, {}, so_far);
}

}  // namespace assets
