// The meshes of a scene: how each is shaded, and for every frame where it is and how much of it is seen. The one answer
// for all back-ends. Frame P, mm. Any thread; pure.
#pragma once

#include <array>

#include "render/frame.h"
#include "render/shaders/shared_constants.glsl"

namespace render {

/// `mandibular_canal` where it lies open and, `_through`, through bone and gingiva; `ghost`: the instrument at the
/// hand, likewise.
enum class Model { face, gingiva, instrument, second_instrument, mandibular_canal, mandibular_canal_overlay, ghost };
inline constexpr std::size_t kModels = 7;

/// How the surface of a mesh is shaded. The numbers are those of the shaders.
enum class Finish {
  skin = FINISH_SKIN,
  gingiva = FINISH_GINGIVA,
  instrument = FINISH_INSTRUMENT,
  guide = FINISH_GUIDE
};

constexpr Finish finishOf(Model model) {
  constexpr std::array<Finish, kModels> kFinish{Finish::skin,  Finish::gingiva, Finish::instrument, Finish::instrument,
                                                Finish::guide, Finish::guide,   Finish::instrument};
  return kFinish[static_cast<std::size_t>(model)];
}

struct Placement {
  glm::dmat4 P_from_mesh{1.0};
  double bur_angle_rad = 0.0;  ///< of the part "Bur", about the mesh's z axis
  float opacity = 1.0f;        ///< of the whole model, besides that of its parts; 0: not seen
};

struct Placements : std::array<Placement, kModels> {
  using std::array<Placement, kModels>::operator[];
  const Placement& operator[](Model model) const { return (*this)[static_cast<std::size_t>(model)]; }
};

Placements placementsIn(const Frame& frame);

}  // namespace render
