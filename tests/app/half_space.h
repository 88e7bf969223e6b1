// A grey half-space as an NRRD on disk: solid below a plane, the transition one voxel wide. For tests of the commands.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "assets/scan/image_file.h"

namespace app {

/// Solid where n.x < offset; a cube of `edge_mm` around the origin of P.
inline void writeHalfSpace(const std::string& path, double spacing_mm, const glm::dvec3& normal, double offset_mm,
                           double edge_mm = 10.0) {
  const int n = static_cast<int>(std::lround(edge_mm / spacing_mm));
  const assets::VolumeGrid grid{glm::ivec3(n), spacing_mm, glm::dvec3(-0.5 * edge_mm + 0.5 * spacing_mm)};
  std::vector<std::uint8_t> solid(grid.voxelCount());
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double d = (glm::dot(normal, grid.centre_P_mm({i, j, k})) - offset_mm) / spacing_mm;
        solid[grid.index({i, j, k})] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(0.5 - d, 0.0, 1.0)));
      }
  calibration::OutputFile out = assets::nrrdOutput(path, true);
  assets::writeSolid(grid, solid, out);
}

/// A pose CSV from rows of t_s, x, y, z.
inline std::string poseCsv(const std::vector<glm::dvec4>& rows) {
  std::string text = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz\n";
  for (const glm::dvec4& r : rows) {
    char line[160];
    std::snprintf(line, sizeof line, "%.7f,%.9g,%.9g,%.9g,1,0,0,0\n", r.x, r.y, r.z, r.w);
    text += line;
  }
  return text;
}

}  // namespace app
