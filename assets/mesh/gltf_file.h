// Triangle meshes in glTF 2.0 files (.gltf, .glb), by tinygltf. Both functions use frame F (glTF axes: x to the
// patient's left, y up, z forward) in mm; the file's metres are converted here. One part per node and primitive, named
// after the node. Read: scenes, node hierarchy, strips and fans, sparse and normalised accessors, vertex colours, morph
// targets at their default weights, KHR_mesh_quantization. Missing normals are computed. Without scenes the root nodes
// are read, without nodes every mesh once. Skinned meshes are read in bind pose. Images are not decoded. Any thread;
// one pass, a few times the file's size in memory.
#pragma once

#include <string>

#include "assets/mesh.h"
#include "calibration/output_file.h"

namespace assets {

/// Throws LoadError: unreadable, invalid, no triangles, larger than 512 MiB or 20 million vertices.
MeshModel readGltf(const std::string& path);

/// Writes a binary .glb in metres: POSITION, NORMAL, COLOR_0, indices, one material and one named node per part.
/// Replaces nothing unless `overwrite`. Throws LoadError, and as OutputFile.
void writeGltf(const MeshModel& model_F, const std::string& path, bool overwrite = false);
/// The same into an open output file; commits it.
void writeGltf(const MeshModel& model_F, calibration::OutputFile& file);

}  // namespace assets
