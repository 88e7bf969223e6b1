#include "assets/segment/jaw_segmentation.h"

#include <algorithm>
#include <cmath>

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

/// Bone and tissues of teeth, into the scan.
void labelJaw(const VolumeGrid& scan, const Mandible& jaw, const ToothRegions& teeth,
              const std::vector<std::uint8_t>& tissue, JawSegmentation& out) {
  out.label.assign(scan.voxelCount(), 0);
  out.tooth.assign(scan.voxelCount(), 0);
  forVoxels(jaw.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (jaw.solid[v] == 0) return;
    const bool is_cortical = static_cast<double>(jaw.smooth_hu[v]) > out.levels.thinBone_hu();
    out.label[scan.index(jaw.first + ijk)] =
        static_cast<std::uint8_t>(is_cortical ? Tissue::cortical : Tissue::trabecular);
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

JawSegmentation segmentJaw(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                           const ReportStage& report, const JawClicks& clicks) {
  const auto begin = [&](std::string_view stage) {
    if (report) report(stage);
  };
  begin("row of teeth");
  const int edge = std::max(1, static_cast<int>(std::lround(kCell_mm / grid.spacing_mm)));
  const VolumeGrid cells = meanGrid(grid, edge);
  std::vector<float> smooth_hu = meansOfCubes(grid, hounsfield, edge);
  smoothCells(cells.size, kCellSmooth_mm / cells.spacing_mm, smooth_hu);
  const std::optional<JawArch> found = findJawArch(cells, smooth_hu);
  if (!found) return refused(toothlessJaw());
  const JawArch& arch = *found;
  const BiteSheet sheet = findBiteSheet(cells, smooth_hu, arch);

  if (sheet.lower_dense_mm3 < kLeastLower_mm3)
    return refused(sheet.upper_dense_mm3 > kLeastUpperRow_mm3 ? upperArch() : toothlessJaw());

  begin("lower jaw");
  const CellMask jaw_cells = mandibleCells(cells, smooth_hu, arch, sheet);
  if (volume_mm3(cells, jaw_cells) < kLeastJaw_mm3) return refused(toothlessJaw());
  const Mandible jaw = mandibleIn(grid, hounsfield, cells, jaw_cells, edge);
  smooth_hu = {};

  JawSegmentation out;
  out.levels = greyLevelsOf(jaw, sheet);
  begin("teeth");
  ToothRegions teeth = findToothRegions(jaw, out.levels);
  const ToldParts told = editTeeth(jaw, out.levels, clicks.teeth, teeth);
  begin("tooth surfaces");
  moveToEdges(jaw, teeth);
  const auto measure = [&] {
    out.teeth = measuredTeeth(jaw, teeth, out.levels);
    told.tell(out.teeth);
  };
  measure();
  if (auto refusal = judgeJaw(jaw.grid, out.teeth)) return refused(std::move(*refusal));
  numberTeeth(arch, out.teeth);
  if (joinSpareParts(jaw, out.teeth, teeth)) {
    measure();
    numberTeeth(arch, out.teeth);
  }
  if (auto refusal = judgeCount(out.teeth)) return refused(std::move(*refusal));
  begin("tissues");
  const std::vector<std::uint8_t> tissue = tissuesOfTeeth(jaw, teeth, out.levels);
  begin("canals");
  out.canals = canalsOf({jaw, teeth, arch, sheet}, out.teeth, clicks.canals);
  begin("labels");
  labelJaw(grid, jaw, teeth, tissue, out);
  for (const CanalProposal& canal : out.canals) labelCanal(grid, canal, out.label);
  return out;
}

}  // namespace assets
