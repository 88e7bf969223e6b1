// Appearance of each tissue in linear light. Values chosen by eye on CT surfaces under the operating lamp. Plain data;
// any thread. The reflectance of a finish is in shaders/light_constants.glsl.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "assets/tissue.h"
#include "assets/tooth.h"

namespace render {

struct TissueAppearance {
  glm::vec3 albedo;     ///< linear sRGB
  float finish;         ///< 0 open marrow, 0.5 dull bone and dentine, 1 enamel
  float colour_weight;  ///< of a voxel for the colour of a hard surface next to it; small for soft tissue
};

inline constexpr float kMarrow = 0.0f, kDull = 0.5f, kEnamel = 1.0f;

inline constexpr std::array<TissueAppearance, assets::kTissueCount> kTissueAppearance = {{
    {{0.72f, 0.615f, 0.46f}, kDull, 0.02f},  // unlabelled: shown as bone
    {{0.74f, 0.63f, 0.47f}, kDull, 1.0f},    // cortical
    {{0.58f, 0.30f, 0.21f}, kMarrow, 1.0f},  // trabecular, visible only when cut: marrow and blood
    {assets::kEnamelAlbedo, kEnamel, 1.0f},  // other teeth
    {assets::kEnamelAlbedo, kEnamel, 1.0f},  // enamel
    {{0.78f, 0.64f, 0.38f}, kDull, 1.0f},    // dentine
    {{0.45f, 0.06f, 0.06f}, 0.35f, 0.5f},    // pulp
    {{0.90f, 0.80f, 0.30f}, 0.65f, 0.5f},    // canal
    {{0.66f, 0.36f, 0.30f}, 0.6f, 0.05f},    // ligament
    {{0.60f, 0.22f, 0.22f}, 0.7f, 0.02f},    // gingiva
    {{0.26f, 0.12f, 0.04f}, kDull, 1.0f},    // soft caries: dark brown
    {{0.55f, 0.34f, 0.13f}, kDull, 1.0f},    // firm caries: amber
    {{0.93f, 0.76f, 0.44f}, 0.95f, 1.0f},    // uncured composite: yellow and wet
    {{0.92f, 0.88f, 0.78f}, 0.85f, 1.0f},    // composite
    {{0.62f, 0.74f, 0.86f}, 0.8f, 1.0f},     // uncured glass ionomer: bluish
    {{0.90f, 0.90f, 0.88f}, kDull, 1.0f},    // glass ionomer: chalky
    {{0.40f, 0.42f, 0.45f}, 0.9f, 1.0f},     // amalgam
    {{0.20f, 0.45f, 0.30f}, 0.8f, 1.0f},     // wax: green, as inlay wax
    {{0.85f, 0.36f, 0.30f}, kDull, 1.0f},    // gutta-percha
    {{0.47f, 0.49f, 0.53f}, 0.95f, 1.0f},    // amalgam that has not set: brighter
}};

}  // namespace render
