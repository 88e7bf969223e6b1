// Draws frames: jaw, face, gingiva and instruments for each eye, then the image for the display. The public interface
// of this folder. Needs a current OpenGL 4.5 context (OffscreenContext or Window) that outlives it, except for
// Backend::cpu. Render thread only. Linear light throughout, encoded to sRGB once, when the output is composed. Bricks
// given before render() are in both eyes of that frame. Reading back waits for the GPU.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assets/mesh.h"
#include "assets/volume_grid.h"
#include "render/display/eye_projection.h"
#include "render/display/overlay.h"
#include "render/frame.h"
#include "render/gpu/window_target.h"
#include "render/image.h"
#include "render/render_options.h"
#include "render/volume/bone_gap.h"
#include "render/volume/ct_slices.h"
#include "render/volume/guide_field.h"
#include "render/volume/piece_mesh.h"
#include "render/volume/volume_fields.h"

namespace render {

/// Height of a CT slice, and the gap around it: shares of the height of the viewer's screen.
inline constexpr double kSliceHeight = 0.3, kInsetGap = 0.025;

class SceneRenderer;
class WindowUpload;

class FrameRenderer {
 public:
  /// `solid` and `label` in the order of `grid`; label may be empty. Throws GpuError.
  FrameRenderer(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                std::span<const std::uint8_t> label, RenderOptions options = {});
  ~FrameRenderer();

  /// An empty model removes the previous one. Face and gingiva in P, the instrument in T, the second instrument in O.
  void setFace(const assets::MeshModel& face_P);
  void setGingiva(const assets::MeshModel& gum_P);
  void setInstrument(const assets::MeshModel& instrument_T);
  void setSecondInstrument(const assets::MeshModel& instrument_O);
  /// Of broken files, in P: seen where the tooth is open or clear.
  void setFragments(const assets::MeshModel& wires_P);
  /// Piece n of Frame::pieces in its frame Q; `solid` in the order of `grid_Q`. Drawn where a frame gives its pose,
  /// with the tissue that the volume has there in P; it shades the rest and itself. No values: removes it. Throws
  /// GpuError.
  void setPiece(std::size_t piece, const assets::VolumeGrid& grid_Q, std::span<const std::uint8_t> solid);
  /// As updateBrick(), of a piece that was set.
  void updatePieceBrick(std::size_t piece, glm::ivec3 brick,
                        std::span<const std::uint8_t, Occupancy::kBrickValues> solid);
  /// Canal and planned cut, shown by Frame::layers.
  void setGuides(const Guides& guides);
  /// Grey values and canal for the CT slices, as scanned; its voxels are borrowed. Throws GpuError if they do not fit
  /// the volume.
  void setScan(CtScan scan);
  /// Over every image that render() composes from now on, in this order; not over readEye(). Cheap when most panels
  /// keep their serial.
  void setOverlay(std::vector<OverlayPanel> panels);
  /// New content of an 8x8x8 brick, i fastest.
  void updateBrick(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> solid);
  /// The tissue of a filling in such a brick (assets::Tissue); 0 where the scanned one shows.
  void updateTissue(glm::ivec3 brick, std::span<const std::uint8_t, Occupancy::kBrickValues> tissue);

  /// Between the bur of `frame` and the bone with all bricks given until now, moved pieces included; for Frame::gap.
  std::optional<BoneGap> gap(const Frame& frame);

  /// Draws the eyes that frame.display needs (mono: the cyclopean eye) and composes them, each output
  /// outputSize(frame.display, frame.rig.screen.px) large.
  void render(const Frame& frame);
  /// Composes the eyes that render() drew last once more, with the overlay of now: costs no drawing.
  void composeAgain();
  /// Draws one eye at the full screen size, for readEye and readDistance.
  void renderEye(const Frame& frame, Eye eye);

  /// A CT slice through the bur of `frame` and the current bone; after setScan().
  Image slice(SlicePlane plane, const Frame& frame, int edge_px) const;

  /// The slice under a point of the viewer's screen, as shares of its width and height from the top left.
  std::optional<SlicePlane> sliceAt(const Frame& frame, const glm::dvec2& share) const;

  /// Composes one eye of the last rendered frame for showBystander, without drawing the scene again.
  void composeForBystander();

  /// Scales an output into the current window, of the renderer's context or of one that shares with it.
  void showOnWindow(const WindowTarget& target, int output = 0);
  void showBystander(const WindowTarget& target);
  Image readImage(int output = 0);
  /// The eye as last drawn; requires that it was drawn.
  Image readEye(Eye eye);
  /// An output, or an eye, without waiting for the GPU, no larger than `most_px` where that is not the processor: none
  /// where it is on its way, which a first call sets out; the picture is of that call.
  std::optional<Image> readLate(glm::ivec2 most_px, std::optional<Eye> eye = {});
  DistanceImage readDistance(Eye eye);

  /// Throws GpuError if OpenGL reported an error since the last call.
  void throwIfError();

 private:
  struct RenderedEye {
    Frame frame;
    glm::ivec2 px{0};  ///< 0: not drawn yet
  };
  /// The overlay as an output last showed it.
  struct ShownOverlay {
    StereoLayout layout;
    ScreenOrientation orientation;
    std::vector<std::uint64_t> serials;  ///< of the panels
    std::vector<OverlayPatch> patches;
  };
  RenderedEye& drawn(Eye eye) { return eyes_[static_cast<std::size_t>(eye)]; }
  void updateInsets(const Frame& frame, glm::ivec2 eye_px);
  Image magnifiedPicture(const Frame& frame, int edge_px);
  void updateOverlay(const StereoLayout& layout, const ScreenOrientation& orientation, int output);
  void updateRuler(const Frame& frame);
  void updateBeads(const Frame& frame);
  void updateObstacles(const Frame& frame);
  void updateFlap(const Frame& frame);
  void updatePaint(const Frame& frame);
  std::vector<PlacedFields> placedPieces(const Frame& frame) const;
  void prepare(const Frame& frame);
  void drawEye(const Frame& frame, Eye eye, glm::ivec2 px);
  void compose(const Frame& frame);

  /// A piece of tooth with its part of the gap.
  struct Piece {
    Piece(const assets::VolumeGrid& grid_Q, std::span<const std::uint8_t> solid)
        : mesh(grid_Q, solid), gap(grid_Q, mesh.fields().solid()) {}
    PieceMesh mesh;
    GapFinder gap;
  };

  VolumeFields fields_;
  GapFinder gap_;
  std::array<std::unique_ptr<Piece>, kMostPieces> pieces_;
  std::unique_ptr<WindowUpload> upload_;  ///< for the CPU back-end
  std::unique_ptr<SceneRenderer> scene_;
  std::optional<CtSlices> slices_;
  std::optional<GuideField> guides_;
  bool has_canal_ = false;
  std::optional<RulerLine> ruler_;   ///< whose meshes the back-end has
  std::optional<GuideArrow> arrow_;  ///< alike
  std::vector<Bead> beads_;          ///< alike
  Obstacles obstacles_;              ///< alike
  std::uint64_t flap_serial_ = 0, gum_serial_ = 0, paint_serial_ = 0;
  std::vector<OverlayPanel> overlay_;
  std::array<ShownOverlay, 3> shown_overlays_;  ///< of both outputs and the bystanders' view
  std::uint64_t patch_serial_ = 0;
  std::array<RenderedEye, kEyes> eyes_;
  Eye composed_from_ = Eye::cyclopean;
};

/// OpenGL clip space from frame P, to project points of the patient into the image.
glm::dmat4 clipFromPatient(const calibration::Rig& rig, const EyeView& view);

}  // namespace render
