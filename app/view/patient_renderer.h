// A renderer with all that is seen of a patient: bone, face, gum and the instrument in the hand. Render thread; needs
// the context the renderer needs. Cost: deriving the fields of the bone, some tenths of a second.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "haptics/tool/tool.h"
#include "render/frame_renderer.h"

namespace app {

/// `cut`: as it is planned, if one is. `solid`: the bone as it is now, in the order of the patient's grid.
std::unique_ptr<render::FrameRenderer> patientRenderer(const assets::Patient& patient, const haptics::Tool& tool,
                                                       const std::optional<assets::PlannedCut>& cut,
                                                       std::span<const std::uint8_t> solid,
                                                       const render::RenderOptions& options);

/// What is felt and cuts is what is drawn.
void showInstrument(render::FrameRenderer& renderer, const haptics::Tool& tool);

}  // namespace app
