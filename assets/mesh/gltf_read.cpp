#include <tiny_gltf.h>

#include <algorithm>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "assets/load_error.h"
#include "assets/mesh/gltf_accessor.h"
#include "assets/mesh/gltf_file.h"
#include "assets/mesh/gltf_model.h"
#include "assets/vertex_normals.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

constexpr std::size_t kMaxCorners = 120'000'000;
constexpr double kMaxCoordinate_mm = 1e6;

// --- one primitive ---

// Strips and fans become plain triangles (glTF 2.0, section 3.7.2.1); a trailing incomplete triangle is dropped.
std::vector<std::uint32_t> asTriangles(const std::vector<std::uint32_t>& corners, int mode) {
  std::vector<std::uint32_t> out;
  const std::size_t n = corners.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) out.assign(corners.begin(), corners.end() - static_cast<std::ptrdiff_t>(n % 3));
  for (std::size_t i = 0; mode == TINYGLTF_MODE_TRIANGLE_STRIP && i + 2 < n; ++i) {
    const std::size_t odd = i % 2;
    out.insert(out.end(), {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
  }
  for (std::size_t i = 1; mode == TINYGLTF_MODE_TRIANGLE_FAN && i + 1 < n; ++i) {
    out.insert(out.end(), {corners[i], corners[i + 1], corners[0]});
  }
  return out;
}

// Base values plus the weighted morph targets.
std::vector<glm::vec3> morphed(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const char* name,
                               const std::vector<double>& weights) {
  const std::vector<glm::vec4> base = readVectors(model, primitive.attributes.at(name));
  std::vector<glm::vec3> out(base.begin(), base.end());
  for (std::size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
    const auto target = primitive.targets[t].find(name);
    if (target == primitive.targets[t].end() || weights[t] == 0.0) continue;
    const std::vector<glm::vec4> offset = readVectors(model, target->second);
    if (offset.size() != out.size()) throw LoadError("a morph target does not fit its mesh");
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += static_cast<float>(weights[t]) * glm::vec3(offset[i]);
  }
  return out;
}

Material materialOf(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.materials.size()) return {};
  const tinygltf::Material& from = model.materials[static_cast<std::size_t>(index)];
  const auto& pbr = from.pbrMetallicRoughness;
  const auto unit = [](double value) {
    return std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 1.0f;
  };
  Material to;
  for (int c = 0; c < 4 && pbr.baseColorFactor.size() == 4; ++c) {
    to.base_colour[c] = unit(pbr.baseColorFactor[static_cast<std::size_t>(c)]);
  }
  if (from.alphaMode == "OPAQUE") to.base_colour.a = 1.0f;
  to.roughness = unit(pbr.roughnessFactor);
  to.metallic = unit(pbr.metallicFactor);
  return to;
}

// A mesh instance of the scene.
struct Placement {
  std::string name;
  glm::dmat4 metres_from_mesh{1.0};
  const std::vector<double>* weights = nullptr;
};

std::vector<glm::vec3> transformedPositions(const std::vector<glm::vec3>& local, const glm::dmat4& X) {
  std::vector<glm::vec3> out;
  out.reserve(local.size());
  for (const glm::vec3& p : local) {
    const glm::dvec3 p_F_mm = calibration::mmFromMetres(1.0) * glm::dvec3(X * glm::dvec4(glm::dvec3(p), 1.0));
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(p_F_mm[axis]) <= kMaxCoordinate_mm)) throw LoadError("a vertex lies more than a kilometre away");
    }
    out.emplace_back(p_F_mm);
  }
  return out;
}

MeshPart instantiated(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const Placement& placement) {
  MeshPart part;
  part.name = placement.name;
  part.material = materialOf(model, primitive.material);
  const glm::dmat4& X = placement.metres_from_mesh;
  part.position_mm = transformedPositions(morphed(model, primitive, "POSITION", *placement.weights), X);

  // A mirroring transform reverses the winding.
  std::vector<std::uint32_t> corners;
  if (primitive.indices >= 0) {
    corners = readIndices(model, primitive.indices, part.position_mm.size());
  } else {
    for (std::uint32_t i = 0; i < part.position_mm.size(); ++i) corners.push_back(i);
  }
  part.triangles = asTriangles(corners, primitive.mode);
  const glm::dmat3 linear(X);
  if (glm::determinant(linear) < 0.0) {
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3)
      std::swap(part.triangles[t + 1], part.triangles[t + 2]);
  }

  // Normals transform by the cofactors, also valid for singular transforms.
  part.normal = vertexNormals(part.position_mm, part.triangles);
  if (primitive.attributes.contains("NORMAL")) {
    const std::vector<glm::vec3> local = morphed(model, primitive, "NORMAL", *placement.weights);
    if (local.size() != part.position_mm.size()) throw LoadError("normals do not fit their mesh");
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const double side = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < local.size(); ++i) {
      const glm::dvec3 n = side * (cofactors * glm::dvec3(local[i]));
      const double length = glm::length(n);
      if (length > 1e-12) part.normal[i] = glm::vec3(n / length);
    }
  }

  if (primitive.attributes.contains("COLOR_0")) {
    part.colour = readVectors(model, primitive.attributes.at("COLOR_0"));
    if (part.colour.size() != part.position_mm.size()) throw LoadError("vertex colours do not fit their mesh");
    for (glm::vec4& colour : part.colour) colour = glm::clamp(colour, 0.0f, 1.0f);
  }
  return part;
}

