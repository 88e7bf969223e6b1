// The bytes of a glTF file: GLB container, external buffers (only from the file's own folder) and data URIs.
// Everything is bounded in size before it is read. Any thread. Not the JSON (gltf_document.h).
// Container layout: Khronos glTF 2.0 specification, section 4.4.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace assets {

inline constexpr std::size_t kMaxGltfBytes = std::size_t{512} << 20;

struct GltfContainer {
  std::string json;
  std::vector<unsigned char> binary;  ///< BIN chunk of a .glb
  bool has_binary = false;
};

/// Splits a .glb, takes a .gltf whole. Throws LoadError.
GltfContainer readGltfContainer(const std::string& path);

/// The first `size` bytes behind a buffer's uri. Throws LoadError: outside the folder, missing, too short, not base64.
std::vector<unsigned char> readGltfBuffer(const std::string& gltf_path, const std::string& uri, std::size_t size);

}  // namespace assets
