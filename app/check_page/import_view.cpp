#include "app/check_page/import_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/check_page/jaw_views.h"
#include "app/check_page/slice_picture.h"
#include "assets/segment/mandible.h"
#include "assets/segment/tooth_regions.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr int kMostVoxels = 256;
constexpr std::uint8_t kFirstColour = 31;  ///< of pieces that have no number yet

/// Centre of the planes that hold most of what is dense: the teeth, by the densest 0.4 % of the voxels.
glm::ivec3 densestPlanes(const assets::CtVolume& ct) {
  constexpr std::size_t kEach = 7;
  constexpr double kDense = 0.996;
  std::vector<std::int16_t> some;
  for (std::size_t v = 0; v < ct.hounsfield.size(); v += kEach) some.push_back(ct.hounsfield[v]);
  const auto nth = some.begin() + static_cast<std::ptrdiff_t>(kDense * static_cast<double>(some.size()));
  std::nth_element(some.begin(), nth, some.end());
  std::array<std::vector<int>, 3> count;
  for (int axis = 0; axis < 3; ++axis)
    count[static_cast<std::size_t>(axis)].resize(static_cast<std::size_t>(ct.grid.size[axis]));
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.hounsfield[v] <= *nth) return;
    for (int axis = 0; axis < 3; ++axis) ++count[static_cast<std::size_t>(axis)][static_cast<std::size_t>(ijk[axis])];
  });
  glm::ivec3 planes(0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<int>& of = count[static_cast<std::size_t>(axis)];
    planes[axis] = static_cast<int>(std::ranges::max_element(of) - of.begin());
  }
  return planes;
}

JawViews::Plane planeThrough(const glm::dvec3& at_P_mm, ImportView::Slice slice, const assets::VolumeGrid& grid,
                             glm::ivec2 px) {
  JawViews::Plane plane;
  plane.right_P = slice == ImportView::sagittal ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  plane.down_P = slice == ImportView::axial ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
  // All of the scan.
  const glm::dvec3 extent_mm = grid.spacing_mm * glm::dvec3(grid.size);
  const double across_mm = std::abs(glm::dot(extent_mm, plane.right_P)),
               down_mm = std::abs(glm::dot(extent_mm, plane.down_P));
  plane.pixel_mm = std::max(across_mm / px.x, down_mm / px.y);
  glm::dvec3 centre_P_mm = grid.origin_P_mm + 0.5 * (extent_mm - grid.spacing_mm);
  const int axis = slice == ImportView::axial ? 2 : slice == ImportView::coronal ? 1 : 0;
  centre_P_mm[axis] = at_P_mm[axis];
  plane.corner_P_mm =
      centre_P_mm -
      0.5 * plane.pixel_mm * (static_cast<double>(px.x) * plane.right_P + static_cast<double>(px.y) * plane.down_P);
  return plane;
}

/// What has been found of the jaw.
void tintBone(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what, const JawViews::Plane& plane,
              render::Image& image) {
  constexpr std::array kTint{40, 120, 150};
  std::uint8_t* out = image.rgba.data();
  for (int y = 0; y < image.h; ++y)
    for (int x = 0; x < image.w; ++x, out += 4) {
      const glm::ivec3 voxel(glm::floor(grid.indexFromPoint(plane.at({x + 0.5, y + 0.5})) + 0.5));
      if (!grid.contains(voxel) || what[grid.index(voxel)] != kBoneVoxel) continue;
      for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>((3 * out[c] + kTint[c]) / 4);
    }
}

}  // namespace