// --- the scene ---

glm::dmat4 localTransform(const tinygltf::Node& node) {
  glm::dmat4 X(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) X[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return X;
  }
  if (node.rotation.size() == 4) {
    const auto& q = node.rotation;
    const glm::dquat rotation(q[3], q[0], q[1], q[2]);
    const double length = glm::length(rotation);
    if (!(length > 1e-9)) throw LoadError("a node has a rotation of length zero");
    X = glm::mat4_cast(rotation / length);
  }
  for (int axis = 0; axis < 3 && node.scale.size() == 3; ++axis) X[axis] *= node.scale[static_cast<std::size_t>(axis)];
  if (node.translation.size() == 3) X[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  return X;
}

class Scene {
 public:
  explicit Scene(const tinygltf::Model& model) : model_(model), visited_(model.nodes.size()) {}

  MeshModel collect() {
    for (const int root : roots()) visit(root);
    const bool library = model_.scenes.empty() && out_.parts.empty();
    for (std::size_t i = 0; library && i < model_.meshes.size(); ++i) {
      add(static_cast<int>(i), {model_.meshes[i].name, glm::dmat4(1.0), &model_.meshes[i].weights});
    }
    return std::move(out_);
  }

 private:
  // Of the scene; without one, nodes without a parent.
  std::vector<int> roots() const {
    if (!model_.scenes.empty())
      return model_.scenes.at(static_cast<std::size_t>(std::max(model_.defaultScene, 0))).nodes;
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) is_child.at(static_cast<std::size_t>(child)) = true;
    }
    std::vector<int> out;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) out.push_back(static_cast<int>(i));
    }
    return out;
  }

  // Depth first without recursion, so that no hierarchy is too deep.
  void visit(int root) {
    std::vector<std::pair<int, glm::dmat4>> open = {{root, glm::dmat4(1.0)}};
    while (!open.empty()) {
      const auto [index, parent_transform] = open.back();
      open.pop_back();
      const tinygltf::Node& node = model_.nodes.at(static_cast<std::size_t>(index));
      if (visited_[static_cast<std::size_t>(index)]) throw LoadError("a node has two parents or is part of a cycle");
      visited_[static_cast<std::size_t>(index)] = true;
      const glm::dmat4 X = parent_transform * localTransform(node);
      if (node.mesh >= 0) {
        const tinygltf::Mesh& mesh = model_.meshes.at(static_cast<std::size_t>(node.mesh));
        // A skinned mesh does not move with its node (glTF 2.0, section 3.7.3.3).
        add(node.mesh, {node.name.empty() ? mesh.name : node.name, node.skin >= 0 ? glm::dmat4(1.0) : X,
                        node.weights.empty() ? &mesh.weights : &node.weights});
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) open.emplace_back(*child, X);
    }
  }

  void add(int mesh_index, Placement placement) {
    const tinygltf::Mesh& mesh = model_.meshes.at(static_cast<std::size_t>(mesh_index));
    placement.name = printable(placement.name, 100, ' ');
    if (placement.name.empty()) placement.name = "Part " + std::to_string(out_.parts.size() + 1);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (primitive.mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) continue;
      // Checked before allocating: a mesh may have many instances.
      vertices_ += count(position->second);
      corners_ += 3 * count(primitive.indices >= 0 ? primitive.indices : position->second);
      if (vertices_ > kMaxGltfElements || corners_ > kMaxCorners) throw LoadError("more than 20 million vertices");
      MeshPart part = instantiated(model_, primitive, placement);
      if (!part.triangles.empty()) out_.parts.push_back(std::move(part));
    }
  }

  std::size_t count(int accessor) const { return model_.accessors.at(static_cast<std::size_t>(accessor)).count; }

  const tinygltf::Model& model_;
  std::vector<bool> visited_;  ///< node by node
  MeshModel out_;
  std::size_t vertices_ = 0;
  std::size_t corners_ = 0;
};

}  // namespace

MeshModel readGltf(const std::string& path) {
  const tinygltf::Model model = openGltfModel(path);
  try {
    MeshModel out = Scene(model).collect();
    if (out.parts.empty()) throw LoadError("holds no triangles to draw");
    return out;
  } catch (const LoadError& error) {
    throw LoadError(path + ": " + error.what() + ", check the file with a glTF validator");
  } catch (const std::out_of_range&) {
    throw LoadError(path + ": a reference is invalid, check the file with a glTF validator");
  }
}

}  // namespace assets
