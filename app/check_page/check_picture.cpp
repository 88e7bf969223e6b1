#include "app/check_page/check_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "app/check_page/check_page.h"
#include "assets/import/tooth_site.h"
#include "assets/patient/patient_folder.h"
#include "assets/segment/cell_masks.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {

assets::JawSegmentation foundIn(const assets::Patient& patient) {
  assets::JawSegmentation jaw;
  const assets::CtVolume& ct = patient.ct;
  if (!ct.tooth.empty())
    for (const auto& [fdi, volume_mm3] : assets::toothVolumes_mm3(ct)) {
      if (assets::isUpper(fdi)) continue;
      const auto number = static_cast<std::uint8_t>(fdi);
      const assets::VoxelSum sum = assets::voxelSum(ct.grid, [&](std::size_t v) { return ct.tooth[v] == number; });
      assets::FoundTooth tooth;
      tooth.fdi = fdi, tooth.volume_mm3 = volume_mm3;
      tooth.centre_P_mm = ct.grid.origin_P_mm + ct.grid.spacing_mm * sum.sum / sum.count;
      if (!patient.found || (patient.found->tooth && patient.operatedTooth() == fdi)) tooth.told_fdi = fdi;
      jaw.teeth.push_back(tooth);
    }
  if (patient.mandibular_canal_P_mm.size() >= 2) {
    assets::CanalProposal canal;
    canal.line_P_mm = patient.mandibular_canal_P_mm;
    canal.radius_mm = patient.mandibular_canal_radius_mm;
    canal.is_confirmed = !patient.found || patient.found->canal;
    canal.is_right = assets::isRight(patient.operatedTooth());
    jaw.canals.push_back(std::move(canal));
  }
  // From the right to the left along the arch.
  std::ranges::sort(jaw.teeth, {}, [](const assets::FoundTooth& tooth) {
    const int place = assets::positionOf(tooth.fdi);
    return assets::isRight(tooth.fdi) ? -place : place;
  });
  return jaw;
}

namespace {

/// Around a found jaw bone is told by grey values: noise in soft tissue looks like crumbs of it.
void dropSpecks(const assets::VolumeGrid& grid, std::vector<std::uint8_t>& what) {
  constexpr int kLeastNeighbours = 3;  ///< of six
  const std::vector<std::uint8_t> before = what;
  tbb::parallel_for(0, grid.size.z, [&](int k) {
    assets::forVoxels({0, 0, k}, {grid.size.x, grid.size.y, k + 1}, [&](glm::ivec3 ijk) {
      const std::size_t n = grid.index(ijk);
      if (before[n] != kBoneVoxel) return;
      int neighbours = 0;
      assets::forNeighbours(grid.size, n, [&](std::size_t other) { neighbours += before[other] != 0 ? 1 : 0; });
      if (neighbours < kLeastNeighbours) what[n] = 0;
    });
  });
}

}  // namespace

std::vector<std::uint8_t> whatIn(const assets::Patient& patient) {
  std::vector<std::uint8_t> what = whatOf(patient.ct);
  if (!patient.found) return what;
  std::ranges::replace(what, kPieceVoxel, kBoneVoxel);
  dropSpecks(patient.ct.grid, what);
  return what;
}

render::Image checkPicture(const assets::Patient& patient) {
  constexpr glm::ivec2 kPicture_px{1280, 800};
  const JawViews views(patient, whatIn(patient));
  const assets::JawSegmentation found = foundIn(patient);
  CheckMenu menu({}, false, {});
  menu.moveCursor(patient.focus_P_mm());
  std::vector<CheckRow> rows = checkRows(found, {}, patient.site ? patient.site->fdi : 0);
  for (CheckRow& row : rows)
    if (row.kind == CheckRow::Kind::tooth)
      row.at_P_mm = views.nearestOf(static_cast<std::uint8_t>(row.fdi), row.at_P_mm);
  menu.showRows(std::move(rows));
  return CheckPage(views).picture(menu, found.canals, patient.shownTitle(), {}, {}, kPicture_px);
}

void keepCheckPicture(const assets::Patient& patient, const std::string& folder) {
  const render::Image picture = checkPicture(patient);
  calibration::OutputFile file(assets::checkPicturePath(folder), true);
  calibration::writePng(file.temporaryPath(), {picture.w, picture.h}, picture.rgba);
  file.commit();
}

}  // namespace app
