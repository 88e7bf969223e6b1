// One frame as plain values: what to draw, from which eyes, on which rig. Built once per frame by app for one instant,
// which both eyes show. Frame W unless named. Render thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "assets/instrument/handpiece.h"
#include "assets/mesh.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/rig.h"
#include "render/display/display_mode.h"
#include "render/soft_marks.h"
#include "render/surgical_field.h"

namespace render {

struct SurfacePaint;

/// How tooth and bone are drawn: the surface solid = 0.5, the translucent volume, the surface as triangles, or the
/// volume as clear as glass with the walls of a tooth and its canals.
enum class ViewMode { iso, dvr, mesh, clear };
constexpr bool isTranslucent(ViewMode mode) { return mode == ViewMode::dvr || mode == ViewMode::clear; }

/// Optional layers, and the opacity of the face.
struct Layers {
  float face_opacity = 1.0f;  ///< 0: no face
  bool gingiva = true;
  bool mandibular_canal = false;
  bool clearance = false;    ///< bands of distance to the canal on the bone
  bool planned_cut = false;  ///< bone planned for removal
  bool ghost_tool = false;   ///< the tool at the hand, while the drawn tool is held by the surface
  bool slices = false;       ///< CT slices through the bur
  bool gap_ring = true;      ///< a ring on the bone at Frame::gap, coloured by it
  bool obstacles = true;     ///< Frame::obstacles
  // Of a root-canal file in the hand; what the frame is made from, drawn by ViewMode::clear and Frame::magnified.
  bool clear_tooth = false, tip_inset = false;
  // Of a tooth preparation; what the frame's paint and arrow are made of.
  bool deviation = false;  ///< distance to the ideal
  bool insertion = false;  ///< the way of insertion, and what is undercut
  bool marks = true;       ///< of articulating paper
};

/// Larger gaps are not reported.
inline constexpr double kMaxGap_mm = 10.0;
/// Air between the bur and the drawn surface of tooth and bone (volume/bone_gap.h).
struct BoneGap {
  double mm = 0.0;                                     ///< 0: touching
  calibration::Point<calibration::Patient> nearest_P;  ///< of the surface
};

/// A way that was measured on the patient, drawn as a line; one point until the second is marked.
struct RulerLine {
  calibration::Point<calibration::Patient> from_P;
  std::optional<calibration::Point<calibration::Patient>> to_P;

