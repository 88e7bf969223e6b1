// Triangles of an STL file, binary or text, as they stand in it, mm. Sizes are checked before anything is read, numbers
// before they are used; what a file says beyond its triangles is not kept. Throws LoadError of one line. Any thread;
// about 100 MB/s binary, 20 MB/s text.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

using StlTriangle = std::array<glm::dvec3, 3>;

std::vector<StlTriangle> readStl(const std::string& path);

/// The same of bytes; `name` stands for them in messages.
std::vector<StlTriangle> stlTriangles(std::string_view bytes, const std::string& name);

}  // namespace assets
