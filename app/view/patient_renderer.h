// A renderer with bone, face, gingiva, guides and instrument of a patient. Render thread, with the renderer's context
// current. Cost: some tenths of a second for the fields of the bone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "haptics/servo/file_work.h"
#include "haptics/tool/tool.h"
#include "render/frame_renderer.h"
#include "render/volume/guide_field.h"

namespace app {

/// Mandibular canal and, if there is one, the planned cut.
render::Guides guidesFor(const assets::Patient& patient, const std::optional<assets::PlannedCut>& cut);

/// `solid`: the current bone, in the order of the patient's grid.
std::unique_ptr<render::FrameRenderer> patientRenderer(const assets::Patient& patient, const haptics::Tool& tool,
                                                       const std::optional<assets::PlannedCut>& cut,
                                                       std::span<const std::uint8_t> solid,
                                                       const render::RenderOptions& options);

/// The drawn instrument has the shape of the tool that is felt and cuts.
void showInstrument(render::FrameRenderer& renderer, const haptics::Tool& tool);

/// A root-canal file as it lies bent in a tick, tinted by its torque; for a tool that is a file, drawn at `X_PT`.
void showFile(render::FrameRenderer& renderer, const haptics::CanalFile& file, const haptics::FileWork& work,
              const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT);

/// What broken files have left in the tooth.
void showFragments(render::FrameRenderer& renderer, std::span<const assets::MetalFragment> fragments);

/// Instead of a bur: forceps, open by `opening_mm` between the tips; for a tool whose beaks grip.
void showForceps(render::FrameRenderer& renderer, double opening_mm);

}  // namespace app