void ImportView::takeGrey(const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield) {
  assets::CtVolume coarse;
  const int every = std::max(1, (std::max({grid.size.x, grid.size.y, grid.size.z}) + kMostVoxels - 1) / kMostVoxels);
  coarse.grid = grid;
  coarse.grid.size = (grid.size + (every - 1)) / every;
  coarse.grid.spacing_mm = every * grid.spacing_mm;
  coarse.hounsfield.resize(coarse.grid.voxelCount());
  assets::forVoxels(coarse.grid,
                    [&](glm::ivec3 ijk, std::size_t v) { coarse.hounsfield[v] = hounsfield[grid.index(every * ijk)]; });
  const glm::dvec3 at_P_mm = coarse.grid.centre_P_mm(densestPlanes(coarse));
  const std::lock_guard lock(guard_);
  coarse_ = std::move(coarse);
  what_.assign(coarse_.hounsfield.size(), 0);
  scan_ = grid, every_ = every;
  if (!is_turned_) at_P_mm_ = at_P_mm;
  ++changes_;
}

void ImportView::takeJaw(const assets::JawSoFar& jaw) {
  // Nobody else writes the grid.
  if (coarse_.hounsfield.empty()) return;
  std::vector<std::uint8_t> what(coarse_.hounsfield.size(), 0);
  std::array<std::pair<glm::dvec3, int>, 49> teeth{};
  assets::forVoxels(coarse_.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::ivec3 voxel = every_ * ijk;
    if (jaw.labels != nullptr) {
      const std::size_t n = scan_.index(voxel);
      what[v] = whatOf(jaw.labels->label[n], jaw.labels->tooth[n]);
      if (const std::uint8_t fdi = jaw.labels->tooth[n]; fdi < teeth.size())
        teeth[fdi].first += coarse_.grid.centre_P_mm(ijk), ++teeth[fdi].second;
      return;
    }
    const glm::ivec3 in_jaw = voxel - jaw.jaw->first;
    if (!jaw.jaw->grid.contains(in_jaw)) return;
    if (jaw.jaw->solid[jaw.jaw->grid.index(in_jaw)] != 0) what[v] = kBoneVoxel;
    if (jaw.teeth == nullptr) return;
    const glm::ivec3 in_teeth = in_jaw - jaw.teeth->box.low, size = jaw.teeth->box.size();
    if (glm::any(glm::lessThan(in_teeth, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(in_teeth, size))) return;
    if (const std::uint8_t part = jaw.teeth->part[assets::indexIn(size, in_teeth)]; part != 0)
      what[v] = static_cast<std::uint8_t>(kFirstColour + (part - 1) % 8);
  });
  const std::lock_guard lock(guard_);
  what_ = std::move(what);
  // To the third molar, once there is one.
  for (const std::size_t fdi : {38u, 48u})
    if (!is_turned_ && teeth[fdi].second > 0) at_P_mm_ = teeth[fdi].first / static_cast<double>(teeth[fdi].second);
  ++changes_;
}

std::optional<std::array<render::Image, ImportView::kSlices>> ImportView::pictures(
    const std::array<glm::ivec2, kSlices>& px) const {
  const std::lock_guard lock(guard_);
  if (coarse_.hounsfield.empty()) return {};
  std::array<render::Image, kSlices> pictures;
  for (std::size_t n = 0; n < kSlices; ++n) {
    const JawViews::Plane plane = planeThrough(at_P_mm_, static_cast<Slice>(n), coarse_.grid, px[n]);
    pictures[n] = {px[n].x, px[n].y, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(px[n].x * px[n].y), 255)};
    drawSlice(coarse_, what_, plane, {}, {{0, 0}, px[n]}, pictures[n]);
    tintBone(coarse_.grid, what_, plane, pictures[n]);
  }
  return pictures;
}

void ImportView::turn(Slice slice, double notches) {
  const std::lock_guard lock(guard_);
  if (coarse_.hounsfield.empty()) return;
  const int axis = slice == axial ? 2 : slice == coronal ? 1 : 0;
  const double low = coarse_.grid.origin_P_mm[axis],
               high = low + coarse_.grid.spacing_mm * (coarse_.grid.size[axis] - 1);
  at_P_mm_[axis] = std::clamp(at_P_mm_[axis] + notches * coarse_.grid.spacing_mm, low, high);
  is_turned_ = true;
  ++changes_;
}

std::uint64_t ImportView::changes() const {
  const std::lock_guard lock(guard_);
  return changes_;
}

}  // namespace app
