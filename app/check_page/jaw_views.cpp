#include "app/check_page/jaw_views.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/case/arch_curve.h"
#include "app/check_page/slice_picture.h"
#include "app/check_page/solid_picture.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr double kSliceHeight_mm = 56.0, kAxialHeight_mm = 76.0, kSolidHeight_mm = 82.0, kPanoramic_mm = 0.25;
constexpr double kMostSlope = 0.6;
/// From the curve of the panoramic view, where teeth are looked for, in this order.
constexpr std::array kAcross_mm{0.0, -1.5, 1.5, -3.0, 3.0, -4.5, 4.5, -6.0, 6.0};
/// Around what changed: a surface is lit by what lies two voxels around it.
constexpr int kLitBy_voxels = 4, kPixelsAround = 2;

std::uint8_t byteOf(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

/// Between the teeth of both sides, or beyond those of the one that there is.
double midlineOf(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what) {
  double right = -1e9, left = 1e9;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double x = grid.centre_P_mm(ijk).x;
    if (what[v] >= 41 && what[v] <= 48) right = std::max(right, x);
    if (what[v] >= 31 && what[v] <= 38) left = std::min(left, x);
  });
  if (right < -1e8 && left > 1e8) return grid.centre_P_mm(grid.size / 2).x;
  if (right < -1e8) return left;
  return left > 1e8 ? right : 0.5 * (right + left);
}

/// Around the cells that differ.
assets::CellBox boxOfDifference(glm::ivec3 size, const std::vector<std::uint8_t>& a,
                                const std::vector<std::uint8_t>& b) {
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, size.z), assets::noCells(size),
      [&](const tbb::blocked_range<int>& layers, assets::CellBox box) {
        for (int k = layers.begin(); k < layers.end(); ++k)
          for (int j = 0; j < size.y; ++j) {
            const auto first = static_cast<std::ptrdiff_t>(assets::indexIn(size, {0, j, k}));
            const auto row = a.begin() + first, end = row + size.x, other = b.begin() + first;
            const auto from = std::mismatch(row, end, other).first;
            if (from == end) continue;
            int last = size.x - 1;
            while (row[last] == other[last]) --last;
            box.low = glm::min(box.low, glm::ivec3(static_cast<int>(from - row), j, k));
            box.end = glm::max(box.end, glm::ivec3(last, j, k) + 1);
          }
        return box;
      },
      [](const assets::CellBox& left, const assets::CellBox& right) {
        return assets::CellBox{glm::min(left.low, right.low), glm::max(left.end, right.end)};
      });
}

/// Black, as large as that.
render::Image blackImage(glm::ivec2 px) {
  render::Image image{px.x, px.y, std::vector<std::uint8_t>(4 * assets::countIn({px, 1}), 0)};
  for (std::size_t n = 3; n < image.rgba.size(); n += 4) image.rgba[n] = 255;
  return image;
}

PixelBox within(const glm::dvec2& low, const glm::dvec2& high, glm::ivec2 px) {
  const glm::dvec2 none(0.0), all(px);
  return {glm::ivec2(glm::clamp(glm::floor(low) - double{kPixelsAround}, none, all)),
          glm::ivec2(glm::clamp(glm::ceil(high) + double{kPixelsAround}, none, all))};
}

}  // namespace

glm::dvec3 colourOf(std::uint8_t what) {
  if (what == kPieceVoxel) return {235, 90, 70};
  if (what == kBoneVoxel || what == 0) return {205, 196, 176};
  // Neighbours differ: hues by position, right and left alike.
  static constexpr std::array<glm::dvec3, 8> kColours{{{86, 180, 233},
                                                       {240, 228, 66},
                                                       {0, 190, 140},
                                                       {230, 159, 0},
                                                       {120, 150, 255},
                                                       {170, 220, 90},
                                                       {204, 121, 167},
                                                       {255, 150, 90}}};
  return kColours[static_cast<std::size_t>((what % 10 + 7) % 8)];
}

std::uint8_t whatOf(std::uint8_t label, std::uint8_t tooth) {
  if (tooth != 0) return tooth;
  const assets::Tissue tissue{label};
  if (tissue == assets::Tissue::other_teeth) return kPieceVoxel;
  const bool is_bone = tissue == assets::Tissue::cortical || tissue == assets::Tissue::trabecular;
  return is_bone ? kBoneVoxel : std::uint8_t{0};
}

std::vector<std::uint8_t> whatOf(const std::vector<std::uint8_t>& jaw_label, const std::vector<std::uint8_t>& tooth) {
  std::vector<std::uint8_t> what(jaw_label.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, what.size(), 1u << 16),
                    [&](const tbb::blocked_range<std::size_t>& part) {
                      for (std::size_t v = part.begin(); v < part.end(); ++v)
                        what[v] = whatOf(jaw_label[v], tooth.empty() ? std::uint8_t{0} : tooth[v]);
                    });
  return what;
}

