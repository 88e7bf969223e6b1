#include "assets/mesh/stl_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

#include "assets/load_error.h"

namespace assets {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

// Must not begin with "solid", which would make it a text file to many readers.
constexpr std::string_view kHeader = "Molar surface. SPACE=LPS. UNIT=mm.";
constexpr std::size_t kHeaderBytes = 80, kTriangleBytes = 50;
constexpr std::size_t kTrianglesATime = 4096;

void putTriangle(char* to, const std::array<glm::vec3, 3>& corner) {
  const glm::vec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const float twice_area = glm::length(across);
  const std::array<glm::vec3, 4> numbers{twice_area > 0.0f ? across / twice_area : glm::vec3(0.0f), corner[0],
                                         corner[1], corner[2]};
  static_assert(sizeof numbers + sizeof(std::uint16_t) == kTriangleBytes);
  std::memcpy(to, numbers.data(), sizeof numbers);
  std::memset(to + sizeof numbers, 0, sizeof(std::uint16_t));  // attributes: none
}

void putPart(std::ostream& out, const MeshPart& part) {
  std::vector<char> bytes;
  for (std::size_t first = 0; first < part.triangles.size(); first += 3 * kTrianglesATime) {
    const std::size_t last = std::min(first + 3 * kTrianglesATime, part.triangles.size());
    bytes.resize((last - first) / 3 * kTriangleBytes);
    for (std::size_t t = first; t < last; t += 3)
      putTriangle(&bytes[(t - first) / 3 * kTriangleBytes],
                  {part.position_mm[part.triangles[t]], part.position_mm[part.triangles[t + 1]],
                   part.position_mm[part.triangles[t + 2]]});
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
}

}  // namespace

void writeStl(const MeshModel& model_P, calibration::OutputFile& file) {
  std::size_t triangles = 0;
  for (const MeshPart& part : model_P.parts) triangles += part.triangles.size() / 3;
  if (triangles == 0) throw LoadError(file.path() + ": a surface without triangles cannot be written as STL");
  if (triangles > std::numeric_limits<std::uint32_t>::max())
    throw LoadError(file.path() + ": STL counts no more than 4294967295 triangles, use a coarser volume");

  std::array<char, kHeaderBytes> header;
  header.fill(' ');
  kHeader.copy(header.data(), kHeader.size());
  const auto count = static_cast<std::uint32_t>(triangles);
  std::ofstream out(file.temporaryPath(), std::ios::binary);
  out.write(header.data(), header.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const MeshPart& part : model_P.parts) putPart(out, part);
  out.close();
  if (!out) throw LoadError(file.path() + ": it cannot be written, check the space on the disk");
  file.commit();
}

}  // namespace assets
