#include "assets/mesh/gltf_document.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "assets/load_error.h"
#include "assets/mesh/gltf_bytes.h"

namespace assets {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 128;
constexpr std::uint64_t kMaxInteger = 0xFFFFFFFFu;
constexpr std::uint64_t kMaxElements = 20'000'000;
constexpr std::size_t kMaxObjects = 200'000;

// Extensions that may be required: they change how the surface looks, or are read here.
bool isUnderstood(const std::string& extension) {
  return extension == "KHR_mesh_quantization" || extension == "KHR_texture_transform" ||
         extension == "KHR_texture_basisu" || extension == "EXT_texture_webp" ||
         extension.starts_with("KHR_materials_");
}

// Nesting of the raw text, so that no parser has to survive it.
int nestingDepth(const std::string& text) {
  int depth = 0;
  int deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

// Copies what meshes need from the file's JSON into a new one, checking each value on the way. Accessors, views and
// buffers are copied when first used, so that unused ones cost nothing and can do no harm.
class Reduction {
 public:
  Reduction(const std::string& path, const GltfContainer& container, json source)
      : path_(path), container_(container), source_(std::move(source)) {}

  GltfDocument run() {
    checkAsset();
    out_["asset"]["version"] = "2.0";
    copyEach("materials", [&](const json& from) { return material(from); });
    copyEach("meshes", [&](const json& from) { return mesh(from); });
    copyEach("nodes", [&](const json& from) { return node(from); });
    copyEach("scenes", [&](const json& from) {
      return json{{"nodes", from.contains("nodes") ? indices(from["nodes"], "nodes", "scene") : json::array()}};
    });
    if (source_.contains("scene")) out_["scene"] = reference(source_, "scene", "scenes", "the file");
    return {out_.dump(), std::move(buffers_)};
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw LoadError(path_ + ": " + what + ", check the file with a glTF validator");
  }

  void checkAsset() const {
    if (!source_.is_object()) refuse("the JSON is not an object");
    const auto asset = source_.find("asset");
    const bool has_version =
        asset != source_.end() && asset->is_object() && asset->contains("version") && asset->at("version").is_string();
    if (!has_version || !asset->at("version").get<std::string>().starts_with("2.")) {
      throw LoadError(path_ + ": not glTF version 2, export as glTF 2.0");
    }
    const std::string lowest = asset->contains("minVersion") && asset->at("minVersion").is_string()
                                   ? asset->at("minVersion").get<std::string>()
                                   : "2.0";
    if (lowest != "2.0") throw LoadError(path_ + ": needs a glTF version above 2.0, export as glTF 2.0");
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      if (!source_.contains(list)) continue;
      if (!source_[list].is_array()) refuse(std::string(list) + " is not a list");
      for (const json& name : source_[list]) {
        if (!name.is_string()) refuse(std::string(list) + " holds something that is not a name");
        if (list == std::string("extensionsRequired") && !isUnderstood(name.get<std::string>())) {
          throw LoadError(path_ + ": requires the extension " + name.dump().substr(0, 60) +
                          ", export without compression or custom extensions");
        }
      }
    }
  }

  // --- plain values ---

  std::optional<std::uint64_t> integer(const json& from, const char* key, const std::string& where) const {
    const auto found = from.find(key);
    if (found == from.end()) return std::nullopt;
    if (!found->is_number()) refuse(where + "." + key + " is not a number");
    const double value = found->get<double>();
    if (!(value >= 0.0 && value <= static_cast<double>(kMaxInteger)) || value != std::floor(value)) {
      refuse(where + "." + key + " is not a whole number in range");
    }
    return static_cast<std::uint64_t>(value);
  }

  std::uint64_t needed(const json& from, const char* key, const std::string& where) const {
    const auto value = integer(from, key, where);
    if (!value) refuse(where + "." + key + " is missing");
    return *value;
  }

  const json& list(const char* key) const {
    static const json kNothing = json::array();
    const auto found = source_.find(key);
    if (found == source_.end()) return kNothing;
    if (!found->is_array() || found->size() > kMaxObjects) refuse(std::string(key) + " is not a list in range");
    return *found;
  }

  std::uint64_t reference(const json& from, const char* key, const char* target, const std::string& where) const {
    const std::uint64_t index = needed(from, key, where);
    if (index >= list(target).size()) refuse(where + "." + key + " names one of the " + target + " that is not there");
    return index;
  }

  json indices(const json& from, const char* target, const std::string& where) const {
    if (!from.is_array()) refuse(where + ": a list of " + target + " is not a list");
    json out = json::array();
    for (const json& entry : from) out.push_back(reference(json{{"index", entry}}, "index", target, where));
    return out;
  }

  json numbers(const json& from, const char* key, std::size_t count, const std::string& where) const {
    const json& values = from[key];
    if (!values.is_array() || (count != 0 && values.size() != count) || values.size() > kMaxObjects) {
      refuse(where + "." + key + " has the wrong length");
    }
    json out = json::array();
    for (const json& value : values) {
      if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(where + "." + key + " is not numbers");
      out.push_back(value.get<double>());
    }
    return out;
  }

  static void copyName(const json& from, json& to) {
    if (from.contains("name") && from["name"].is_string()) to["name"] = from["name"];
  }

  template <class Copy>
  void copyEach(const char* key, Copy copy) {
    json out = json::array();
    for (const json& from : list(key)) {
      if (!from.is_object()) refuse(std::string(key) + " holds something that is not an object");
      json to = copy(from);
      copyName(from, to);
      out.push_back(std::move(to));
    }
    if (!out.empty()) out_[key] = std::move(out);
  }

  // --- the objects of glTF ---

  json material(const json& from) const {
    json to = json::object();
    if (from.contains("alphaMode") && from["alphaMode"].is_string()) to["alphaMode"] = from["alphaMode"];
    const auto pbr = from.find("pbrMetallicRoughness");
    if (pbr == from.end()) return to;
    if (!pbr->is_object()) refuse("material.pbrMetallicRoughness is not an object");
    json copy = json::object();
    if (pbr->contains("baseColorFactor")) copy["baseColorFactor"] = numbers(*pbr, "baseColorFactor", 4, "material");
    for (const char* key : {"metallicFactor", "roughnessFactor"}) {
      if (!pbr->contains(key)) continue;
      if (!pbr->at(key).is_number()) refuse(std::string("material.") + key + " is not a number");
      copy[key] = pbr->at(key);
    }
    to["pbrMetallicRoughness"] = std::move(copy);
    return to;
  }

  json mesh(const json& from) {
    if (!from.contains("primitives") || !from["primitives"].is_array()) refuse("a mesh has no primitives");
    json to = {{"primitives", json::array()}};
    for (const json& primitive : from["primitives"]) {
      if (!primitive.is_object()) refuse("a primitive is not an object");
      to["primitives"].push_back(copyPrimitive(primitive));
    }
    if (from.contains("weights")) to["weights"] = numbers(from, "weights", 0, "mesh");
    return to;
  }

  json copyPrimitive(const json& from) {
    json to = {{"mode", integer(from, "mode", "primitive").value_or(4)}};
    if (to["mode"] > 6) refuse("primitive.mode is unknown");
    if (!from.contains("attributes") || !from["attributes"].is_object()) refuse("a primitive has no attributes");
    to["attributes"] = attributes(from["attributes"], {"POSITION", "NORMAL", "COLOR_0"});
    if (from.contains("indices")) to["indices"] = accessor(reference(from, "indices", "accessors", "primitive"));
    if (from.contains("material")) to["material"] = reference(from, "material", "materials", "primitive");
    if (from.contains("targets")) {
      if (!from["targets"].is_array() || from["targets"].size() > 1000) refuse("primitive.targets is not a list");
      to["targets"] = json::array();
      for (const json& target : from["targets"]) {
        if (!target.is_object()) refuse("a morph target is not an object");
        to["targets"].push_back(attributes(target, {"POSITION", "NORMAL"}));
      }
    }
    return to;
  }

  json attributes(const json& from, std::initializer_list<const char*> wanted) {
    json to = json::object();
    for (const char* key : wanted) {
      if (from.contains(key)) to[key] = accessor(reference(from, key, "accessors", "primitive"));
    }
    return to;
  }

  json node(const json& from) const {
    json to = json::object();
    if (from.contains("mesh")) to["mesh"] = reference(from, "mesh", "meshes", "node");
    if (from.contains("skin")) to["skin"] = reference(from, "skin", "skins", "node");
    if (from.contains("children")) to["children"] = indices(from["children"], "nodes", "node");
    if (from.contains("matrix")) to["matrix"] = numbers(from, "matrix", 16, "node");
    if (from.contains("translation")) to["translation"] = numbers(from, "translation", 3, "node");
    if (from.contains("rotation")) to["rotation"] = numbers(from, "rotation", 4, "node");
    if (from.contains("scale")) to["scale"] = numbers(from, "scale", 3, "node");
    if (from.contains("weights")) to["weights"] = numbers(from, "weights", 0, "node");
    return to;
  }

  // --- accessors, views, buffers: renumbered as they come into use ---

  static std::uint64_t componentBytes(std::uint64_t type) {
    if (type == 5120 || type == 5121) return 1;
    if (type == 5122 || type == 5123) return 2;
    return type == 5125 || type == 5126 ? 4 : 0;
  }

  std::uint64_t accessor(std::uint64_t index) {
    if (const auto known = accessors_.find(index); known != accessors_.end()) return known->second;
    const json& from = list("accessors")[index];
    const std::string where = "accessor " + std::to_string(index);
    if (!from.is_object()) refuse(where + " is not an object");

    // What one element is.
    static const std::map<std::string, std::uint64_t> kComponents = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const bool has_type = from.contains("type") && from["type"].is_string();
    const auto components = kComponents.find(has_type ? from["type"].get<std::string>() : "");
    if (components == kComponents.end()) refuse(where + ".type is not a scalar or vector");
    const std::uint64_t component_type = needed(from, "componentType", where);
    const std::uint64_t element_bytes = componentBytes(component_type) * components->second;
    if (element_bytes == 0) refuse(where + ".componentType is unknown");
    const std::uint64_t count = needed(from, "count", where);
    if (count == 0 || count > kMaxElements) refuse(where + ".count is zero or above 20 million");
    json to = {{"type", components->first}, {"componentType", component_type}, {"count", count}};
    if (from.contains("normalized")) {
      if (!from["normalized"].is_boolean()) refuse(where + ".normalized is not true or false");
      to["normalized"] = from["normalized"];
    }

    // Where the elements lie; without a view they are zeros.
    const std::uint64_t offset = integer(from, "byteOffset", where).value_or(0);
    if (from.contains("bufferView")) {
      to["bufferView"] = view(reference(from, "bufferView", "bufferViews", where), offset, element_bytes, count, true);
      to["byteOffset"] = offset;
    } else {
      to["bufferView"] = zeros(element_bytes * count);
    }
    if (from.contains("sparse")) to["sparse"] = sparse(from["sparse"], where, element_bytes, count);

    const std::uint64_t renumbered = out_["accessors"].size();
    out_["accessors"].push_back(std::move(to));
    return accessors_[index] = renumbered;
  }

  json sparse(const json& from, const std::string& where, std::uint64_t element_bytes, std::uint64_t accessor_count) {
    const bool whole = from.is_object() && from.contains("indices") && from["indices"].is_object() &&
                       from.contains("values") && from["values"].is_object();
    if (!whole) refuse(where + ".sparse is not complete");
    const std::uint64_t count = needed(from, "count", where);
    if (count == 0 || count > accessor_count) refuse(where + ".sparse.count is out of range");
    const json& at = from["indices"];
    const json& values = from["values"];
    const std::uint64_t index_type = needed(at, "componentType", where);
    if (index_type != 5121 && index_type != 5123 && index_type != 5125) refuse(where + ".sparse has odd indices");
    const std::uint64_t index_offset = integer(at, "byteOffset", where).value_or(0);
    const std::uint64_t value_offset = integer(values, "byteOffset", where).value_or(0);
    if (std::max(index_offset, value_offset) > 0x7FFFFFFFu) refuse(where + ".sparse has an offset out of range");
    return {{"count", count},
            {"indices",
             {{"bufferView", view(reference(at, "bufferView", "bufferViews", where), index_offset,
                                  componentBytes(index_type), count, false)},
              {"byteOffset", index_offset},
              {"componentType", index_type}}},
            {"values",
             {{"bufferView",
               view(reference(values, "bufferView", "bufferViews", where), value_offset, element_bytes, count, false)},
              {"byteOffset", value_offset}}}};
  }

  // A view that must hold `count` elements from `offset` on.
  std::uint64_t view(std::uint64_t index, std::uint64_t offset, std::uint64_t element_bytes, std::uint64_t count,
                     bool may_stride) {
    const json& from = list("bufferViews")[index];
    const std::string where = "bufferView " + std::to_string(index);
    if (!from.is_object()) refuse(where + " is not an object");
    const std::uint64_t length = needed(from, "byteLength", where);
    const std::uint64_t start = integer(from, "byteOffset", where).value_or(0);
    const std::uint64_t given_stride = integer(from, "byteStride", where).value_or(0);
    if (from.contains("byteStride") && (given_stride < 4 || given_stride > 252 || given_stride % 4 != 0)) {
      refuse(where + ".byteStride is not a multiple of 4 in 4..252");
    }
    const std::uint64_t stride = may_stride && given_stride != 0 ? given_stride : element_bytes;
    if (stride < element_bytes) refuse(where + ".byteStride is smaller than an element");
    if (offset + stride * (count - 1) + element_bytes > length) refuse("an accessor reaches past " + where);

    if (const auto known = views_.find(index); known != views_.end()) return known->second;
    const std::uint64_t buffer_index = reference(from, "buffer", "buffers", where);
    const std::uint64_t buffer_length = needed(list("buffers")[buffer_index], "byteLength", "buffer");
    if (start + length > buffer_length) refuse(where + " reaches past its buffer");
    json to = {{"buffer", buffer(buffer_index)}, {"byteOffset", start}, {"byteLength", length}};
    if (given_stride != 0) to["byteStride"] = given_stride;
    return views_[index] = addView(std::move(to));
  }

  std::uint64_t addView(json view) {
    const std::uint64_t renumbered = out_["bufferViews"].size();
    out_["bufferViews"].push_back(std::move(view));
    return renumbered;
  }

  std::uint64_t buffer(std::uint64_t index) {
    if (const auto known = buffer_of_.find(index); known != buffer_of_.end()) return known->second;
    const json& from = list("buffers")[index];
    const std::uint64_t length = needed(from, "byteLength", "buffer");
    if (length == 0 || length > kMaxGltfBytes) refuse("a buffer is empty or above 512 MiB");
    if (from.contains("uri")) {
      if (!from["uri"].is_string()) refuse("a buffer's uri is not text");
      return buffer_of_[index] = addBuffer(readGltfBuffer(path_, from["uri"].get_ref<const std::string&>(), length));
    }
    if (index != 0 || !container_.has_binary) refuse("a buffer has neither a uri nor a BIN chunk");
    if (container_.binary.size() < length) throw LoadError(path_ + ": the BIN chunk is cut short, copy the file again");
    const auto first = container_.binary.begin();
    return buffer_of_[index] = addBuffer({first, first + static_cast<std::ptrdiff_t>(length)});
  }

  std::uint64_t addBuffer(std::vector<unsigned char> bytes) {
    total_bytes_ += bytes.size();
    if (total_bytes_ > kMaxGltfBytes) refuse("all buffers together are above 512 MiB");
    const std::size_t renumbered = buffers_.size();
    out_["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", std::to_string(renumbered)}});
    buffers_.push_back(std::move(bytes));
    return renumbered;
  }

  std::uint64_t zeros(std::uint64_t length) {
    if (total_bytes_ + length > kMaxGltfBytes) refuse("all buffers together are above 512 MiB");
    return addView({{"buffer", addBuffer(std::vector<unsigned char>(length))}, {"byteLength", length}});
  }

  const std::string& path_;
  const GltfContainer& container_;
  const json source_;
  json out_ = json::object();
  std::vector<std::vector<unsigned char>> buffers_;
  std::map<std::uint64_t, std::uint64_t> accessors_, views_, buffer_of_;
  std::uint64_t total_bytes_ = 0;
};

}  // namespace

GltfDocument openGltfDocument(const std::string& path) {
  const GltfContainer container = readGltfContainer(path);
  if (nestingDepth(container.json) > kMaxDepth) {
    throw LoadError(path + ": JSON nested deeper than 128, not a glTF a modeller writes");
  }
  json source = json::parse(container.json, nullptr, false);
  if (source.is_discarded()) throw LoadError(path + ": not glTF (the JSON can not be read), export it again");
  return Reduction(path, container, std::move(source)).run();
}

}  // namespace assets
