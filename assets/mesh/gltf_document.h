// A glTF file opened and checked before any other reader sees it: container, JSON depth, sizes, references, buffers.
// What leaves here is a small closed world: JSON holding only what triangle meshes need (every reference in range,
// every accessor inside its buffer view), and the bytes of its buffers. Images, cameras, animations never get through.
// One pass over the file; any thread. Not a mesh yet (gltf_file.h). Format: Khronos glTF 2.0 specification.
#pragma once

#include <string>
#include <vector>

namespace assets {

struct GltfDocument {
  std::string json;                                 ///< buffer i has the uri "i" and exactly byteLength bytes
  std::vector<std::vector<unsigned char>> buffers;  ///< the bytes behind those uris
};

/// Throws LoadError (one line: what, where, what to do) on anything a mesh can not safely be read from.
GltfDocument openGltfDocument(const std::string& path);

}  // namespace assets