std::vector<std::uint8_t> whatOf(const assets::CtVolume& ct) { return whatOf(ct.label, ct.tooth); }

JawAxes jawAxes(const assets::CtVolume& ct) {
  std::array<glm::dvec3, 49> top{};
  std::array<bool, 49> is_there{};
  if (!ct.tooth.empty())
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const int fdi = ct.tooth[v];
      if (fdi < 31 || fdi > 48 || !assets::isToothNumber(fdi) || assets::positionOf(fdi) == 8) return;
      const auto n = static_cast<std::size_t>(fdi);
      const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
      if (!is_there[n] || p.z > top[n].z) top[n] = p;
      is_there[n] = true;
    });
  std::vector<glm::dvec3> points;
  for (std::size_t n = 0; n < top.size(); ++n)
    if (is_there[n]) points.push_back(top[n]);
  if (points.size() < 3) return {};
  // Level from side to side; its slope towards the back is the head's tilt.
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& p : points) mean += p / static_cast<double>(points.size());
  double products = 0.0, squares = 0.0;
  for (const glm::dvec3& p : points) {
    products += (p.y - mean.y) * (p.z - mean.z);
    squares += (p.y - mean.y) * (p.y - mean.y);
  }
  const double slope = squares > 25.0 ? std::clamp(products / squares, -kMostSlope, kMostSlope) : 0.0;
  JawAxes axes;
  axes.back_P = glm::normalize(glm::dvec3(0.0, 1.0, slope));
  axes.up_P = glm::cross(axes.left_P, axes.back_P);
  return axes;
}

JawViews::JawViews(const assets::Patient& patient, std::vector<std::uint8_t> what)
    : patient_(patient), what_(std::move(what)), axes_(jawAxes(patient.ct)), curve_P_mm_(archCurve_P_mm(patient)) {
  const assets::VolumeGrid& grid = patient.ct.grid;
  const assets::VoxelSum teeth = assets::voxelSum(grid, [&](std::size_t v) {
    return (what_[v] > 30 && what_[v] < 49) || (patient.ct.tooth.empty() && what_[v] == kPieceVoxel);
  });
  middle_P_mm_ =
      teeth.count > 0.0 ? grid.origin_P_mm + grid.spacing_mm * teeth.sum / teeth.count : patient.focus_P_mm();
  if (curve_P_mm_.size() >= 2) {
    unrolled_ = assets::panoramicOf(patient.ct, curve_P_mm_, kPanoramic_mm);
  }
  midline_x_P_mm_ = midlineOf(grid, what_);
  bricks_.find(grid, what_);
}

assets::CellBox JawViews::take(std::vector<std::uint8_t> what) {
  const assets::CellBox changed = boxOfDifference(grid().size, what_, what);
  what_ = std::move(what);
  bricks_.find(grid(), what_);
  return changed;
}

void JawViews::takeVoxel(const glm::ivec3& ijk, std::uint8_t label, std::uint8_t tooth) {
  std::uint8_t& here = what_[grid().index(ijk)];
  here = whatOf(label, tooth);
  bricks_.add(ijk, here);
}

std::uint8_t JawViews::whatAt(const glm::dvec3& p_P_mm) const {
  const glm::ivec3 at(glm::floor(grid().indexFromPoint(p_P_mm) + 0.5));
  return grid().contains(at) ? what_[grid().index(at)] : std::uint8_t{0};
}

JawViews::Plane JawViews::planeOf(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look,
                                  glm::ivec2 px) const {
  const glm::dvec2 half = 0.5 * glm::dvec2(px);
  Plane plane;
  glm::dvec3 centre_P_mm = cursor_P_mm;
  if (view == JawView::axial) {
    plane.right_P = axes_.left_P, plane.down_P = axes_.back_P;
    plane.pixel_mm = kAxialHeight_mm / px.y;
    // The whole arch, at the cursor's height.
    const glm::dvec3 to_middle = middle_P_mm_ - cursor_P_mm;
    centre_P_mm += to_middle - glm::dot(to_middle, axes_.up_P) * axes_.up_P;
  } else if (view == JawView::solid) {
    plane.right_P = std::cos(look.turn_rad) * axes_.left_P + std::sin(look.turn_rad) * axes_.back_P;
    const glm::dvec3 away = glm::cross(axes_.up_P, plane.right_P);
    plane.down_P = -std::cos(look.tilt_rad) * axes_.up_P + std::sin(look.tilt_rad) * -away;
    plane.pixel_mm = kSolidHeight_mm / px.y / look.zoom;
    centre_P_mm = look.zoom > 1.01 ? cursor_P_mm : middle_P_mm_ + 6.0 * axes_.back_P - 5.0 * axes_.up_P;
  } else {
    // Tangent of the arch where the cursor is nearest to it.
    glm::dvec3 tangent = axes_.left_P;
    double nearest = 1e18;
    for (std::size_t n = 1; n < curve_P_mm_.size(); ++n) {
      const double away = glm::distance(curve_P_mm_[n], glm::dvec2(cursor_P_mm));
      if (away >= nearest) continue;
      nearest = away;
      const std::size_t before = n > 6 ? n - 6 : 0, after = std::min(n + 6, curve_P_mm_.size() - 1);
      const glm::dvec3 along(curve_P_mm_[after] - curve_P_mm_[before], 0.0);
      tangent = glm::normalize(along - glm::dot(along, axes_.up_P) * axes_.up_P);
    }
    const glm::dvec3 outward = glm::cross(tangent, axes_.up_P);
    plane.right_P = view == JawView::along ? tangent : isRight(cursor_P_mm) ? -outward : outward;
    plane.down_P = -axes_.up_P;
    plane.pixel_mm = kSliceHeight_mm / px.y;
  }
  plane.corner_P_mm = centre_P_mm - plane.pixel_mm * (half.x * plane.right_P + half.y * plane.down_P);
  return plane;
}

