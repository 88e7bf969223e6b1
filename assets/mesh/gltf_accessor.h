// Values of a glTF accessor: strides, component types, normalised integers and sparse overrides resolved (glTF 2.0,
// section 3.6.2). Counts and offsets are checked against the data before memory is allocated. Any thread; one pass.
// Internal to the glTF reader.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace tinygltf {
class Model;
}

namespace assets {

inline constexpr std::size_t kMaxGltfElements = 20'000'000;

/// Vectors of 3 or 4 components, the fourth 1 if missing (alpha). Throws LoadError (without the path) for anything out
/// of range or not finite.
std::vector<glm::vec4> readVectors(const tinygltf::Model& model, int accessor);

/// Vertex indices, each below `vertex_count`.
std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, std::size_t vertex_count);

}  // namespace assets
