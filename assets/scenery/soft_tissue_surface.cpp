#include "assets/scenery/soft_tissue_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace assets {
namespace {

constexpr double kLipWidth_mm = 10.0;   // from the line between skin and lining
constexpr double kCheekFrom_mm = 26.0;  // lateral of the mid-line: outside the lower arch
constexpr double kFacesTheMouth = 0.4;  // of the lining's normal, towards the mid-line

enum class Body { gingiva, head, tongue };

/// What a part is by its name; the first word found decides.
struct PartWord {
  std::string_view word;
  std::optional<Body> body;
  SoftTissue tissue;
};
constexpr std::array kPartWords = std::to_array<PartWord>({
    {"teeth", {}, SoftTissue::none},
    {"tooth", {}, SoftTissue::none},
    {"hair", {}, SoftTissue::none},
    {"lash", {}, SoftTissue::none},
    {"brow", {}, SoftTissue::none},
    {"eye", {}, SoftTissue::none},
    {"cap", {}, SoftTissue::none},
    {"drape", {}, SoftTissue::none},
    {"cloth", {}, SoftTissue::none},
    {"retractor", {}, SoftTissue::none},
    {"suture", {}, SoftTissue::none},
    {"flap", Body::gingiva, SoftTissue::flap},
    {"gum", Body::gingiva, SoftTissue::gingiva},
    {"gingiva", Body::gingiva, SoftTissue::gingiva},
    {"tongue", Body::tongue, SoftTissue::tongue},
    {"lip", Body::head, SoftTissue::lip},
    {"mouth", Body::head, SoftTissue::mucosa},
    {"mucosa", Body::head, SoftTissue::mucosa},
    {"palate", Body::head, SoftTissue::mucosa},
    {"cheek", Body::head, SoftTissue::cheek},
    {"face", Body::head, SoftTissue::cheek},
    {"head", Body::head, SoftTissue::cheek},
    {"skin", Body::head, SoftTissue::cheek},
});

const PartWord* wordIn(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::ranges::find_if(
      kPartWords, [&](const PartWord& entry) { return name.find(entry.word) != std::string::npos; });
  return found == kPartWords.end() ? nullptr : &*found;
}

struct PlaceHash {
  std::size_t operator()(const glm::vec3& p) const {
    std::size_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = (hash ^ std::bit_cast<std::uint32_t>(p[axis])) * 0x9e3779b97f4a7c15u;
    return hash;
  }
};
using Places = std::unordered_map<glm::vec3, unsigned, PlaceHash>;

/// Adds the triangles of a part near the centre; corners at a known place are that vertex.
void add(SoftTissueSurface& to, Places& places, const MeshPart& part, SoftTissue tissue, const glm::dvec3& centre,
         double reach_mm) {
  const auto near = [&](std::uint32_t v) { return glm::distance(glm::dvec3(part.position_mm[v]), centre) <= reach_mm; };
  const auto vertex_at = [&](const glm::vec3& p) {
    const auto [place, is_new] = places.try_emplace(p, static_cast<unsigned>(to.position_P_mm.size()));
    if (is_new) to.position_P_mm.emplace_back(p);
    return place->second;
  };
  for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
    const std::uint32_t a = part.triangles[t], b = part.triangles[t + 1], c = part.triangles[t + 2];
    if (!near(a) && !near(b) && !near(c)) continue;
    const glm::uvec3 corners(vertex_at(part.position_mm[a]), vertex_at(part.position_mm[b]),
                             vertex_at(part.position_mm[c]));
    if (corners.x == corners.y || corners.y == corners.z || corners.z == corners.x) continue;
    to.triangles.push_back(corners);
    to.tissue.push_back(tissue);
  }
}

/// Centres of the triangles that touch both skin and lining: the line of the lips.
std::vector<glm::dvec3> lipLine(const SoftTissueSurface& head) {
  std::vector<bool> on_skin(head.position_P_mm.size()), on_lining(head.position_P_mm.size());
  for (std::size_t t = 0; t < head.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      (head.tissue[t] == SoftTissue::mucosa ? on_lining : on_skin)[head.triangles[t][corner]] = true;
  std::vector<glm::dvec3> line;
  for (std::size_t v = 0; v < on_skin.size(); ++v)
    if (on_skin[v] && on_lining[v]) line.push_back(head.position_P_mm[v]);
  return line;
}

/// Lips around the mouth's opening, cheek at its side.
void splitHead(SoftTissueSurface& head) {
  const std::vector<glm::dvec3> line = lipLine(head);
  if (line.empty()) return;
  glm::dvec3 low = line.front(), high = line.front();
  for (const glm::dvec3& p : line) low = glm::min(low, p), high = glm::max(high, p);
  // Points of the line by cells of the lip's width.
  using Cell = std::array<int, 3>;
  const auto cell_of = [](const glm::dvec3& p) {
    const glm::ivec3 cell(glm::floor(p / kLipWidth_mm));
    return Cell{cell.x, cell.y, cell.z};
  };
  std::map<Cell, std::vector<glm::dvec3>> cells;
  for (const glm::dvec3& p : line) cells[cell_of(p)].push_back(p);
  const auto is_lip = [&](const glm::dvec3& p) {
    const Cell at = cell_of(p);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      if (found == cells.end()) continue;
      for (const glm::dvec3& q : found->second)
        if (glm::distance(p, q) <= kLipWidth_mm) return true;
    }
    return false;
  };
  double middle_x = 0.0, weight = 0.0;
  for (const glm::dvec3& p : head.position_P_mm) middle_x += p.x, weight += 1.0;
  middle_x /= std::max(weight, 1.0);
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    const glm::dvec3 &a = head.position_P_mm[head.triangles[t].x], &b = head.position_P_mm[head.triangles[t].y],
                     &c = head.position_P_mm[head.triangles[t].z];
    const glm::dvec3 centre = (a + b + c) / 3.0;
    if (is_lip(centre)) {
      head.tissue[t] = SoftTissue::lip;
    } else if (head.tissue[t] == SoftTissue::mucosa && std::abs(centre.x - middle_x) > kCheekFrom_mm) {
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      const double to_middle = centre.x > middle_x ? -normal.x : normal.x;
      if (to_middle > kFacesTheMouth * glm::length(normal)) head.tissue[t] = SoftTissue::cheek;
    }
  }
}

}  // namespace

std::vector<SoftTissueSurface> softTissueSurfaces(const MeshModel& gingiva_P, const MeshModel& face_P,
                                                  const SoftTissueRegion& region) {
  std::array<SoftTissueSurface, 3> bodies;
  std::array<Places, 3> places;
  const auto add_part = [&](const MeshPart& part, Body body, SoftTissue tissue) {
    const auto n = static_cast<std::size_t>(body);
    add(bodies[n], places[n], part, tissue, region.centre_P_mm, region.reach_mm);
  };
  for (const MeshPart& part : gingiva_P.parts) {
    const PartWord* const word = wordIn(part.name);
    add_part(part, Body::gingiva, word && word->tissue == SoftTissue::flap ? SoftTissue::flap : SoftTissue::gingiva);
  }
  for (const MeshPart& part : face_P.parts) {
    const PartWord* const word = wordIn(part.name);
    if (word && word->body && part.material.metallic < 0.5f) add_part(part, *word->body, word->tissue);
  }
  splitHead(bodies[static_cast<std::size_t>(Body::head)]);
  std::vector<SoftTissueSurface> surfaces;
  for (SoftTissueSurface& body : bodies)
    if (!body.triangles.empty()) surfaces.push_back(std::move(body));
  return surfaces;
}

}  // namespace assets
