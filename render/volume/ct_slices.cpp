#include "render/volume/ct_slices.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "render/gpu/gpu_error.h"
#include "render/shaders/shared_constants.glsl"
#include "render/volume/bur_distance.h"
#include "render/volume/slice_text.h"
#include "render/volume/volume_fields.h"

namespace render {
namespace {

constexpr float kLevel_HU = 500.0f, kWindow_HU = 2500.0f;
constexpr float kAir_HU = -1000.0f;
constexpr double kScale_mm = 5.0;
constexpr int kLeastEdgeForText_px = 96, kLeastLine_px = 12;
constexpr float kFar_mm = 1e3f;
constexpr double kCanalStep_mm = 0.25;
constexpr double kRulerSlab_mm = 0.5;  // half of the thickness in which the ruler belongs to a slice

// sRGB 0..255.
const glm::vec3 kCarved{70.0f, 12.0f, 16.0f}, kCanal{250.0f, 205.0f, 60.0f}, kBur{90.0f, 225.0f, 255.0f},
    kPlan{70.0f, 140.0f, 255.0f}, kCross{110.0f, 150.0f, 165.0f}, kRuler{40.0f, 240.0f, 195.0f},
    kText{225.0f, 232.0f, 235.0f}, kRim{14.0f, 16.0f, 18.0f};

/// A plane in the volume: its axes as voxel axes, the sign of the vertical one in the image, and the labels.
struct Layout {
  int right_axis, down_axis, normal_axis;
  int down_sign;  // right is always towards larger voxel indices: left, or posterior
  const char *name, *left_side, *right_side;
};

// In the order of SlicePlane.
constexpr std::array<Layout, 3> kLayouts{
    {{0, 1, 2, 1, "axial", "R", "L"}, {0, 2, 1, -1, "coronal", "R", "L"}, {1, 2, 0, -1, "sagittal", "A", "P"}}};

/// The image of a slice, and the positions of its pixels in P.
class SliceImage {
 public:
  SliceImage(const Layout& layout, const glm::dvec3& middle_P_mm, int edge_px)
      : edge_px_(edge_px), mm_per_px_(CtSlices::kWidth_mm / edge_px), middle_(middle_P_mm), layout_(layout) {
    image_.w = image_.h = edge_px;
    image_.rgba.assign(4 * static_cast<std::size_t>(edge_px * edge_px), 255);
  }

  int edge_px() const { return edge_px_; }
  double mm_per_px() const { return mm_per_px_; }
  /// Offset of a column or row from the centre, mm: to the right, and downwards.
  double offset_mm(int pixel) const { return (pixel + 0.5 - 0.5 * edge_px_) * mm_per_px_; }
  glm::dvec2 pixelOf(const glm::dvec3& p_P_mm) const {
    return {columnOf(p_P_mm[layout_.right_axis]), rowOf(p_P_mm[layout_.down_axis])};
  }
  double columnOf(double p_P_mm) const { return (p_P_mm - middle_[layout_.right_axis]) / mm_per_px_ + 0.5 * edge_px_; }
  double rowOf(double p_P_mm) const {
    return layout_.down_sign * (p_P_mm - middle_[layout_.down_axis]) / mm_per_px_ + 0.5 * edge_px_;
  }
  glm::dvec3 position_P_mm(int x, int y) const {
    glm::dvec3 p = middle_;
    p[layout_.right_axis] += offset_mm(x);
    p[layout_.down_axis] += layout_.down_sign * offset_mm(y);
    return p;
  }

  void blend(int x, int y, const glm::vec3& colour, float alpha) {
    if (alpha <= 0.0f || x < 0 || y < 0 || x >= edge_px_ || y >= edge_px_) return;
    std::uint8_t* const to = &image_.rgba[4 * static_cast<std::size_t>(y * edge_px_ + x)];
    for (int c = 0; c < 3; ++c)
      to[c] = static_cast<std::uint8_t>(glm::mix(static_cast<float>(to[c]), colour[c], std::min(alpha, 1.0f)) + 0.5f);
  }
  void set(int x, int y, const glm::vec3& colour) { blend(x, y, colour, 1.0f); }
  void fill(int left, int top, int width, int height, const glm::vec3& colour) {
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) set(x, y, colour);
  }
  Image take() { return std::move(image_); }