double JawViews::panoramicScale(glm::ivec2 px) const {
  const glm::dvec2 size(unrolled_.size_px);
  return std::min(px.x / size.x, px.y / size.y);
}

std::optional<glm::dvec2> JawViews::inPanoramic(const glm::dvec3& p_P_mm, glm::ivec2 px) const {
  if (unrolled_.hounsfield.empty()) return std::nullopt;
  const auto found = unrolled_.positionOf(p_P_mm);
  if (!found) return std::nullopt;
  const double scale = panoramicScale(px);
  return scale * found->px + 0.5 * (glm::dvec2(px) - scale * glm::dvec2(unrolled_.size_px));
}

std::optional<glm::dvec3> JawViews::inPanoramicAt(const glm::dvec2& at_px, glm::ivec2 px, bool needs_tooth) const {
  if (unrolled_.hounsfield.empty()) return std::nullopt;
  const double scale = panoramicScale(px);
  const glm::dvec2 at = (at_px - 0.5 * (glm::dvec2(px) - scale * glm::dvec2(unrolled_.size_px))) / scale;
  const glm::ivec2 cell(glm::floor(at));
  if (cell.x < 1 || cell.y < 0 || cell.x + 1 >= unrolled_.size_px.x || cell.y >= unrolled_.size_px.y)
    return std::nullopt;
  const auto column = static_cast<std::size_t>(cell.x);
  const glm::dvec2 on = unrolled_.columns_P_mm[column];
  const glm::dvec2 along = unrolled_.columns_P_mm[column + 1] - unrolled_.columns_P_mm[column - 1];
  const glm::dvec2 across = glm::dvec2(-along.y, along.x) / std::max(glm::length(along), 1e-9);
  const double z = unrolled_.top_P_mm - unrolled_.pixel_mm * (at.y);
  for (const double away_mm : kAcross_mm) {
    const glm::dvec3 p(on + away_mm * across, z);
    if (const std::uint8_t what = whatAt(p); what != 0 && what != kBoneVoxel) return p;
  }
  return needs_tooth ? std::nullopt : std::optional(glm::dvec3(on, z));
}

void JawViews::drawPanoramic(const GreyRange& range, const PixelBox& box, render::Image& image) const {
  if (unrolled_.hounsfield.empty()) return;
  const glm::ivec2 px(image.w, image.h);
  const double scale = panoramicScale(px);
  const glm::dvec2 corner = 0.5 * (glm::dvec2(px) - scale * glm::dvec2(unrolled_.size_px));
  // The layer averages bone with soft tissue and air.
  const double low = range.low_hu - 250.0, high = 0.62 * range.high_hu;
  tbb::parallel_for(box.low.y, box.end.y, [&](int y) {
    for (int x = box.low.x; x < box.end.x; ++x) {
      const glm::ivec2 cell(glm::floor((glm::dvec2(x + 0.5, y + 0.5) - corner) / scale));
      if (glm::any(glm::lessThan(cell, glm::ivec2(0))) || glm::any(glm::greaterThanEqual(cell, unrolled_.size_px)))
        continue;
      const double hu = unrolled_.hounsfield[static_cast<std::size_t>(cell.y * unrolled_.size_px.x + cell.x)];
      glm::dvec3 colour(255.0 * std::clamp((hu - low) / (high - low), 0.0, 1.0));
      if (const auto p = inPanoramicAt(glm::dvec2(x + 0.5, y + 0.5), px, true))
        colour = glm::mix(colour, colourOf(whatAt(*p)), 1.4 * kToothTint);
      for (std::size_t c = 0; c < 3; ++c)
        image.rgba[4 * static_cast<std::size_t>(y * px.x + x) + c] = byteOf(colour[static_cast<int>(c)]);
    }
  });
}