  double length_mm() const { return to_P ? glm::distance(from_P.mm, to_P->mm) : 0.0; }
};
inline bool operator==(const RulerLine& a, const RulerLine& b) {
  return a.from_P.mm == b.from_P.mm && a.to_P.has_value() == b.to_P.has_value() &&
         (!a.to_P || a.to_P->mm == b.to_P->mm);
}

/// A direction on the patient, drawn as an arrow that is seen through tooth and bone as well.
struct GuideArrow {
  calibration::Point<calibration::Patient> from_P, to_P;
};
inline bool operator==(const GuideArrow& a, const GuideArrow& b) {
  return a.from_P.mm == b.from_P.mm && a.to_P.mm == b.to_P.mm;
}

/// A place shown larger in a corner of the picture, tooth and bone as clear as glass: across `up_P`, which is upright,
/// from the side of the eyes and from so near that nothing of face and gum is in between.
struct Magnified {
  calibration::Point<calibration::Patient> at_P;
  glm::dvec3 up_P{0.0, 0.0, 1.0};  ///< unit
  double across_mm = 2.0;
};

/// Pieces of tooth that can leave the jaw.
inline constexpr std::size_t kMostPieces = 4;
/// The pose of each piece that has left its place in the jaw's volume; none: it lies there, drawn with the jaw.
using MovedPieces = std::array<std::optional<calibration::Pose<calibration::Patient, calibration::Piece>>, kMostPieces>;

/// Small things at the site, drawn as balls or splinters.
enum class BeadKind : std::uint8_t {
  mark,      ///< a place to look at, seen as it is, unlit
  chip,      ///< loose bone or tooth
  follicle,  ///< soft
  stitch,
  drawn,  ///< on a line of the surgeon's own plan
  trail   ///< of a tool's way, unlit; its colour by number: 0 green, 1 yellow, 2 orange, 3 red
};
struct Bead {
  calibration::Point<calibration::Patient> at_P;
  double radius_mm = 0.3;
  BeadKind kind = BeadKind::mark;
  std::uint64_t number = 0;  ///< gives a chip its form, a trail its colour
  glm::dvec3 thin_P{0.0};    ///< unit: flat across it, a patch on a wall; 0: a ball
};
inline bool operator==(const Bead& a, const Bead& b) {
  return a.at_P.mm == b.at_P.mm && a.radius_mm == b.radius_mm && a.kind == b.kind && a.number == b.number &&
         a.thin_P == b.thin_P;
}

/// Bone that has to go before a piece of tooth comes out: voxels, drawn translucent and seen through what covers them.
struct Obstacles {
  double voxel_mm = 0.0;               ///< edge
  std::vector<glm::vec3> middle_P_mm;  ///< of each
  bool operator==(const Obstacles&) const = default;
};

/// The flat glass of a mirror in the second hand: a disc about the origin of its instrument, in the part "Glass".
struct MirrorGlass {
  glm::dvec3 out_O{0.0, 0.0, 1.0};  ///< unit, out of the glass
  double radius_mm = 0.0;
  double fog = 0.0;  ///< 0..1, of breath and spray, drawn as a grey veil
};

/// Light of a curing lamp: from its tip along an axis, no wider than its rod; blue, on whatever it reaches, without
/// shadows.
struct CuringSpot {
  calibration::Point<calibration::Patient> tip_P;
  glm::dvec3 axis_P{0.0, 0.0, -1.0};  ///< unit, away from the lamp
  double radius_mm = 4.0, reach_mm = 8.0;
};

enum class Antialias { none, edges };

/// Quality settings that a slower machine can reduce. The drawn surface moves only for `step_voxels` above one half.
struct Quality {
  Antialias antialias = Antialias::none;
  bool ambient_occlusion = true, lamp_shadow = true;
  double step_voxels = 0.5;  ///< between samples along a ray
  int pixel_edge = 1;        ///< display pixels along the edge of a computed pixel
  bool tool_shadow = true;   ///< of the instrument, on the patient
  /// Pixels that are larger than the display's are joined along edges, not only evenly. On the processor alone; it
  /// takes about as long as to compute them at a quarter of the resolution.
  bool smooth_enlarged_edges = true;
};

struct Frame {
  calibration::Rig rig;  ///< screen, mirror, eyes, X_WP
  DisplayMode display = DisplayMode::mono;
  glm::ivec2 output_at_px{0};  ///< top left of the output on the panel, for interleaved displays
  bool eyes_swapped = false;   ///< the display shows the left image to the right eye
  ViewMode mode = ViewMode::iso;
  Layers layers;
  Quality quality;
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;          ///< the tool as drawn
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT_at_hand;  ///< the tool at the hand, for the ghost
  double bur_radius_mm = 2.0;
  assets::BurForm bur_form = assets::BurForm::round;  ///< for the outlines in the slices
  double bur_length_mm = 0.0;
  assets::BurProfile bur_profile = assets::BurProfile::wheel;  ///< of a revolved bur
  double shaft_radius_mm = 0.0;  ///< of the bur, behind its head; 0: what is usual for its radius
  double bur_angle_rad = 0.0;    ///< rotation of the bur
  std::optional<BoneGap> gap;    ///< of this pose; none: farther than kMaxGap_mm, or not known
  std::optional<RulerLine> ruler;
  std::optional<GuideArrow> arrow;
  std::optional<Magnified> magnified;
  glm::dvec3 slices_beside_bur_P_mm{0.0};  ///< where the CT slices cross, from the bur
  std::optional<CuringSpot> curing;        ///< none: it is off
  bool tool_visible = true;
  bool tool_shades = true;    ///< as a bur does; forceps, elevators and hand instruments have no parts for it
  bool has_handpiece = true;  ///< behind the bur; it shades, too
  calibration::Pose<calibration::Patient, calibration::OtherTool> X_PO;  ///< the second instrument
  bool second_visible = false;
  std::optional<MirrorGlass> second_glass;  ///< reflects the scene; none: as its material
  MovedPieces pieces;                       ///< X_PQ of FrameRenderer::setPiece()
  double face_window_mm = 0.0;  ///< the face is cut away within this distance of the line eye-to-site; 0: never
  calibration::Point<calibration::Patient> site_P;
  SurgicalField field;
  SoftMarks marks;
  std::vector<Bead> beads;
  Obstacles obstacles;
  /// Gum that is cut and raised, in P; borrowed until the frame is drawn. The renderer takes what has a new serial.
  const assets::MeshModel* flap = nullptr;  ///< null: none
  const assets::MeshModel* gum = nullptr;   ///< the gum around it, instead of FrameRenderer::setGingiva()
  std::uint64_t flap_serial = 0, gum_serial = 0;
  /// On tooth and bone, drawn as a surface; borrowed alike.
  const SurfacePaint* paint = nullptr;  ///< null: none
  std::uint64_t paint_serial = 0;
};

}  // namespace render