 private:
  int edge_px_;
  double mm_per_px_;
  glm::dvec3 middle_;
  Layout layout_;
  Image image_;
};

/// The lower of two neighbouring voxels along an axis, and the weight of the upper.
struct Between {
  int low;
  float part;
};
Between between(double index) {
  const double low = std::floor(index);
  return {static_cast<int>(low), static_cast<float>(index - low)};
}

/// A field of voxels in memory, and the value outside.
template <class T>
struct Voxels {
  const T* first;
  glm::i64vec3 stride;
  float outside;
};

template <class T>
Voxels<T> inGridOrder(const assets::VolumeGrid& grid, std::span<const T> values, float outside) {
  return {values.data(), {1, grid.size.x, std::int64_t{grid.size.x} * grid.size.y}, outside};
}

/// One row of a slice: values along an axis from voxel `first` on, interpolated from the four surrounding voxel rows.
template <class T>
void mixRow(const assets::VolumeGrid& grid, const Voxels<T>& voxels, const Layout& layout, Between down, Between normal,
            int first, std::vector<float>& row) {
  std::ranges::fill(row, 0.0f);
  const int inside_from = std::clamp(-first, 0, static_cast<int>(row.size()));
  const int inside_to = std::clamp(grid.size[layout.right_axis] - first, inside_from, static_cast<int>(row.size()));
  const std::int64_t stride = voxels.stride[layout.right_axis];
  for (int corner = 0; corner < 4; ++corner) {
    const int j = down.low + (corner & 1), k = normal.low + (corner >> 1);
    const float weight = (corner & 1 ? down.part : 1.0f - down.part) * (corner >> 1 ? normal.part : 1.0f - normal.part);
    const bool is_inside = j >= 0 && j < grid.size[layout.down_axis] && k >= 0 && k < grid.size[layout.normal_axis];
    const int from_n = is_inside ? inside_from : 0, to_n = is_inside ? inside_to : 0;
    for (int n = 0; n < from_n; ++n) row[static_cast<std::size_t>(n)] += weight * voxels.outside;
    for (int n = to_n; n < static_cast<int>(row.size()); ++n)
      row[static_cast<std::size_t>(n)] += weight * voxels.outside;
    if (!is_inside) continue;
    const T* from = voxels.first + j * voxels.stride[layout.down_axis] + k * voxels.stride[layout.normal_axis] +
                    std::int64_t{first + from_n} * stride;
    for (int n = from_n; n < to_n; ++n, from += stride)
      row[static_cast<std::size_t>(n)] += weight * static_cast<float>(*from);
  }
}

float along(const std::vector<float>& row, Between at) {
  const auto low = static_cast<std::size_t>(at.low);
  return glm::mix(row[low], row[low + 1], at.part);
}

/// Coverage of a pixel by a line 1.6 px wide at that distance from its centre.
float lineCover(double distance_px) { return static_cast<float>(std::clamp(1.3 - std::abs(distance_px), 0.0, 1.0)); }

/// Signed distances to a shape, mm, one per pixel.
struct DistanceField {
  int edge;
  std::vector<float> mm = std::vector<float>(static_cast<std::size_t>(edge * edge), kFar_mm);
  float& at(int x, int y) { return mm[static_cast<std::size_t>(y * edge + x)]; }
};

/// Draws the zero line of a distance field.
void drawOutline(SliceImage& slice, DistanceField& distance, const glm::vec3& colour) {
  const int edge = distance.edge;
  const auto near_mm = static_cast<float>(6.0 * slice.mm_per_px());
  const auto at = [&](int x, int y) { return double{distance.at(x, y)}; };
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      if (std::abs(distance.at(x, y)) > near_mm) continue;
      // Normalise by the gradient: a slice oblique to the shape has a small one.
      const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, edge - 1), y0 = std::max(y - 1, 0),
                y1 = std::min(y + 1, edge - 1);
      const double rise = std::hypot((at(x1, y) - at(x0, y)) / (x1 - x0), (at(x, y1) - at(x, y0)) / (y1 - y0));
      if (rise > 1e-6) slice.blend(x, y, colour, lineCover(at(x, y) / rise));
    }
}

