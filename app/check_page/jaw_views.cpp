#include "app/check_page/jaw_views.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/case/arch_curve.h"
#include "assets/segment/cell_masks.h"
#include "assets/tooth.h"
#include "assets/trilinear.h"

namespace app {
namespace {

constexpr double kSliceHeight_mm = 56.0, kAxialHeight_mm = 76.0, kSolidHeight_mm = 82.0, kSolidReach_mm = 90.0,
                 kPanoramic_mm = 0.25;
constexpr double kTint = 0.16, kOutline = 0.9, kBoneShare = 0.5;
constexpr double kMostSlope = 0.6;
constexpr int kBrick = 8;

std::uint8_t byteOf(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

/// Distance to the next face of a cell of `edge` along a direction, in the same unit.
double toNextCell(const glm::dvec3& at, const glm::dvec3& direction, double edge) {
  double least = edge * 2.0;
  for (int a = 0; a < 3; ++a) {
    if (std::abs(direction[a]) < 1e-9) continue;
    const double low = std::floor(at[a] / edge) * edge;
    least = std::min(least, ((direction[a] > 0.0 ? low + edge : low) - at[a]) / direction[a]);
  }
  return std::max(least, 0.0);
}

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
  findBricks();
}

void JawViews::take(std::vector<std::uint8_t> what) {
  what_ = std::move(what);
  findBricks();
}

void JawViews::takeVoxel(std::size_t v, std::uint8_t label, std::uint8_t tooth) {
  what_[v] = whatOf(label, tooth);
  if (what_[v] == 0) return;
  is_used_[assets::indexIn(grid().bricks(), assets::elementAt(grid().size, v) / kBrick)] = 1;
}

void JawViews::findBricks() {
  const glm::ivec3 bricks = grid().bricks();
  is_used_.assign(assets::countIn(bricks), 0);
  tbb::parallel_for(0, bricks.z, [&](int brick) {
    const int end = std::min(grid().size.z, kBrick * (brick + 1));
    assets::forVoxels({0, 0, kBrick * brick}, {grid().size.x, grid().size.y, end}, [&](glm::ivec3 ijk) {
      if (what_[grid().index(ijk)] != 0) is_used_[assets::indexIn(bricks, ijk / kBrick)] = 1;
    });
  });
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

render::Image JawViews::slice(const Plane& plane, const GreyRange& range, glm::ivec2 px) const {
  const assets::VolumeGrid& voxels = grid();
  const std::int16_t* const hounsfield = patient_.ct.hounsfield.data();
  render::Image image{px.x, px.y, std::vector<std::uint8_t>(4 * assets::countIn({px, 1}), 255)};
  // In voxels: of the first pixel's middle, and a step to the right and down.
  const glm::vec3 first(voxels.indexFromPoint(plane.at({0.5, 0.5}))),
      right(plane.pixel_mm / voxels.spacing_mm * plane.right_P),
      down(plane.pixel_mm / voxels.spacing_mm * plane.down_P);
  const glm::ivec3 size = voxels.size;
  const auto row = static_cast<std::ptrdiff_t>(size.x), layer = row * size.y;
  const auto at = [&](int x, int y) { return first + static_cast<float>(x) * right + static_cast<float>(y) * down; };
  const auto below = [](float v) { return static_cast<int>(std::floor(v)); };

  const std::size_t width = static_cast<std::size_t>(px.x) + 1;
  std::vector<std::uint8_t> what(width * (static_cast<std::size_t>(px.y) + 1));
  tbb::parallel_for(0, px.y + 1, [&](int y) {
    std::uint8_t* const out = what.data() + static_cast<std::size_t>(y) * width;
    for (int x = 0; x <= px.x; ++x) {
      const glm::vec3 p = at(x, y) + 0.5F;
      const int i = below(p.x), j = below(p.y), k = below(p.z);
      const bool is_in = i >= 0 && j >= 0 && k >= 0 && i < size.x && j < size.y && k < size.z;
      out[x] = is_in ? what_[static_cast<std::size_t>(i + row * j + layer * k)] : std::uint8_t{0};
    }
  });
  const auto is_other = [](std::uint8_t a, std::uint8_t b) {
    return a != b && ((a != 0 && a != kBoneVoxel) || (b != 0 && b != kBoneVoxel));
  };
  const float low_hu = static_cast<float>(range.low_hu),
              per_hu = 255.0F / static_cast<float>(range.high_hu - range.low_hu);
  tbb::parallel_for(0, px.y, [&](int y) {
    std::uint8_t* out = image.rgba.data() + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(px.x);
    const std::uint8_t* const here_row = what.data() + static_cast<std::size_t>(y) * width;
    for (int x = 0; x < px.x; ++x, out += 4) {
      const glm::vec3 p = at(x, y);
      const int i = below(p.x), j = below(p.y), k = below(p.z);
      float hu = -1000.0F;
      if (i >= 0 && j >= 0 && k >= 0 && i + 1 < size.x && j + 1 < size.y && k + 1 < size.z) {
        const std::int16_t* const v = hounsfield + (i + row * j + layer * k);
        const float u = p.x - static_cast<float>(i), w = p.y - static_cast<float>(j), t = p.z - static_cast<float>(k);
        const auto along = [u](const std::int16_t* a) {
          return static_cast<float>(a[0]) + u * static_cast<float>(a[1] - a[0]);
        };
        const float near = along(v) + w * (along(v + row) - along(v)),
                    far = along(v + layer) + w * (along(v + layer + row) - along(v + layer));
        hu = near + t * (far - near);
      }
      const float grey = std::clamp(per_hu * (hu - low_hu), 0.0F, 255.0F);
      const std::uint8_t here = here_row[x], beside = here_row[x + 1],
                         under = here_row[static_cast<std::size_t>(x) + width];
      const bool is_tooth = here != 0 && here != kBoneVoxel;
      if (!is_tooth && here == beside && here == under) {
        out[0] = out[1] = out[2] = static_cast<std::uint8_t>(grey + 0.5F);
        continue;
      }
      glm::dvec3 colour(grey);
      if (is_tooth) colour = glm::mix(colour, colourOf(here), kTint);
      if (is_other(here, beside) || is_other(here, under)) {
        const std::uint8_t owner = is_tooth ? here : is_other(here, beside) ? beside : under;
        colour = glm::mix(colour, colourOf(owner), kOutline);
      }
      for (int c = 0; c < 3; ++c) out[c] = byteOf(colour[c]);
    }
  });
  return image;
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
  for (const double away_mm : {0.0, -1.5, 1.5, -3.0, 3.0, -4.5, 4.5, -6.0, 6.0}) {
    const glm::dvec3 p(on + away_mm * across, z);
    if (const std::uint8_t what = whatAt(p); what != 0 && what != kBoneVoxel) return p;
  }
  return needs_tooth ? std::nullopt : std::optional(glm::dvec3(on, z));
}

render::Image JawViews::panoramic(const GreyRange& range, glm::ivec2 px) const {
  render::Image image{px.x, px.y, std::vector<std::uint8_t>(4 * assets::countIn({px, 1}), 0)};
  for (std::size_t n = 3; n < image.rgba.size(); n += 4) image.rgba[n] = 255;
  if (unrolled_.hounsfield.empty()) return image;
  const double scale = panoramicScale(px);
  const glm::dvec2 corner = 0.5 * (glm::dvec2(px) - scale * glm::dvec2(unrolled_.size_px));
  // The layer averages bone with soft tissue and air.
  const double low = range.low_hu - 250.0, high = 0.62 * range.high_hu;
  tbb::parallel_for(0, px.y, [&](int y) {
    for (int x = 0; x < px.x; ++x) {
      const glm::ivec2 cell(glm::floor((glm::dvec2(x + 0.5, y + 0.5) - corner) / scale));
      if (glm::any(glm::lessThan(cell, glm::ivec2(0))) || glm::any(glm::greaterThanEqual(cell, unrolled_.size_px)))
        continue;
      const double hu = unrolled_.hounsfield[static_cast<std::size_t>(cell.y * unrolled_.size_px.x + cell.x)];
      glm::dvec3 colour(255.0 * std::clamp((hu - low) / (high - low), 0.0, 1.0));
      if (const auto p = inPanoramicAt(glm::dvec2(x + 0.5, y + 0.5), px, true))
        colour = glm::mix(colour, colourOf(whatAt(*p)), 1.4 * kTint);
      for (std::size_t c = 0; c < 3; ++c)
        image.rgba[4 * static_cast<std::size_t>(y * px.x + x) + c] = byteOf(colour[static_cast<int>(c)]);
    }
  });
  return image;
}

// `from` and `step` in voxels, `step` a unit vector: the first tooth along the ray; the shade of bone before it.
JawViews::Hit JawViews::along(const glm::dvec3& from, const glm::dvec3& step, double reach, float* bone_shade) const {
  const glm::ivec3 size = grid().size, bricks = grid().bricks();
  const auto normal_at = [&](glm::ivec3 at, bool of_tooth) {
    glm::dvec3 out(0.0);
    for (int k = -2; k <= 2; ++k)
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const glm::ivec3 ijk = at + glm::ivec3(i, j, k);
          const std::uint8_t what = grid().contains(ijk) ? what_[grid().index(ijk)] : std::uint8_t{0};
          if (of_tooth ? what == 0 || what == kBoneVoxel : what == 0) out += glm::dvec3(i, j, k);
        }
    return out / std::max(glm::length(out), 1e-9);
  };
  for (double t = 0.0; t < reach;) {
    const glm::dvec3 at = from + t * step;
    const glm::ivec3 cell(glm::floor(at + 0.5));
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, size))) {
      t += 1.0;
      continue;
    }
    if (is_used_[assets::indexIn(bricks, cell / kBrick)] == 0) {
      t += toNextCell(at + 0.5, step, kBrick) + 0.01;
      continue;
    }
    const std::uint8_t what = what_[grid().index(cell)];
    if (what != 0 && what != kBoneVoxel) return {grid().origin_P_mm + grid().spacing_mm * at, what};
    if (what == kBoneVoxel && bone_shade != nullptr && *bone_shade < 0.0F)
      *bone_shade = static_cast<float>(std::abs(glm::dot(normal_at(cell, false), step)));
    t += 0.7;
  }
  return {};
}

