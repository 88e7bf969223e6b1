// Triangles as a binary STL file, what printers and planning programs read: every part in one body, mm, frame P (LPS).
// The header of 80 bytes says so in the words 3D Slicer looks for, "SPACE=LPS", and nothing else: no name, no date, no
// identifier. Facet normals by the triangles' own winding; zero for a triangle without area. Any thread; 50 bytes a
// triangle. STL knows no tissues, colours or shared vertices: glTF does (gltf_file).
#pragma once

#include "assets/mesh.h"
#include "calibration/output_file.h"

namespace assets {

/// Writes and commits. Throws LoadError: nothing to write, more triangles than STL can count, no space.
void writeStl(const MeshModel& model_P, calibration::OutputFile& file);

}  // namespace assets