void drawCanal(SliceImage& slice, const Layout& layout, const glm::dvec3& middle, const CtScan& scan) {
  const int edge = slice.edge_px();
  const double reach_mm = scan.mandibular_canal_radius_mm + 3.0 * slice.mm_per_px();
  DistanceField distance{edge};
  for (std::size_t n = 0; n + 1 < scan.mandibular_canal_P_mm.size(); ++n) {
    const glm::dvec3 a = scan.mandibular_canal_P_mm[n], b = scan.mandibular_canal_P_mm[n + 1];
    const glm::dvec3 low = glm::min(a, b) - reach_mm, high = glm::max(a, b) + reach_mm;
    if (middle[layout.normal_axis] < low[layout.normal_axis] || middle[layout.normal_axis] > high[layout.normal_axis])
      continue;
    const double ya = slice.rowOf(low[layout.down_axis]), yb = slice.rowOf(high[layout.down_axis]);
    const int x0 = std::max(0, static_cast<int>(slice.columnOf(low[layout.right_axis])));
    const int x1 = std::min(edge - 1, static_cast<int>(slice.columnOf(high[layout.right_axis])));
    const int y0 = std::max(0, static_cast<int>(std::min(ya, yb)));
    const int y1 = std::min(edge - 1, static_cast<int>(std::max(ya, yb)));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double wall_mm =
            calibration::distanceToSegment(slice.position_P_mm(x, y), a, b) - scan.mandibular_canal_radius_mm;
        distance.at(x, y) = std::min(distance.at(x, y), static_cast<float>(wall_mm));
      }
  }
  drawOutline(slice, distance, kCanal);
}

/// mm to the planned cut, from the field of the guides, trilinear.
double planDistance_mm(const assets::VolumeGrid& grid, const GuideField& guides, const glm::dvec3& p_P_mm) {
  const glm::dvec3 cell = (grid.indexFromPoint(p_P_mm) + 0.5) / double{AMBIENT_CELL_VOXELS} - 0.5;
  const glm::dvec3 at = glm::clamp(cell, glm::dvec3(-1.0), glm::dvec3(guides.layout().size) - 1e-6);
  const glm::ivec3 low(glm::floor(at));
  const glm::dvec3 part = at - glm::dvec3(low);
  double share = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 bit = assets::cornerOffset(corner);
    const glm::dvec3 weight = glm::mix(1.0 - part, part, glm::dvec3(bit));
    share += weight.x * weight.y * weight.z * (*guides.at(low + bit)).y;
  }
  return GUIDE_LOW_MM + share / 65535.0 * (double{GUIDE_HIGH_MM} - double{GUIDE_LOW_MM});
}

void drawPlan(SliceImage& slice, const assets::VolumeGrid& grid, const GuideField& guides) {
  const int edge = slice.edge_px();
  DistanceField distance{edge};
  bool any = false;
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      const double mm = planDistance_mm(grid, guides, slice.position_P_mm(x, y));
      distance.at(x, y) = static_cast<float>(mm);
      any = any || mm < 0.0;
    }
  if (any) drawOutline(slice, distance, kPlan);
}

void drawBur(SliceImage& slice, const Frame& frame) {
  // In T, pixels lie on a regular grid around the origin.
  const auto X_TP = frame.X_PT.inverse();
  const auto position_T = [&](int x, int y) {
    return (X_TP * calibration::Point<calibration::Patient>{slice.position_P_mm(x, y)}).mm;
  };
  const glm::dvec3 corner = position_T(0, 0), right = position_T(1, 0) - corner, down = position_T(0, 1) - corner;
  const int edge = slice.edge_px();
  const double reach_mm = burReach_mm(frame) + 8.0 * slice.mm_per_px();
  const int reach = static_cast<int>(std::min<double>(edge, reach_mm / slice.mm_per_px()));
  const glm::dvec2 middle = slice.pixelOf(frame.X_PT.translation_mm);
  const int x0 = std::clamp(static_cast<int>(middle.x) - reach, 0, edge);
  const int x1 = std::clamp(static_cast<int>(middle.x) + reach, 0, edge);
  const int y0 = std::clamp(static_cast<int>(middle.y) - reach, 0, edge);
  const int y1 = std::clamp(static_cast<int>(middle.y) + reach, 0, edge);
  DistanceField distance{edge};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      distance.at(x, y) = static_cast<float>(burDistance_mm(frame, corner + double(x) * right + double(y) * down));
  drawOutline(slice, distance, kBur);
}

