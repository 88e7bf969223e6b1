// Opens a glTF file (.gltf, .glb) with tinygltf within bounds: at most 512 MiB, all from the file's own folder, bounded
// JSON depth, no image decoding, version 2, no extension that changes geometry. References and accessors are checked
// where they are followed (gltf_accessor.h, gltf_read.cpp). One pass; any thread. Internal to the glTF reader.
#pragma once

#include <string>

namespace tinygltf {
class Model;
}

namespace assets {

/// Throws LoadError (one line: what, where, what to do).
tinygltf::Model openGltfModel(const std::string& path);

}  // namespace assets