render::Image JawViews::solid(const Plane& plane, glm::ivec2 px) const {
  render::Image image{px.x, px.y, std::vector<std::uint8_t>(4 * assets::countIn({px, 1}), 255)};
  const glm::dvec3 step = plane.normal_P();
  tbb::parallel_for(0, px.y, [&](int y) {
    for (int x = 0; x < px.x; ++x) {
      float bone = -1.0F;
      const glm::dvec3 from = grid().indexFromPoint(plane.at({x + 0.5, y + 0.5}) - kSolidReach_mm * step);
      const Hit hit = along(from, step, 2.0 * kSolidReach_mm / grid().spacing_mm, &bone);
      glm::dvec3 colour(13.0, 15.0, 18.0);
      if (hit.what != 0) {
        // The side that is lit is the one that is seen.
        const glm::ivec3 cell(glm::floor(grid().indexFromPoint(hit.at_P_mm) + 0.5));
        glm::dvec3 out(0.0);
        for (int k = -2; k <= 2; ++k)
          for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i) {
              const glm::ivec3 ijk = cell + glm::ivec3(i, j, k);
              if (!grid().contains(ijk) || what_[grid().index(ijk)] != hit.what) out += glm::dvec3(i, j, k);
            }
        const double light = std::max(0.0, -glm::dot(out / std::max(glm::length(out), 1e-9), step));
        colour = colourOf(hit.what) * (0.22 + 0.78 * light);
      }
      if (bone >= 0.0F)
        colour = glm::mix(colour, colourOf(kBoneVoxel) * (0.15 + 0.6 * bone), kBoneShare * (1.1 - 0.6 * bone));
      for (std::size_t c = 0; c < 3; ++c)
        image.rgba[4 * static_cast<std::size_t>(y * px.x + x) + c] = byteOf(colour[static_cast<int>(c)]);
    }
  });
  return image;
}

render::Image JawViews::picture(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look,
                                const GreyRange& range, glm::ivec2 px) const {
  if (view == JawView::panoramic) return panoramic(range, px);
  const Plane plane = planeOf(view, cursor_P_mm, look, px);
  return view == JawView::solid ? solid(plane, px) : slice(plane, range, px);
}

std::optional<glm::dvec3> JawViews::pointAt(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look,
                                            glm::ivec2 px, const glm::dvec2& at_px) const {
  if (view == JawView::panoramic) return inPanoramicAt(at_px, px, false);
  const Plane plane = planeOf(view, cursor_P_mm, look, px);
  if (view != JawView::solid) return plane.at(at_px);
  const glm::dvec3 step = plane.normal_P();
  const Hit hit = along(grid().indexFromPoint(plane.at(at_px) - kSolidReach_mm * step), step,
                        2.0 * kSolidReach_mm / grid().spacing_mm, nullptr);
  return hit.what != 0 ? std::optional(hit.at_P_mm) : std::nullopt;
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