/// Thin lines through the centre, interrupted at the bur.
void drawCross(SliceImage& slice, double gap_mm) {
  const int middle = slice.edge_px() / 2;
  for (int n = 0; n < slice.edge_px(); ++n) {
    if (std::abs(slice.offset_mm(n)) < gap_mm) continue;
    slice.blend(n, middle, kCross, 0.4f);
    slice.blend(middle, n, kCross, 0.4f);
  }
}

/// Height of a line of text in an image, and the gap around it.
int lineOf(int edge_px) { return std::max(kLeastLine_px, edge_px / 14); }
int gapOf(int edge_px) { return std::max(2, edge_px / 60); }

// With a dark outline, legible on bone too.
void drawText(SliceImage& slice, const std::string& word, const glm::ivec2& corner_px) {
  forWordPixels(wordPixels(word, lineOf(slice.edge_px())), corner_px,
                [&](int x, int y, bool is_rim, float share) { slice.blend(x, y, is_rim ? kRim : kText, share); });
}

/// The way from bur to canal, below the middle, where the image has room for it.
void drawCanalDistance(SliceImage& slice, const Frame& frame, const CtScan& scan) {
  const auto mm = canalDistance_mm(frame, scan);
  const int edge = slice.edge_px(), gap = gapOf(edge);
  if (!mm || edge < kLeastEdgeForText_px) return;
  char text[32];
  std::snprintf(text, sizeof text, *mm < 10.0 ? "canal %.1f mm" : "canal %.0f mm", *mm);
  drawText(slice, text, {gap, edge - 2 * gap - 2 * lineOf(edge)});
}

/// The part of the ruler in the slice, and its whole length; nothing where it does not pass through.
void drawRuler(SliceImage& slice, const Layout& layout, const glm::dvec3& middle, const Frame& frame) {
  if (!frame.ruler) return;
  const glm::dvec3 from = frame.ruler->from_P.mm,
                   way = frame.ruler->to_P ? frame.ruler->to_P->mm - from : glm::dvec3(0.0);
  // Shares of the way between which it is in the slab.
  const double height = middle[layout.normal_axis] - from[layout.normal_axis], rise = way[layout.normal_axis];
  double first = 0.0, last = 1.0;
  if (std::abs(rise) > 1e-9) {
    const double a = (height - kRulerSlab_mm) / rise, b = (height + kRulerSlab_mm) / rise;
    first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
  } else if (std::abs(height) > kRulerSlab_mm) {
    return;
  }
  if (first > last) return;
  const glm::dvec2 begin = slice.pixelOf(from + first * way), end = slice.pixelOf(from + last * way);
  const int edge = slice.edge_px();
  const double bead_px = std::max(2.0, 0.4 / slice.mm_per_px());
  const auto around = [&](const glm::dvec2& low, const glm::dvec2& high, double reach, auto cover) {
    const glm::ivec2 from_px = glm::max(glm::ivec2(glm::floor(low - reach)), 0);
    const glm::ivec2 to_px = glm::min(glm::ivec2(glm::ceil(high + reach)), edge - 1);
    for (int y = from_px.y; y <= to_px.y; ++y)
      for (int x = from_px.x; x <= to_px.x; ++x) slice.blend(x, y, kRuler, cover(glm::dvec2(x, y) + 0.5));
  };
  around(glm::min(begin, end), glm::max(begin, end), 2.0, [&](const glm::dvec2& p) {
    return lineCover(calibration::distanceToSegment(glm::dvec3(p, 0.0), glm::dvec3(begin, 0.0), glm::dvec3(end, 0.0)));
  });
  // Marked points in the slab.
  for (const double share : {0.0, 1.0})
    if (first <= share && share <= last)
      around(slice.pixelOf(from + share * way), slice.pixelOf(from + share * way), bead_px + 1.0,
             [&](const glm::dvec2& p) {
               const double away = glm::distance(p, slice.pixelOf(from + share * way));
               return static_cast<float>(std::clamp(bead_px + 0.5 - away, 0.0, 1.0));
             });
  if (!frame.ruler->to_P || edge < kLeastEdgeForText_px) return;
  char text[32];
  std::snprintf(text, sizeof text, "ruler %.1f mm", frame.ruler->length_mm());
  drawText(slice, text, {gapOf(edge), gapOf(edge) + lineOf(edge)});
}

