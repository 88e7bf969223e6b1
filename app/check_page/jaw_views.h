// A jaw in its own axes, as pictures without words: slices parallel to the bite, along the arch and across it, the
// panoramic view, and its teeth in three dimensions inside a ghost of the bone. Teeth are tinted and outlined, each in
// the colour of its number. Frame P, mm; radiological: the patient's right is on the left of the picture. Pure but for
// parallel rows (TBB); any one thread. Cost: 2 ms a slice of 420 x 330 px on two cores, 20 ms in three dimensions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/check_page/label_bricks.h"
#include "assets/ct_volume.h"
#include "assets/patient.h"
#include "assets/scan/panoramic.h"
#include "assets/segment/cell_masks.h"
#include "render/image.h"

namespace app {

/// What a voxel belongs to: an FDI number, or one of these.
inline constexpr std::uint8_t kBoneVoxel = 200, kPieceVoxel = 255;

/// Unit vectors: to the patient's left, to the back, up from the bite.
struct JawAxes {
  glm::dvec3 left_P{1, 0, 0}, back_P{0, 1, 0}, up_P{0, 0, 1};
};
/// From the tops of the numbered lower teeth; the scan's own axes with fewer than three.
JawAxes jawAxes(const assets::CtVolume& ct);

enum class JawView : std::uint8_t { axial, across, along, panoramic, solid };
inline constexpr std::size_t kJawViews = 5;

/// From where the teeth are seen in three dimensions: turned about the jaw's axis and tilted, from in front.
struct SolidLook {
  double turn_rad = 0.0, tilt_rad = 0.35, zoom = 1.0;
};

struct GreyRange {
  double low_hu = -300.0, high_hu = 2200.0;
};

/// Pixels below `end`, from `low`.
struct PixelBox {
  glm::ivec2 low{0}, end{0};
  bool isEmpty() const { return glm::any(glm::lessThanEqual(end, low)); }
};

class JawViews {
 public:
  /// `patient` must outlive it. `what`: of every voxel.
  JawViews(const assets::Patient& patient, std::vector<std::uint8_t> what);

  /// Other teeth; axes, curve and grey values stay. Around what differs; empty: nothing does.
  assets::CellBox take(std::vector<std::uint8_t> what);
  /// One voxel of them.
  void takeVoxel(const glm::ivec3& ijk, std::uint8_t label, std::uint8_t tooth);
  const std::vector<std::uint8_t>& what() const { return what_; }
  const assets::VolumeGrid& grid() const { return patient_.ct.grid; }
  const JawAxes& axes() const { return axes_; }
  /// Of the patient.
  bool isRight(const glm::dvec3& p_P_mm) const { return p_P_mm.x < midline_x_P_mm_; }
  double midline_x_P_mm() const { return midline_x_P_mm_; }
  glm::dvec3 middle_P_mm() const { return middle_P_mm_; }

  /// Where a picture lies: pixel (0, 0) is the top left corner.
  struct Plane {
    glm::dvec3 corner_P_mm{0.0}, right_P{1, 0, 0}, down_P{0, 1, 0};
    double pixel_mm = 0.2;
    glm::dvec3 at(const glm::dvec2& px) const { return corner_P_mm + pixel_mm * (px.x * right_P + px.y * down_P); }
    glm::dvec3 normal_P() const { return glm::cross(right_P, down_P); }
    /// Pixel and distance from the plane, mm, of a point.
    glm::dvec3 of(const glm::dvec3& p_P_mm) const {
      const glm::dvec3 d = p_P_mm - corner_P_mm;
      return {glm::dot(d, right_P) / pixel_mm, glm::dot(d, down_P) / pixel_mm, glm::dot(d, normal_P())};
    }
  };
  /// A slice through the cursor, or of `solid` the picture plane.
  Plane planeOf(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look, glm::ivec2 px) const;

  render::Image picture(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look, const GreyRange& range,
                        glm::ivec2 px) const;
  /// Draws again what such a picture shows of voxels that were taken since. False: nothing.
  bool redraw(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look, const GreyRange& range,
              const assets::CellBox& changed, render::Image& image) const;
  /// What a click means: a point of a slice; the tooth hit in the panoramic view or in three dimensions. None there.
  std::optional<glm::dvec3> pointAt(JawView view, const glm::dvec3& cursor_P_mm, const SolidLook& look, glm::ivec2 px,
                                    const glm::dvec2& at_px) const;
  /// Of a point in the panoramic view; none beyond its ends.
  std::optional<glm::dvec2> inPanoramic(const glm::dvec3& p_P_mm, glm::ivec2 px) const;

  /// The nearest voxel of the piece within 8 mm; the point itself without one.
  glm::dvec3 nearestOf(std::uint8_t piece, const glm::dvec3& p_P_mm) const;

  /// What the voxel there belongs to.
  std::uint8_t whatAt(const glm::dvec3& p_P_mm) const;

 private:
  void draw(JawView view, const Plane& plane, const GreyRange& range, const PixelBox& box, render::Image& image) const;
  void drawPanoramic(const GreyRange& range, const PixelBox& box, render::Image& image) const;
  PixelBox shownIn(JawView view, const Plane& plane, const assets::CellBox& voxels, glm::ivec2 px) const;
  PixelBox panoramicBoxOf(const glm::dvec3& low_P_mm, const glm::dvec3& high_P_mm, glm::ivec2 px) const;
  std::optional<glm::dvec3> inPanoramicAt(const glm::dvec2& at_px, glm::ivec2 px, bool needs_tooth) const;
  double panoramicScale(glm::ivec2 px) const;

  const assets::Patient& patient_;
  std::vector<std::uint8_t> what_;
  LabelBricks bricks_;
  JawAxes axes_;
  glm::dvec3 middle_P_mm_{0.0};
  double midline_x_P_mm_ = 0.0;
  std::vector<glm::dvec2> curve_P_mm_;
  assets::Panoramic unrolled_;
};

/// Of one voxel's tissue and FDI number.
std::uint8_t whatOf(std::uint8_t label, std::uint8_t tooth);
/// Of the labels of a volume; bone only where `jaw_label` says that it is the lower jaw's.
std::vector<std::uint8_t> whatOf(const assets::CtVolume& ct);
std::vector<std::uint8_t> whatOf(const std::vector<std::uint8_t>& jaw_label, const std::vector<std::uint8_t>& tooth);

/// sRGB 0..255 of a tooth's number or a piece.
glm::dvec3 colourOf(std::uint8_t what);

}  // namespace app
