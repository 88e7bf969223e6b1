#include "assets/mesh/stl_read.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "assets/load_error.h"

namespace assets {
namespace {

constexpr std::size_t kHeaderBytes = 80, kCountBytes = 4, kTriangleBytes = 50;
constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20;
constexpr double kFarthest_mm = 1e4;

[[noreturn]] void refuse(const std::string& name, const std::string& why) { throw LoadError(name + ": " + why); }

void refuseFar(const glm::dvec3& p, std::size_t triangle, const std::string& name) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(p[axis]) < kFarthest_mm))
      refuse(name, "its triangle " + std::to_string(triangle + 1) + " is not within 10 m; give millimetres");
}

std::vector<StlTriangle> binaryTriangles(std::string_view bytes, const std::string& name) {
  std::vector<StlTriangle> triangles((bytes.size() - kHeaderBytes - kCountBytes) / kTriangleBytes);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<float, 12> numbers;  // normal, three corners
    std::memcpy(numbers.data(), bytes.data() + kHeaderBytes + kCountBytes + t * kTriangleBytes, sizeof numbers);
    for (std::size_t c = 0; c < 3; ++c) {
      triangles[t][c] = {numbers[3 + 3 * c], numbers[4 + 3 * c], numbers[5 + 3 * c]};
      refuseFar(triangles[t][c], t, name);
    }
  }
  return triangles;
}

/// Words between blanks.
class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}
  std::string_view next() {
    constexpr std::string_view kBlank = " \t\r\n\f\v";
    const std::size_t from = left_.find_first_not_of(kBlank);
    if (from == std::string_view::npos) return left_ = {};
    left_.remove_prefix(from);
    const std::size_t end = std::min(left_.find_first_of(kBlank), left_.size());
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(end);
    return word;
  }

 private:
  std::string_view left_;
};

std::vector<StlTriangle> textTriangles(std::string_view text, const std::string& name) {
  std::vector<StlTriangle> triangles;
  Words words(text);
  std::size_t corners = 0;
  bool is_in_facet = false;
  const auto place = [&] { return " after " + std::to_string(triangles.size()) + " triangles"; };
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "facet") {
      if (is_in_facet) refuse(name, "a facet begins within another" + place());
      is_in_facet = true, corners = 0;
      triangles.emplace_back();
    } else if (word == "endfacet") {
      if (!is_in_facet || corners != 3) refuse(name, "a facet has not three corners" + place());
      is_in_facet = false;
    } else if (word == "vertex" && is_in_facet) {
      if (corners == 3) refuse(name, "a facet has not three corners" + place());
      glm::dvec3 p(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        std::string_view number = words.next();
        if (number.starts_with('+')) number.remove_prefix(1);
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), p[axis]);
        if (error != std::errc{} || end != number.data() + number.size())
          refuse(name, "a corner's number cannot be read" + place());
      }
      refuseFar(p, triangles.size() - 1, name);
      triangles.back()[corners++] = p;
    }
  }
  if (is_in_facet) refuse(name, "it is cut short" + place());
  return triangles;
}

}  // namespace

std::vector<StlTriangle> stlTriangles(std::string_view bytes, const std::string& name) {
  std::uint32_t count = 0;
  const bool has_count = bytes.size() >= kHeaderBytes + kCountBytes;
  if (has_count) std::memcpy(&count, bytes.data() + kHeaderBytes, kCountBytes);
  // A binary file may begin with "solid" too: its length decides.
  std::vector<StlTriangle> triangles;
  if (has_count && bytes.size() == kHeaderBytes + kCountBytes + std::size_t{count} * kTriangleBytes)
    triangles = binaryTriangles(bytes, name);
  else if (bytes.starts_with("solid"))
    triangles = textTriangles(bytes, name);
  else
    refuse(name, has_count ? "it has " + std::to_string(bytes.size()) + " bytes and says that it holds " +
                                 std::to_string(count) + " triangles: it is cut short, or no STL file"
                           : "it is no STL file");
  if (triangles.empty()) refuse(name, "it holds no triangle");
  return triangles;
}

std::vector<StlTriangle> readStl(const std::string& path) {
  std::error_code error;
  // Nothing that would block, as a pipe does.
  if (!std::filesystem::is_regular_file(path, error)) refuse(path, "there is no such file");
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) refuse(path, "it cannot be read");
  if (size > kMostBytes)
    refuse(path, "it has more than " + std::to_string(kMostBytes >> 20) + " MB: give the prepared tooth alone");
  std::string bytes(size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) refuse(path, "it cannot be read to its end");
  return stlTriangles(bytes, path);
}

}  // namespace assets
