// The bone's triangles and the CT slices, measured on the built-in patient's jaw: making all, following the bur,
// drawing beside the ray caster on the same OpenGL, a slice a plane.
//   render_surface_bench [voxel mm, default 0.25]
// Process CPU time (all threads), so that other work on the machine disturbs less; the least of several.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "assets/mesh/bone_surface.h"
#include "assets/synthetic/jaw.h"
#include "render/display/camera.h"
#include "render/frame_renderer.h"
#include "render/gpu/offscreen_context.h"
#include "tests/bench/cpu_time.h"

namespace {

using bench::cpu_ms;

template <class Work>
double least_ms(int rounds, const Work& work) {
  double least = 1e9;
  for (int n = 0; n < rounds; ++n) {
    const double begun = cpu_ms();
    work();
    least = std::min(least, cpu_ms() - begun);
  }
  return least;
}

/// A block of bricks around one.
std::vector<glm::ivec3> around(glm::ivec3 brick, int reach) {
  std::vector<glm::ivec3> bricks;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) bricks.push_back(brick + glm::ivec3(i, j, k));
  return bricks;
}

}  // namespace

int main(int argc, char** argv) {
  const assets::Patient patient = assets::syntheticJaw({.spacing_mm = argc > 1 ? std::atof(argv[1]) : 0.25});
  const assets::CtVolume& ct = patient.ct;
  const assets::SolidVoxels voxels = assets::SolidVoxels::inGridOrder(ct.grid, ct.solid);
  assets::BoneSurface surface(voxels);
  std::printf("%d x %d x %d voxels, %zu triangles\n", ct.grid.size.x, ct.grid.size.y, ct.grid.size.z,
              surface.mergedMesh("").triangles.size() / 3);
  std::printf("all patches               %8.1f ms CPU\n", least_ms(5, [&] { assets::BoneSurface anew(voxels); }));

  constexpr int kTimes = 200;
  const glm::ivec3 brick(ct.grid.indexFromPoint(patient.focus_P_mm()) / double{assets::kBrickVoxels});
  for (const int reach : {0, 1}) {
    const std::vector<glm::ivec3> changed = around(brick, reach);
    std::size_t remade = 0;
    const double ms = least_ms(5, [&] {
      for (int n = 0; n < kTimes; ++n) remade = surface.update(voxels, changed).size();
    });
    std::printf("%2zu changed bricks         %8.1f us CPU, %zu patches with triangles\n", changed.size(),
                1e3 * ms / kTimes, remade);
  }

  render::OffscreenContext context;
  render::FrameRenderer renderer(ct.grid, ct.solid, ct.label);
  renderer.setScan({ct.hounsfield, ct.solid, patient.mandibular_canal_P_mm, patient.mandibular_canal_radius_mm});
  render::Frame frame;
  const glm::dvec3 look_at = patient.focus_P_mm();
  frame.rig = render::cameraRig(
      {.eye_P_mm = look_at + glm::dvec3(-150.0, -60.0, 60.0), .look_at_P_mm = look_at, .fov_y_rad = 0.35}, {640, 480});
  frame.tool_visible = false;
  frame.X_PT.translation_mm = look_at;
  for (const auto& [name, mode] : {std::pair{"rays", render::ViewMode::iso}, {"triangles", render::ViewMode::mesh}}) {
    frame.mode = mode;
    const auto draw = [&] {
      renderer.renderEye(frame, render::Eye::cyclopean);
      renderer.readEye(render::Eye::cyclopean);
    };
    draw();
    std::printf("640 x 480 as %-9s     %8.1f ms CPU\n", name, least_ms(5, draw));
  }
  for (const render::SlicePlane plane : render::kSlicePlanes)
    std::printf("slice of 160 px, plane %d  %8.3f ms CPU\n", static_cast<int>(plane), least_ms(5, [&] {
                                                                                        for (int n = 0; n < 20; ++n)
                                                                                          renderer.slice(plane, frame,
                                                                                                         160);
                                                                                      }) / 20.0);
  return 0;
}
