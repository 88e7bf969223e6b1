// Independent reader of binary STL. Test code only.
#pragma once

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "assets/mesh.h"

namespace assets::test {

struct StlFile {
  std::string header;
  std::vector<glm::vec3> normal;
  MeshPart mesh;  ///< corners at one place are one vertex
};

inline StlFile readStl(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < 84) throw std::runtime_error(path + " is too short for an STL file");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  if (bytes.size() != 84 + std::size_t{50} * count) throw std::runtime_error(path + " has not the size it says");
  StlFile file{bytes.substr(0, 80), {}, {}};
  std::map<std::tuple<float, float, float>, std::uint32_t> known;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<glm::vec3, 4> numbers;
    std::memcpy(numbers.data(), bytes.data() + 84 + 50 * t, sizeof numbers);
    file.normal.push_back(numbers[0]);
    for (std::size_t c = 1; c < 4; ++c) {
      const glm::vec3 p = numbers[c];
      const auto [at, is_new] = known.emplace(std::tuple{p.x, p.y, p.z}, file.mesh.position_mm.size());
      if (is_new) file.mesh.position_mm.push_back(p);
      file.mesh.triangles.push_back(at->second);
    }
  }
  return file;
}

}  // namespace assets::test
