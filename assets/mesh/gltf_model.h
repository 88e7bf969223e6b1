// A glTF file (.gltf, .glb) opened by tinygltf within bounds: files up to 512 MiB, all from the file's own folder, JSON
// of bounded depth, no image decoded, version 2 and no extension that changes what a mesh is. What a reference or an
// accessor leads to is judged where it is followed (gltf_accessor.h, gltf_read.cpp). One pass over the file; any
// thread. Internal to the glTF reader, which alone sees tinygltf.
#pragma once

#include <string>

namespace tinygltf {
class Model;
}

namespace assets {

/// Throws LoadError (one line: what, where, what to do).
tinygltf::Model openGltfModel(const std::string& path);

/// A file's words on one line: at most 100 characters, none of them a control character.
std::string printable(std::string text);

}  // namespace assets
