#include "assets/cheek_window.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace assets {
namespace {

// Positive outside the window: a cone that widens toward the eye, closed by a ball around the molar.
double outside_mm(const OperatingSite& site, const CheekWindow& window, const glm::dvec3& p_P) {
  const glm::dvec3 axis = glm::normalize(window.to_eye_P);
  const glm::dvec3 q = p_P - site.third_molar_P_mm;
  const double along = std::max(0.0, glm::dot(q, axis));
  return glm::length(q - along * axis) - (window.radius_mm + window.widening * along);
}

// Copies what is outside, and cuts the triangles that cross.
class Cut {
 public:
  Cut(const MeshPart& from, std::vector<double> outside) : from_(from), outside_(std::move(outside)) {
    to_.name = from.name;
    to_.material = from.material;
    copied_.assign(from.position_mm.size(), kNone);
  }

  MeshPart run() {
    for (std::size_t t = 0; t + 2 < from_.triangles.size(); t += 3) triangle(&from_.triangles[t]);
    return std::move(to_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  // Walks round the triangle, keeping corners outside and adding one where an edge crosses.
  void triangle(const std::uint32_t* corner) {
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corner[i];
      const std::uint32_t b = corner[(i + 1) % 3];
      if (outside_[a] >= 0.0) kept.push_back(copied(a));
      if ((outside_[a] >= 0.0) != (outside_[b] >= 0.0)) kept.push_back(crossing(std::min(a, b), std::max(a, b)));
    }
    for (std::size_t i = 1; i + 1 < kept.size(); ++i) {
      to_.triangles.insert(to_.triangles.end(), {kept[0], kept[i], kept[i + 1]});
    }
  }

  std::uint32_t copied(std::uint32_t vertex) {
    if (copied_[vertex] == kNone) copied_[vertex] = add(vertex, vertex, 0.0f);
    return copied_[vertex];
  }

  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    const auto [place, fresh] = crossings_.try_emplace({a, b}, kNone);
    if (fresh) place->second = add(a, b, static_cast<float>(outside_[a] / (outside_[a] - outside_[b])));
    return place->second;
  }

  std::uint32_t add(std::uint32_t a, std::uint32_t b, float t) {
    to_.position_mm.push_back(glm::mix(from_.position_mm[a], from_.position_mm[b], t));
    const glm::vec3 normal = glm::mix(from_.normal[a], from_.normal[b], t);
    to_.normal.push_back(glm::length(normal) > 1e-6f ? glm::normalize(normal) : from_.normal[a]);
    if (!from_.colour.empty()) to_.colour.push_back(glm::mix(from_.colour[a], from_.colour[b], t));
    return static_cast<std::uint32_t>(to_.position_mm.size()) - 1;
  }

  const MeshPart& from_;
  std::vector<double> outside_;
  MeshPart to_;
  std::vector<std::uint32_t> copied_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

}  // namespace

MeshModel withCheekWindow(const MeshModel& face_P, const OperatingSite& site, const CheekWindow& window) {
  if (!site.known) return face_P;
  MeshModel out;
  for (const MeshPart& part : face_P.parts) {
    std::vector<double> outside;
    outside.reserve(part.position_mm.size());
    for (const glm::vec3& p : part.position_mm) outside.push_back(outside_mm(site, window, glm::dvec3(p)));
    MeshPart cut = Cut(part, std::move(outside)).run();
    if (!cut.triangles.empty()) out.parts.push_back(std::move(cut));
  }
  return out;
}

}  // namespace assets
