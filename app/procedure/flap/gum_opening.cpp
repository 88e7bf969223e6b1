#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "app/procedure/flap/flap_mesh.h"
#include "assets/scenery/gingiva_surface.h"

namespace app {
namespace {

constexpr double kOverlap_mm = 0.3;  // of sheet and gum where they hang together
constexpr double kWall_mm = 3.0;     // down from the gum's surface, into the bone
constexpr double kAtCut_mm = 1.0;
constexpr double kOutside = 0.25;  // of a triangle's normal outwards: it is no underside

/// How far inside the sheet's outline a point is, negative outside of it.
class Outline {
 public:
  Outline(const GumChart& chart, const FlapSheet& sheet) : chart_(chart), columns_(sheet.columns()) {
    const auto place = [&](int c, int r) { return chart.placeOf(sheet.vertices()[sheet.index(c, r)].home_P_mm); };
    first_m_ = place(0, 0).m_mm, last_m_ = place(columns_ - 1, 0).m_mm;
    for (const SheetVertex& v : sheet.vertices())
      if (v.is_cut) cut_P_mm_.push_back(v.home_P_mm);
    for (int c = 0; c < columns_; ++c) {
      top_rad_.push_back(place(c, 0).angle_rad), base_rad_.push_back(place(c, sheet.rows() - 1).angle_rad);
      top_off_mm_.push_back(sheet.vertices()[sheet.index(c, 0)].is_attached ? kOverlap_mm : 0.0);
    }
  }

  /// The sheet is cut loose there.
  bool isCut(const glm::dvec3& p_P_mm) const {
    return std::ranges::any_of(cut_P_mm_, [&](const glm::dvec3& p) { return glm::distance(p, p_P_mm) < kAtCut_mm; });
  }

  double inside_mm(const glm::dvec3& p_P_mm) const {
    const ChartPlace at = chart_.placeOf(p_P_mm);
    const double column = std::clamp((at.m_mm - first_m_) / (last_m_ - first_m_), 0.0, 0.99999) * (columns_ - 1);
    const auto c = static_cast<std::size_t>(column);
    const double part = column - static_cast<double>(c), r_mm = std::max(2.0, chart_.radiusOf_mm(p_P_mm));
    const auto mixed = [&](const std::vector<double>& of) { return (1.0 - part) * of[c] + part * of[c + 1]; };
    return std::min({at.m_mm - first_m_ - kOverlap_mm, last_m_ - at.m_mm - kOverlap_mm,
                     r_mm * (at.angle_rad - mixed(top_rad_)) - mixed(top_off_mm_),
                     r_mm * (mixed(base_rad_) - at.angle_rad) - kOverlap_mm});
  }

 private:
  const GumChart& chart_;
  int columns_;
  double first_m_ = 0.0, last_m_ = 1.0;
  std::vector<double> top_rad_, base_rad_, top_off_mm_;
  std::vector<glm::dvec3> cut_P_mm_;
};

/// Copies vertices of a part once, and makes new ones on its edges.
class Clipper {
 public:
  Clipper(const assets::MeshPart& from, assets::MeshPart& to)
      : from_(from), to_(to), kept_(from.position_mm.size(), kNew) {}

  std::uint32_t keep(std::uint32_t v) {
    if (kept_[v] == kNew) kept_[v] = add(from_.position_mm[v], from_.normal[v], colourOf(v));
    return kept_[v];
  }
  std::uint32_t between(std::uint32_t a, std::uint32_t b, float part) {
    if (a > b) std::swap(a, b), part = 1.0f - part;
    const auto [found, is_new] = cut_.try_emplace({a, b}, 0u);
    if (is_new)
      found->second = add(glm::mix(from_.position_mm[a], from_.position_mm[b], part),
                          glm::normalize(glm::mix(from_.normal[a], from_.normal[b], part)),
                          glm::mix(colourOf(a), colourOf(b), part));
    return found->second;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    to_.triangles.insert(to_.triangles.end(), {a, b, c});
  }
  std::uint32_t add(const glm::vec3& p, const glm::vec3& n, const glm::vec4& colour) {
    to_.position_mm.push_back(p), to_.normal.push_back(n), to_.colour.push_back(colour);
    return static_cast<std::uint32_t>(to_.position_mm.size() - 1);
  }

