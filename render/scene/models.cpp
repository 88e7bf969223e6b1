#include "render/scene/models.h"

namespace render {
namespace {

constexpr float kMandibularCanalOverlay = 0.45f, kRulerOverlay = 0.5f,
                kObstacles = 0.6f;   // opacity where seen through bone
constexpr float kGumOfClear = 0.2f;  // what covers roots is not to hide them

// The ghost tool fades in as the hand moves 0.1 to 0.5 mm away from the tool held by the bone.
float ghostOpacity(const Frame& frame) {
  constexpr double kMost = 0.4, kFrom_mm = 0.1, kFull_mm = 0.5;
  if (!frame.tool_visible || !frame.layers.ghost_tool) return 0.0f;
  const double held_mm = glm::distance(frame.X_PT_at_hand.translation_mm, frame.X_PT.translation_mm);
  return static_cast<float>(kMost * glm::clamp((held_mm - kFrom_mm) / (kFull_mm - kFrom_mm), 0.0, 1.0));
}

}  // namespace

Placements placementsIn(const Frame& frame) {
  const Layers& layers = frame.layers;
  const auto shown = [](bool is_shown) { return is_shown ? 1.0f : 0.0f; };
  Placements placements{
      {{{.opacity = layers.face_opacity},
        {.opacity = frame.mode == ViewMode::clear ? kGumOfClear * shown(layers.gingiva) : shown(layers.gingiva)},
        {frame.X_PT.matrix(), frame.bur_angle_rad, shown(frame.tool_visible)},
        {.P_from_mesh = frame.X_PO.matrix(), .opacity = shown(frame.second_visible)},
        {.opacity = shown(layers.mandibular_canal)},
        {.opacity = layers.mandibular_canal ? kMandibularCanalOverlay : 0.0f},
        {frame.X_PT_at_hand.matrix(), frame.bur_angle_rad, ghostOpacity(frame)},
        {.opacity = shown(frame.ruler.has_value())},
        {.opacity = frame.ruler ? kRulerOverlay : 0.0f},
        {.opacity = shown(frame.arrow.has_value())},
        {.opacity = frame.arrow ? kRulerOverlay : 0.0f},
        {.opacity = shown(!frame.beads.empty())},
        {.opacity = layers.obstacles && !frame.obstacles.middle_P_mm.empty() ? kObstacles : 0.0f},
        {.opacity = shown(layers.gingiva && frame.flap != nullptr)},
        {.opacity = 1.0f}}}};
  for (std::size_t n = 0; n < kMostPieces; ++n)
    placements[static_cast<std::size_t>(pieceModel(n))] = {
        .P_from_mesh = frame.pieces[n] ? frame.pieces[n]->matrix() : glm::dmat4(1.0),
        .opacity = shown(frame.pieces[n].has_value())};
  return placements;
}

}  // namespace render
