#include "assets/mesh/gltf_model.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "assets/json_depth.h"
#include "assets/load_error.h"

namespace assets {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{512} << 20;

// The file's folder: no file outside it is opened, and at most the budget is read in total.
struct Folder {
  fs::path path;
  std::size_t budget_bytes = kMaxBytes;
};

// Target of a relative name; empty if outside the folder (also by a symbolic link) or not a regular file.
fs::path inFolder(const Folder& folder, const std::string& name) {
  std::error_code error;
  if (name.find('\0') != std::string::npos || fs::path(name).is_absolute()) return {};
  const fs::path target = fs::canonical(folder.path / name, error);
  if (error || !fs::is_regular_file(target, error)) return {};
  return *target.lexically_relative(folder.path).begin() == ".." ? fs::path() : target;
}

std::vector<unsigned char> wholeFile(const fs::path& path, std::size_t limit_bytes) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw LoadError(path.string() + ": no such file, check the path");
  const auto size = fs::file_size(path, error);
  if (error || size > limit_bytes) throw LoadError(path.string() + ": larger than 512 MiB, simplify the model");
  std::vector<unsigned char> bytes(size);
  std::ifstream in(path, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw LoadError(path.string() + ": cannot be read to its end, check the file");
  }
  return bytes;
}

// --- callbacks of tinygltf ---

bool isInFolder(const std::string& name, void* user) {
  return !inFolder(*static_cast<const Folder*>(user), name).empty();
}
std::string asGiven(const std::string& path, void*) { return path; }
bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }
bool skipImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

bool readInFolder(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
  Folder& folder = *static_cast<Folder*>(user);
  *out = wholeFile(inFolder(folder, name), folder.budget_bytes);
  folder.budget_bytes -= out->size();
  return true;
}

// --- checks ---

// JSON chunk of a .glb of at least 20 bytes (glTF 2.0, section 4.4). Checks the second chunk's length, which tinygltf
// lets end 8 bytes past the file.
std::string_view glbJson(const std::string& path, std::string_view bytes) {
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return std::size_t{value};
  };
  const std::size_t second = 20 + word(12);
  if (second + 8 <= bytes.size() && word(second) > bytes.size() - second - 8) {
    throw LoadError(path + ": a chunk is cut short, copy the file again");
  }
  return bytes.substr(20, word(12));
}

// Extensions that may be required: appearance only, or read here.
bool isSupported(const std::string& extension) {
  return extension == "KHR_mesh_quantization" || extension == "KHR_texture_transform" ||
         extension == "KHR_texture_basisu" || extension == "EXT_texture_webp" ||
         extension.starts_with("KHR_materials_");
}

void checkAsset(const tinygltf::Model& model, const std::string& path) {
  if (!model.asset.version.starts_with("2.")) throw LoadError(path + ": not glTF version 2, export as glTF 2.0");
  if (!model.asset.minVersion.empty() && model.asset.minVersion != "2.0") {
    throw LoadError(path + ": needs a glTF version above 2.0, export as glTF 2.0");
  }
  const auto foreign = std::ranges::find_if_not(model.extensionsRequired, isSupported);
  if (foreign != model.extensionsRequired.end()) {
    throw LoadError(path + ": requires the extension '" + printable(*foreign, 100) +
                    "', export without compression or custom extensions");
  }
}

}  // namespace

tinygltf::Model openGltfModel(const std::string& path) {
  const std::vector<unsigned char> bytes = wholeFile(path, kMaxBytes);
  const auto size = static_cast<unsigned int>(bytes.size());
  const char* text = reinterpret_cast<const char*>(bytes.data());
  const bool is_binary = size >= 20 && std::memcmp(text, "glTF", 4) == 0;
  // tinygltf reads extensions and extras recursively.
  if (isNestedTooDeep(is_binary ? glbJson(path, {text, size}) : std::string_view(text, size))) {
    throw LoadError(path + ": JSON nested deeper than 128, not a glTF a modeller writes");
  }

  tinygltf::TinyGLTF loader;
  Folder folder{fs::canonical(path).parent_path()};
  loader.SetFsCallbacks({isInFolder, asGiven, readInFolder, writeNothing, &folder});
  loader.SetImageLoader(skipImage, nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool is_read = false;
  try {
    is_read = is_binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size)
                        : loader.LoadASCIIFromString(&model, &error, &warning, text, size, "");
  } catch (const std::exception& thrown) {
    error += thrown.what();
  }
  if (is_read || !model.asset.version.empty()) checkAsset(model, path);
  if (!is_read) {
    throw LoadError(path + ": not read by tinygltf (" + printable(error, 100) +
                    "), check the file with a glTF validator");
  }
  return model;
}

}  // namespace assets