/// Trilinear, of values in the order of a grid.
template <class T>
float valueAt(const assets::VolumeGrid& grid, const Voxels<T>& voxels, const glm::dvec3& p_mm) {
  const glm::dvec3 index = grid.indexFromPoint(p_mm);
  const Between at[3] = {between(index.x), between(index.y), between(index.z)};
  float sum = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 off = assets::cornerOffset(corner);
    const glm::ivec3 ijk = glm::ivec3(at[0].low, at[1].low, at[2].low) + off;
    float weight = 1.0f;
    for (int axis = 0; axis < 3; ++axis) weight *= off[axis] != 0 ? at[axis].part : 1.0f - at[axis].part;
    const bool is_inside = grid.contains(ijk);
    const std::int64_t offset = voxels.stride.x * ijk.x + voxels.stride.y * ijk.y + voxels.stride.z * ijk.z;
    sum += weight * (is_inside ? static_cast<float>(voxels.first[offset]) : voxels.outside);
  }
  return sum;
}

float shadeOf(float hounsfield) { return std::clamp((hounsfield - kLevel_HU) / kWindow_HU + 0.5f, 0.0f, 1.0f); }

/// As scanned, turned and moved with the piece.
void drawMovedPiece(SliceImage& slice, const PlacedFields& piece, const assets::VolumeGrid& scan_grid,
                    const Voxels<std::int16_t>& grey) {
  const assets::VolumeGrid& grid = piece.fields->grid();
  const BorderedField<std::uint8_t>& field = piece.fields->solid();
  const Voxels<std::uint8_t> solid{field.at({0, 0, 0}), {1, field.layout().row, field.layout().slice}, 0.0f};
  const auto X_QP = piece.X_PQ.inverse();
  const glm::dvec3 last(grid.size);
  for (int y = 0; y < slice.edge_px(); ++y)
    for (int x = 0; x < slice.edge_px(); ++x) {
      const glm::dvec3 q = (X_QP * calibration::Point<calibration::Patient>{slice.position_P_mm(x, y)}).mm;
      const glm::dvec3 index = grid.indexFromPoint(q);
      if (glm::any(glm::lessThan(index, glm::dvec3(-1.0))) || glm::any(glm::greaterThan(index, last))) continue;
      const float share = valueAt(grid, solid, q) / 255.0f;
      if (share > 0.0f) slice.blend(x, y, glm::vec3(255.0f * shadeOf(valueAt(scan_grid, grey, q))), share);
    }
}

void drawLabels(SliceImage& slice, const Layout& layout) {
  const int edge = slice.edge_px(), dot = std::max(1, edge / 200), gap = gapOf(edge), line = lineOf(edge);
  const auto width = [&](const std::string& word) { return wordPixels(word, line).size_px.x; };
  drawText(slice, layout.name, {gap, gap});
  drawText(slice, layout.left_side, {gap, (edge - line) / 2});
  drawText(slice, layout.right_side, {edge - gap - width(layout.right_side), (edge - line) / 2});

  // The scale, with ends.
  const int length = static_cast<int>(std::lround(kScale_mm / slice.mm_per_px()));
  const int left = edge - gap - length, base = edge - gap - 1;
  for (const int rim : {1, 0}) {
    const glm::vec3& colour = rim ? kRim : kText;
    slice.fill(left - rim, base - dot + 1 - rim, length + 1 + 2 * rim, dot + 2 * rim, colour);
    for (const int x : {left, left + length})
      slice.fill(x - rim, base - 3 * dot + 1 - rim, 1 + 2 * rim, 3 * dot + 2 * rim, colour);
  }
  const std::string scale = "5 mm";
  drawText(slice, scale, {left - gap - width(scale), edge - gap - line});
}

}  // namespace

