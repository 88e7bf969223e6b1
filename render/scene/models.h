// The meshes of a scene: how each is shaded, and its pose and opacity in a frame. Shared by all back-ends.
// Frame P, mm. Any thread; pure.
#pragma once

#include <array>
#include <string_view>

#include "assets/mesh.h"
#include "render/frame.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

/// `mandibular_canal`, `ruler`, `arrow`: where they are visible; their overlays: seen through bone and gingiva.
/// `ghost`: the instrument at the hand, seen through them too, as `obstacles` are.
enum class Model {
  face,
  gingiva,
  instrument,
  second_instrument,
  mandibular_canal,
  mandibular_canal_overlay,
  ghost,
  ruler,
  ruler_overlay,
  arrow,
  arrow_overlay,
  beads,
  obstacles,
  flap,
  fragments,
  first_piece
};
inline constexpr std::size_t kModels = static_cast<std::size_t>(Model::first_piece) + kMostPieces;

/// Of a moved piece of tooth.
constexpr Model pieceModel(std::size_t piece) {
  return static_cast<Model>(static_cast<std::size_t>(Model::first_piece) + piece);
}

/// How the surface of a mesh is shaded. The values are those of the shaders.
enum class Finish {
  skin = FINISH_SKIN,
  gingiva = FINISH_GINGIVA,
  instrument = FINISH_INSTRUMENT,
  guide = FINISH_GUIDE,
  tooth = FINISH_TOOTH,
  piece = FINISH_PIECE,
  obstacle = FINISH_OBSTACLE,
  glass = FINISH_GLASS
};

constexpr Finish finishOf(Model model) {
  constexpr std::array kFinish{Finish::skin,     Finish::gingiva, Finish::instrument, Finish::instrument,
                               Finish::guide,    Finish::guide,   Finish::instrument, Finish::guide,
                               Finish::guide,    Finish::guide,   Finish::guide,      Finish::tooth,
                               Finish::obstacle, Finish::gingiva, Finish::instrument};
  if (model >= Model::first_piece) return Finish::piece;
  return kFinish[static_cast<std::size_t>(model)];
}

/// Parts of Model::beads.
inline constexpr char kMarksPart[] = "Marks", kChipsPart[] = "Chips", kFolliclePart[] = "Follicle",
                      kStitchesPart[] = "Stitches", kDrawnPart[] = "Drawn plan";

/// Of Model::second_instrument: what reflects (Frame::second_glass).
inline constexpr char kGlassPart[] = "Glass";

/// Teeth of the face are shaded as the enamel of the volume; beads (bead_mesh.h) each as what they are.
inline Finish finishOf(Model model, std::string_view part) {
  if (model == Model::beads)
    return part == kMarksPart || part == kDrawnPart ? Finish::guide
           : part == kFolliclePart                  ? Finish::skin
                                                    : Finish::tooth;
  if (model == Model::second_instrument && part == kGlassPart) return Finish::glass;
  return model == Model::face && part.ends_with("Teeth") ? Finish::tooth : finishOf(model);
}

/// By the face window: the face without its metal, a retractor.
inline bool isCutByWindow(Model model, const assets::MeshPart& part) {
  return model == Model::face && part.material.metallic < 0.5f;
}

/// Of a faded face only the surface nearest to the eye is drawn; parts that are transparent anyway stay layers.
inline bool isVeilWhenFaded(Model model, const assets::Material& material) {
  return model == Model::face && material.base_colour.a >= 1.0f;
}

struct Placement {
  glm::dmat4 P_from_mesh{1.0};
  double bur_angle_rad = 0.0;  ///< of the part "Bur", about the mesh's z axis
  float opacity = 1.0f;        ///< of the whole model, multiplied with that of its parts; 0: hidden
};

struct Placements : std::array<Placement, kModels> {
  using std::array<Placement, kModels>::operator[];
  const Placement& operator[](Model model) const { return (*this)[static_cast<std::size_t>(model)]; }
};

Placements placementsIn(const Frame& frame);

}  // namespace render
