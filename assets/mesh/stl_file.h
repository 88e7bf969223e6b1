// Triangles as a binary STL file, for printers and planning programs: all parts in one body, mm, frame P (LPS). The
// 80-byte header contains "SPACE=LPS", which 3D Slicer reads, and no name, date or identifier. Facet normals from the
// winding; zero for a triangle without area. Any thread; 50 bytes a triangle. STL has no tissues, colours or shared
// vertices (gltf_file).
#pragma once

#include "assets/mesh.h"
#include "calibration/output_file.h"

namespace assets {

/// Writes and commits. Throws LoadError: no triangles, more than STL can count, no space.
void writeStl(const MeshModel& model_P, calibration::OutputFile& file);

}  // namespace assets
