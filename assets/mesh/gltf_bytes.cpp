#include "assets/mesh/gltf_bytes.h"

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "assets/load_error.h"

namespace assets {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kGlbMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

std::string readWhole(const fs::path& path, std::size_t limit) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw LoadError(path.string() + ": no such file, check the path");
  const auto size = fs::file_size(path, error);
  if (error || size > limit) throw LoadError(path.string() + ": larger than 512 MiB, simplify the model");
  std::ifstream in(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in || in.gcount() != static_cast<std::streamsize>(size)) {
    throw LoadError(path.string() + ": can not be read to its end, check the file");
  }
  return bytes;
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(bytes[at + i])}; };
  return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

std::string percentDecoded(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      out += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      out += uri[i];
    }
  }
  return out;
}

// Where a relative uri leads, or an error if that is outside the folder of the glTF file (also by a symbolic link).
fs::path inFolder(const std::string& gltf_path, const std::string& uri) {
  const std::string name = percentDecoded(uri);
  const bool odd = name.empty() || name.find('\0') != std::string::npos || name.find('\\') != std::string::npos ||
                   name.find("://") != std::string::npos || fs::path(name).is_absolute();
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(gltf_path).parent_path(), error);
  const fs::path target = odd || error ? fs::path() : fs::weakly_canonical(folder / name, error);
  const fs::path relative = target.empty() || error ? fs::path() : target.lexically_relative(folder);
  if (relative.empty() || *relative.begin() == ".." || relative == ".") {
    throw LoadError(gltf_path + ": a buffer lies outside the file's folder, put it beside the .gltf");
  }
  return target;
}

std::vector<unsigned char> base64Decoded(const std::string& gltf_path, std::string_view text, std::size_t size) {
  if (text.size() / 4 * 3 + 3 < size) throw LoadError(gltf_path + ": a data URI is shorter than its buffer");
  std::vector<unsigned char> out;
  out.reserve(size + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+') value = 62;
    if (c == '/') value = 63;
    if (c == '=') break;
    if (value < 0) throw LoadError(gltf_path + ": a data URI is not base64, export the file again");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held >= 8) {
      held -= 8;
      out.push_back(static_cast<unsigned char>(bits >> held & 0xFFu));
      if (out.size() == size) break;
    }
  }
  if (out.size() < size) throw LoadError(gltf_path + ": a data URI is shorter than its buffer");
  return out;
}

}  // namespace

GltfContainer readGltfContainer(const std::string& path) {
  std::string bytes = readWhole(path, kMaxGltfBytes);
  if (bytes.size() < 4 || word(bytes, 0) != kGlbMagic) return {std::move(bytes), {}, false};

  // Header, then chunks; the length in the header must be what is there.
  if (bytes.size() < 20) throw LoadError(path + ": the file is cut short, copy it again");
  if (word(bytes, 4) != 2) throw LoadError(path + ": not a version 2 .glb, export as glTF 2.0");
  const std::size_t length = word(bytes, 8);
  if (length > bytes.size() || length < 20) throw LoadError(path + ": the file is cut short, copy it again");
  GltfContainer container;
  std::size_t at = 12;
  for (int chunk = 0; at + 8 <= length; ++chunk) {
    const std::size_t size = word(bytes, at);
    const std::uint32_t type = word(bytes, at + 4);
    if (size > length - at - 8) throw LoadError(path + ": a chunk is cut short, copy the file again");
    if (chunk == 0 && type != kJsonChunk) throw LoadError(path + ": the first chunk is not JSON, export it again");
    if (chunk == 0) container.json = bytes.substr(at + 8, size);
    if (chunk == 1 && type == kBinaryChunk) {
      const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at + 8);
      container.binary.assign(first, first + static_cast<std::ptrdiff_t>(size));
      container.has_binary = true;
    }
    at += 8 + size;
  }
  return container;
}

std::vector<unsigned char> readGltfBuffer(const std::string& gltf_path, const std::string& uri, std::size_t size) {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
      throw LoadError(gltf_path + ": a data URI is not base64, export the file again");
    }
    return base64Decoded(gltf_path, std::string_view(uri).substr(comma + 1), size);
  }
  const std::string bytes = readWhole(inFolder(gltf_path, uri), kMaxGltfBytes);
  if (bytes.size() < size) throw LoadError(gltf_path + ": a buffer file is cut short, copy it again");
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace assets
