// The teeth of a jaw that a row of a few (app/case/prepared_tooth) has no room for, as meshes of the face around it:
// else the gum shows the socket of the first of them. Seen, never met or cut. Frame P, mm. Start-up only; some tenths
// of a second.
#pragma once

#include <functional>

#include "assets/ct_volume.h"
#include "assets/mesh.h"

namespace app {

/// A part of teeth (render/scene/models), of every numbered tooth that `is_left_out`; none: without triangles.
assets::MeshPart leftOutTeeth(const assets::CtVolume& ct, const std::function<bool(int fdi)>& is_left_out);

}  // namespace app