CtSlices::CtSlices(const assets::VolumeGrid& grid, CtScan scan) : grid_(grid), scan_(std::move(scan)) {
  if (scan_.solid.size() != grid.voxelCount() || scan_.hounsfield.size() != grid.voxelCount())
    throw GpuError("scan of " + std::to_string(scan_.hounsfield.size()) + " grey values, CT slices: the volume has " +
                   std::to_string(grid.voxelCount()) + " voxels, give one value for each");
}

Image CtSlices::image(SlicePlane plane, const Frame& frame, const BorderedField<std::uint8_t>& live, int edge_px,
                      const GuideField* guides, std::span<const PlacedFields> moved) const {
  const Layout& layout = kLayouts[static_cast<std::size_t>(plane)];
  const glm::dvec3 middle = frame.X_PT.translation_mm + frame.slices_beside_bur_P_mm;
  SliceImage slice(layout, middle, edge_px);
  const Between normal = between(grid_.indexFromPoint(middle)[layout.normal_axis]);

  // Grey values, and the carved share.
  const Voxels<std::int16_t> grey = inGridOrder(grid_, scan_.hounsfield, kAir_HU);
  const Voxels<std::uint8_t> before = inGridOrder(grid_, scan_.solid, 0.0f);
  const Voxels<std::uint8_t> now{live.at({0, 0, 0}), {1, live.layout().row, live.layout().slice}, 0.0f};
  const int first = between(grid_.indexFromPoint(slice.position_P_mm(0, 0))[layout.right_axis]).low;
  std::vector<Between> columns;
  for (int x = 0; x < edge_px; ++x) {
    columns.push_back(between(grid_.indexFromPoint(slice.position_P_mm(x, 0))[layout.right_axis]));
    columns.back().low -= first;
  }
  const auto length = static_cast<std::size_t>(columns.back().low) + 2;
  std::vector<float> grey_row(length), before_row(length), now_row(length);
  for (int y = 0; y < edge_px; ++y) {
    const Between down = between(grid_.indexFromPoint(slice.position_P_mm(0, y))[layout.down_axis]);
    mixRow(grid_, grey, layout, down, normal, first, grey_row);
    mixRow(grid_, before, layout, down, normal, first, before_row);
    mixRow(grid_, now, layout, down, normal, first, now_row);
    for (int x = 0; x < edge_px; ++x) {
      const Between right = columns[static_cast<std::size_t>(x)];
      slice.set(x, y, glm::vec3(255.0f * shadeOf(along(grey_row, right))));
      const float solid = along(before_row, right), carved = solid - along(now_row, right);
      if (carved > 0.0f) slice.blend(x, y, kCarved, carved / std::max(solid, 64.0f));
    }
  }

  for (const PlacedFields& piece : moved) drawMovedPiece(slice, piece, grid_, grey);
  drawCanal(slice, layout, middle, scan_);
  if (guides != nullptr && frame.layers.planned_cut) drawPlan(slice, grid_, *guides);
  drawCross(slice, frame.bur_radius_mm + 1.0);
  drawBur(slice, frame);
  drawRuler(slice, layout, middle, frame);
  drawLabels(slice, layout);
  drawCanalDistance(slice, frame, scan_);
  return slice.take();
}

std::optional<double> canalDistance_mm(const Frame& frame, const CtScan& scan) {
  if (scan.mandibular_canal_P_mm.size() < 2) return {};
  const auto X_TP = frame.X_PT.inverse();
  double nearest_mm = kFar_mm;
  for (std::size_t n = 0; n + 1 < scan.mandibular_canal_P_mm.size(); ++n) {
    const glm::dvec3 &a = scan.mandibular_canal_P_mm[n], &b = scan.mandibular_canal_P_mm[n + 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / kCanalStep_mm)));
    for (int step = 0; step <= steps; ++step) {
      const calibration::Point<calibration::Patient> p_P{glm::mix(a, b, static_cast<double>(step) / steps)};
      nearest_mm = std::min(nearest_mm, burDistance_mm(frame, (X_TP * p_P).mm));
    }
  }
  return std::max(nearest_mm - scan.mandibular_canal_radius_mm, 0.0);
}

}  // namespace render