 private:
  static constexpr std::uint32_t kNew = ~0u;
  glm::vec4 colourOf(std::uint32_t v) const { return from_.colour.empty() ? glm::vec4(1.0f) : from_.colour[v]; }
  const assets::MeshPart& from_;
  assets::MeshPart& to_;
  std::vector<std::uint32_t> kept_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cut_;
};

}  // namespace

assets::MeshModel gumAround(const assets::MeshModel& gum_P, const GumChart& chart, const FlapSheet& sheet) {
  const Outline outline(chart, sheet);
  assets::MeshModel around;
  for (const assets::MeshPart& part : gum_P.parts) {
    assets::MeshPart open;
    open.name = part.name, open.material = part.material;
    Clipper clipper(part, open);
    std::vector<float> inside(part.position_mm.size());
    std::ranges::transform(part.position_mm, inside.begin(),
                           [&](const glm::vec3& p) { return static_cast<float>(outline.inside_mm(glm::dvec3(p))); });
    for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
      const std::array<std::uint32_t, 3> v{part.triangles[t], part.triangles[t + 1], part.triangles[t + 2]};
      // What is left of it, in its order round, and the border it leaves.
      std::array<std::uint32_t, 4> left{};
      std::array<std::uint32_t, 2> border{};
      std::size_t count = 0, cuts = 0;
      for (std::size_t n = 0; n < 3; ++n) {
        const std::uint32_t a = v[n], b = v[(n + 1) % 3];
        if (inside[a] <= 0.0f) left[count++] = clipper.keep(a);
        if ((inside[a] <= 0.0f) == (inside[b] <= 0.0f)) continue;
        left[count] = border[cuts++] = clipper.between(a, b, inside[a] / (inside[a] - inside[b]));
        ++count;
      }
      for (std::size_t n = 1; n + 1 < count; ++n) clipper.triangle(left[0], left[n], left[n + 1]);
      if (cuts != 2 || !outline.isCut(glm::dvec3(open.position_mm[border[0]]))) continue;
      const glm::dvec3 a(open.position_mm[border[0]]), b(open.position_mm[border[1]]),
          out = chart.outward_P(chart.placeOf(a));
      if (glm::dot(glm::dvec3(open.normal[border[0]]), out) < kOutside) continue;
      // The wall of the cut.
      const glm::vec4 rim(0.52f, 0.12f, 0.10f, 1.0f), deep(assets::kWoundColour, 1.0f);
      glm::dvec3 normal = glm::cross(b - a, out);
      if (!(glm::length(normal) > 1e-9)) continue;
      normal = glm::normalize(normal);
      if (outline.inside_mm(a + 0.3 * normal) < outline.inside_mm(a - 0.3 * normal)) normal = -normal;
      const glm::vec3 n(normal), down(-kWall_mm * out);
      const std::uint32_t top_a = clipper.add(glm::vec3(a), n, rim), top_b = clipper.add(glm::vec3(b), n, rim);
      const std::uint32_t low_a = clipper.add(glm::vec3(a) + down, n, deep),
                          low_b = clipper.add(glm::vec3(b) + down, n, deep);
      // Counter-clockwise from within the wound.
      if (glm::dot(glm::cross(b - a, -out), normal) > 0.0)
        clipper.triangle(top_a, top_b, low_b), clipper.triangle(top_a, low_b, low_a);
      else
        clipper.triangle(top_a, low_b, top_b), clipper.triangle(top_a, low_a, low_b);
    }
    around.parts.push_back(std::move(open));
  }
  return around;
}

}  // namespace app
