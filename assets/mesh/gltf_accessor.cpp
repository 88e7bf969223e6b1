#include "assets/mesh/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
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

// Storage of one number.
struct Component {
  std::size_t bytes = 0;
  double (*read)(const unsigned char* at, bool normalise) = nullptr;
};

Component componentOf(int type) {
  static const std::map<int, Component> kComponents = {
      {TINYGLTF_COMPONENT_TYPE_BYTE, {1, as<std::int8_t>}},
      {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, {1, as<std::uint8_t>}},
      {TINYGLTF_COMPONENT_TYPE_SHORT, {2, as<std::int16_t>}},
      {TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, {2, as<std::uint16_t>}},
      {TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, {4, as<std::uint32_t>}},
      {TINYGLTF_COMPONENT_TYPE_FLOAT, {4, as<float>}},
  };
  const auto found = kComponents.find(type);
  if (found == kComponents.end()) throw LoadError("an accessor's componentType is unknown");
  return found->second;
}

// The bytes of `count` elements; throws if they exceed the data.
Bytes elements(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t element_bytes,
               std::size_t stride, std::size_t count) {
  const auto fail = [] { throw LoadError("an accessor reaches past its data"); };
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size()) fail();
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) fail();
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const std::size_t needed = stride * (count - 1) + element_bytes;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset || offset > view.byteLength ||
      needed > view.byteLength - offset) {
    fail();
  }
  return {data.data() + view.byteOffset + offset, needed};
}

const tinygltf::Accessor& checked(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    throw LoadError("a primitive names a missing accessor");
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.count == 0 || accessor.count > kMaxGltfElements) {
    throw LoadError("an accessor is empty or has more than 20 million elements");
  }
  return accessor;
}

// All components of all elements, sparse overrides applied: `write(element, component, value)`.
template <class Write>
void forEachComponent(const tinygltf::Model& model, const tinygltf::Accessor& accessor, Write write) {
  const auto components =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  const Component component = componentOf(accessor.componentType);
  const std::size_t element_bytes = components * component.bytes;
  const auto read = [&](const unsigned char* element, std::size_t index) {
    for (std::size_t c = 0; c < components; ++c) {
      const double value = component.read(element + c * component.bytes, accessor.normalized);
      if (!std::isfinite(value)) throw LoadError("a vertex is not a number (NaN or infinite)");
      write(index, c, value);
    }
  };

  // Without a view the elements are zeros.
  if (accessor.bufferView < 0) {
    const std::vector<unsigned char> zeros(element_bytes);
    for (std::size_t i = 0; i < accessor.count; ++i) read(zeros.data(), i);
  } else {
    const std::size_t given = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView)).byteStride;
    const std::size_t stride = given != 0 ? given : element_bytes;
    if (stride < element_bytes) throw LoadError("a byteStride is smaller than an element");
    const Bytes base = elements(model, accessor.bufferView, accessor.byteOffset, element_bytes, stride, accessor.count);
    for (std::size_t i = 0; i < accessor.count; ++i) read(base.data() + i * stride, i);
  }

  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count) {
    throw LoadError("a sparse accessor's count is out of range");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const Component at_component = componentOf(sparse.indices.componentType);
  const Bytes at = elements(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                            at_component.bytes, at_component.bytes, count);
  const Bytes values = elements(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                element_bytes, element_bytes, count);
  for (std::size_t i = 0; i < count; ++i) {
    const double target = at_component.read(at.data() + i * at_component.bytes, false);
    if (!(target >= 0.0 && target < static_cast<double>(accessor.count))) {
      throw LoadError("a sparse accessor changes a missing element");
    }
    read(values.data() + i * element_bytes, static_cast<std::size_t>(target));
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
    throw LoadError("a triangle names a missing vertex");
  }
  return out;
}

}  // namespace assets
