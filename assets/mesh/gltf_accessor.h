// The numbers behind a glTF accessor: strides, component types, normalised integers and sparse overrides resolved.
// Checks every count and offset against the bytes before it takes memory. Any thread; one pass.
// Internal to the glTF reader. Conversion: glTF 2.0, section 3.6.2.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace tinygltf {
class Model;
}

namespace assets {

inline constexpr std::size_t kMaxGltfElements = 20'000'000;

/// Components a reader wants per element; missing ones are filled with 1 (alpha). Throws LoadError (text without the
/// path) on anything out of range or not finite.
std::vector<glm::vec4> readVectors(const tinygltf::Model& model, int accessor);

/// Vertex indices, each below `vertex_count`.
std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, std::size_t vertex_count);

}  // namespace assets
