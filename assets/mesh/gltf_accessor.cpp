#include "assets/mesh/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "assets/load_error.h"

namespace assets {
namespace {

using Bytes = std::span<const unsigned char>;

template <class Integer>
double normalised(Integer value) {
  return std::max(-1.0, static_cast<double>(value) / static_cast<double>(std::numeric_limits<Integer>::max()));
}

template <class Number>
double as(const unsigned char* at, bool normalise) {
  Number value;
  std::memcpy(&value, at, sizeof value);
  if constexpr (std::is_integral_v<Number>) {
    if (normalise) return normalised(value);
  }
  return static_cast<double>(value);
}

double component(const unsigned char* at, int type, bool normalise) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return as<std::int8_t>(at, normalise);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return as<std::uint8_t>(at, normalise);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return as<std::int16_t>(at, normalise);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return as<std::uint16_t>(at, normalise);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return as<std::uint32_t>(at, normalise);
    default:
      return as<float>(at, normalise);
  }
}

// The bytes of `count` elements, or an error.
Bytes elements(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t element_bytes,
               std::size_t stride, std::size_t count) {
  const auto fail = [] { throw LoadError("an accessor reaches past its data"); };
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size() || count == 0) fail();
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) fail();
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const std::size_t needed = offset + stride * (count - 1) + element_bytes;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset || needed > view.byteLength) {
    fail();
  }
  return {data.data() + view.byteOffset + offset, needed - offset};
}

const tinygltf::Accessor& checked(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    throw LoadError("a primitive names an accessor that is not there");
  }
  return model.accessors[static_cast<std::size_t>(index)];
}

std::size_t sizeOf(int component_type) {
  return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

// All components of all elements, sparse overrides applied: `write(element, component, value)`.
template <class Write>
void forEachComponent(const tinygltf::Model& model, const tinygltf::Accessor& accessor, Write write) {
  const auto components =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  const std::size_t component_bytes = sizeOf(accessor.componentType);
  const std::size_t element_bytes = components * component_bytes;
  const auto read = [&](const unsigned char* element, std::size_t index) {
    for (std::size_t c = 0; c < components; ++c) {
      const double value = component(element + c * component_bytes, accessor.componentType, accessor.normalized);
      if (!std::isfinite(value)) throw LoadError("a vertex is not a number (NaN or infinite)");
      write(index, c, value);
    }
  };

  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const std::size_t stride = view.byteStride != 0 ? view.byteStride : element_bytes;
  const Bytes base = elements(model, accessor.bufferView, accessor.byteOffset, element_bytes, stride, accessor.count);
  for (std::size_t i = 0; i < accessor.count; ++i) read(base.data() + i * stride, i);

  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  const std::size_t index_bytes = sizeOf(sparse.indices.componentType);
  const Bytes at = elements(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                            index_bytes, index_bytes, count);
  const Bytes values = elements(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                element_bytes, element_bytes, count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto target =
        static_cast<std::size_t>(component(at.data() + i * index_bytes, sparse.indices.componentType, false));
    if (target >= accessor.count) throw LoadError("a sparse accessor changes an element that is not there");
    read(values.data() + i * element_bytes, target);
  }
}

}  // namespace

std::vector<glm::vec4> readVectors(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = checked(model, index);
  if (accessor.type != TINYGLTF_TYPE_VEC3 && accessor.type != TINYGLTF_TYPE_VEC4) {
    throw LoadError("a vertex attribute is not a vector of 3 or 4");
  }
  std::vector<glm::vec4> out(accessor.count, glm::vec4(1.0f));
  forEachComponent(model, accessor, [&](std::size_t i, std::size_t c, double value) {
    out[i][static_cast<int>(c)] = static_cast<float>(value);
  });
  return out;
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int index, std::size_t vertex_count) {
  const tinygltf::Accessor& accessor = checked(model, index);
  const bool is_index = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                        accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                        accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index || accessor.normalized) {
    throw LoadError("triangle indices are not unsigned integers");
  }
  std::vector<std::uint32_t> out(accessor.count);
  forEachComponent(model, accessor,
                   [&](std::size_t i, std::size_t, double value) { out[i] = static_cast<std::uint32_t>(value); });
  if (std::ranges::any_of(out, [&](std::uint32_t vertex) { return vertex >= vertex_count; })) {
    throw LoadError("a triangle names a vertex that is not there");
  }
  return out;
}

}  // namespace assets
