#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "assets/load_error.h"
#include "assets/mesh/gltf_file.h"
#include "calibration/geometry/units.h"
#include "calibration/output_file.h"

namespace assets {
namespace {

// Appends values to the buffer as an accessor with its own view; returns the accessor's index.
template <class Value>
int append(tinygltf::Model& model, const std::vector<Value>& values, int component_type, int type, int target) {
  auto& bytes = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = values.size() * sizeof(Value);
  view.target = target;
  bytes.resize(bytes.size() + (view.byteLength + 3) / 4 * 4);
  std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = values.size();
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int appendPositions(tinygltf::Model& model, const std::vector<glm::vec3>& position_mm) {
  std::vector<glm::vec3> position_m;
  glm::vec3 low(INFINITY);
  glm::vec3 high(-INFINITY);
  for (const glm::vec3& p_mm : position_mm) {
    position_m.emplace_back(calibration::metresFromMm(1.0) * glm::dvec3(p_mm));
    low = glm::min(low, position_m.back());
    high = glm::max(high, position_m.back());
  }
  const int index =
      append(model, position_m, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  model.accessors.back().minValues = {low.x, low.y, low.z};
  model.accessors.back().maxValues = {high.x, high.y, high.z};
  return index;
}

int appendColours(tinygltf::Model& model, const std::vector<glm::vec4>& colour) {
  using Short4 = std::array<std::uint16_t, 4>;
  std::vector<Short4> rounded;
  for (const glm::vec4& c : colour) {
    const glm::vec4 scaled = glm::round(glm::clamp(c, 0.0f, 1.0f) * 65535.0f);
    rounded.push_back({static_cast<std::uint16_t>(scaled.r), static_cast<std::uint16_t>(scaled.g),
                       static_cast<std::uint16_t>(scaled.b), static_cast<std::uint16_t>(scaled.a)});
  }
  const int index =
      append(model, rounded, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
  model.accessors.back().normalized = true;
  return index;
}

void appendPart(tinygltf::Model& model, const MeshPart& part) {
  tinygltf::Material material;
  const glm::vec4& base = part.material.base_colour;
  material.name = part.name;
  material.doubleSided = true;
  if (base.a < 1.0f) material.alphaMode = "BLEND";
  material.pbrMetallicRoughness.baseColorFactor = {base.r, base.g, base.b, base.a};
  material.pbrMetallicRoughness.roughnessFactor = part.material.roughness;
  material.pbrMetallicRoughness.metallicFactor = part.material.metallic;
  model.materials.push_back(std::move(material));

  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = static_cast<int>(model.materials.size()) - 1;
  primitive.attributes["POSITION"] = appendPositions(model, part.position_mm);
  primitive.attributes["NORMAL"] =
      append(model, part.normal, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  if (!part.colour.empty()) primitive.attributes["COLOR_0"] = appendColours(model, part.colour);
  primitive.indices = append(model, part.triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                             TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);

  tinygltf::Mesh mesh;
  mesh.name = part.name;
  mesh.primitives.push_back(std::move(primitive));
  tinygltf::Node node;
  node.name = part.name;
  node.mesh = static_cast<int>(model.meshes.size());
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.meshes.push_back(std::move(mesh));
  model.nodes.push_back(std::move(node));
}

}  // namespace

void writeGltf(const MeshModel& model_F, const std::string& path, bool overwrite) {
  calibration::OutputFile file(path, overwrite);
  writeGltf(model_F, file);
}

void writeGltf(const MeshModel& model_F, calibration::OutputFile& file) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "molar";
  model.buffers.resize(1);
  model.scenes.resize(1);
  model.defaultScene = 0;
  for (const MeshPart& part : model_F.parts) {
    const bool complete = !part.position_mm.empty() && !part.triangles.empty() &&
                          part.normal.size() == part.position_mm.size() &&
                          (part.colour.empty() || part.colour.size() == part.position_mm.size());
    if (!complete)
      throw LoadError(file.path() + ": part '" + part.name + "' has an incomplete mesh, nothing was written");
    appendPart(model, part);
  }
  if (model.nodes.empty()) throw LoadError(file.path() + ": an empty model is not written as glTF, give it a mesh");

  std::ofstream out(file.temporaryPath(), std::ios::binary);
  tinygltf::TinyGLTF writer;
  const bool written = writer.WriteGltfSceneToStream(&model, out, false, true);
  out.close();
  if (!written || !out) throw LoadError(file.path() + ": cannot be written, check the space on the disk");
  file.commit();
}

}  // namespace assets