/// The columns that look near a box, and its height.
PixelBox JawViews::panoramicBoxOf(const glm::dvec3& low_P_mm, const glm::dvec3& high_P_mm, glm::ivec2 px) const {
  if (unrolled_.hounsfield.empty()) return {};
  const double reach_mm = std::abs(kAcross_mm.back()) + grid().spacing_mm +
                          0.5 * glm::distance(glm::dvec2(low_P_mm), glm::dvec2(high_P_mm));
  const glm::dvec2 middle = 0.5 * glm::dvec2(low_P_mm + high_P_mm);
  int first = unrolled_.size_px.x, last = -1;
  for (int column = 0; column < unrolled_.size_px.x; ++column) {
    if (glm::distance(unrolled_.columns_P_mm[static_cast<std::size_t>(column)], middle) > reach_mm) continue;
    first = std::min(first, column), last = column;
  }
  if (last < 0) return {};
  const double scale = panoramicScale(px);
  const glm::dvec2 corner = 0.5 * (glm::dvec2(px) - scale * glm::dvec2(unrolled_.size_px));
  const auto row_of = [&](double z_P_mm) { return (unrolled_.top_P_mm - z_P_mm) / unrolled_.pixel_mm; };
  return within(corner + scale * glm::dvec2(first, row_of(high_P_mm.z)),
                corner + scale * glm::dvec2(last + 1, row_of(low_P_mm.z)), px);
}

PixelBox JawViews::shownIn(JawView view, const Plane& plane, const assets::CellBox& voxels, glm::ivec2 px) const {
  const int around = view == JawView::solid ? kLitBy_voxels : 1;
  const glm::dvec3 low_P_mm = grid().centre_P_mm(voxels.low - around),
                   high_P_mm = grid().centre_P_mm(voxels.end + around);
  if (view == JawView::panoramic) return panoramicBoxOf(low_P_mm, high_P_mm, px);
  glm::dvec3 low(1e9), high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at =
        plane.of({(corner & 1) != 0 ? high_P_mm.x : low_P_mm.x, (corner & 2) != 0 ? high_P_mm.y : low_P_mm.y,
                  (corner & 4) != 0 ? high_P_mm.z : low_P_mm.z});
    low = glm::min(low, at), high = glm::max(high, at);
  }
  if (view != JawView::solid && (low.z > 0.0 || high.z < 0.0)) return {};
  return within(glm::dvec2(low), glm::dvec2(high), px);
}

void JawViews::draw(JawView view, const Plane& plane, const GreyRange& range, const PixelBox& box,
                    render::Image& image) const {
  if (view == JawView::panoramic)
    drawPanoramic(range, box, image);
  else if (view == JawView::solid)
    SolidPicture(grid(), what_, bricks_).draw(plane, box, image);
  else
    drawSlice(patient_.ct, what_, plane, range, box, image);
}

render::Image JawViews::picture(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look,
                                const GreyRange& range, glm::ivec2 px) const {
  render::Image image = blackImage(px);
  draw(view, planeOf(view, cursor_P_mm, look, px), range, {glm::ivec2(0), px}, image);
  return image;
}

bool JawViews::redraw(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look, const GreyRange& range,
                      const assets::CellBox& changed, render::Image& image) const {
  const glm::ivec2 px(image.w, image.h);
  const Plane plane = planeOf(view, cursor_P_mm, look, px);
  const PixelBox box = shownIn(view, plane, changed, px);
  if (box.isEmpty()) return false;
  draw(view, plane, range, box, image);
  return true;
}

std::optional<glm::dvec3> JawViews::pointAt(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look,
                                            glm::ivec2 px, const glm::dvec2& at_px) const {
  if (view == JawView::panoramic) return inPanoramicAt(at_px, px, false);
  const Plane plane = planeOf(view, cursor_P_mm, look, px);
  return view == JawView::solid ? SolidPicture(grid(), what_, bricks_).toothAt(plane, at_px)
                                : std::optional(plane.at(at_px));
}

glm::dvec3 JawViews::nearestOf(std::uint8_t piece, const glm::dvec3& p_P_mm) const {
  constexpr double kReach_mm = 8.0;
  glm::dvec3 nearest = p_P_mm;
  double least_mm = 2.0 * kReach_mm;
  assets::forCellsNear(grid().indexFromPoint(p_P_mm), kReach_mm, grid().spacing_mm, grid().size,
                       [&](glm::ivec3 ijk, double away_mm) {
                         if (what_[grid().index(ijk)] == piece && away_mm < least_mm)
                           least_mm = away_mm, nearest = grid().centre_P_mm(ijk);
                       });
  return nearest;
}

}  // namespace app
