#include "app/procedure/flap/flap_mesh.h"

#include <algorithm>
#include <cmath>

#include "assets/scenery/gingiva_surface.h"

namespace app {
namespace {

constexpr int kRimSteps = 6;                                 // round its edge
constexpr double kRimBulge = 0.55;                           // of half its thickness
constexpr double kLineWide_mm = 0.13, kLineFull_mm = 0.24;   // half the width of the incision
constexpr double kLineOver_mm = 0.05, kLineUnder_mm = 0.12;  // of its middle and its sides
constexpr double kLineAtSheet_mm = 1.0;

std::uint32_t addVertex(assets::MeshPart& part, const glm::dvec3& p, const glm::dvec3& n, const glm::vec3& colour) {
  part.position_mm.emplace_back(p), part.normal.emplace_back(n), part.colour.emplace_back(colour, 1.0f);
  return static_cast<std::uint32_t>(part.position_mm.size() - 1);
}

/// Counter-clockwise as the normals say.
void addQuad(assets::MeshPart& part, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto& p = part.position_mm;
  const glm::vec3 face = glm::cross(p[c] - p[a], p[d] - p[b]);
  if (glm::dot(face, part.normal[a] + part.normal[c]) >= 0.0f)
    part.triangles.insert(part.triangles.end(), {a, b, c, a, c, d});
  else
    part.triangles.insert(part.triangles.end(), {a, c, b, a, d, c});
}

class SheetMesh {
 public:
  explicit SheetMesh(const FlapSheet& sheet) : sheet_(sheet) {
    part_.name = "Gum flap";
    part_.material = {glm::vec4(1.0f), assets::kWetGumRoughness, 0.0f};
    smooth();
    for (int r = 0; r < sheet.rows(); ++r)
      for (int c = 0; c < sheet.columns(); ++c) normals_.push_back(normalAt(c, r));
    faces();
    rim();
  }
  assets::MeshPart take() { return std::move(part_); }

 private:
  /// As drawn: the folds of the springs are finer than those of gum.
  void smooth() {
    constexpr int kPasses = 10;
    for (const SheetVertex& v : sheet_.vertices()) at_P_mm_.push_back(v.at_P_mm);
    const int columns = sheet_.columns(), rows = sheet_.rows();
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::vector<glm::dvec3> raw = at_P_mm_;
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
          if (!at(c, r).isFree()) continue;
          glm::dvec3 sum(0.0);
          double count = 0.0;
          const auto take = [&](int nc, int nr) { sum += raw[sheet_.index(nc, nr)], count += 1.0; };
          // A border stays a border.
          const bool side = c == 0 || c + 1 == columns;
          if (r > 0 && r + 1 < rows) take(c, r - 1), take(c, r + 1);
          if (!side) take(c - 1, r), take(c + 1, r);
          if (count > 0.0) at_P_mm_[sheet_.index(c, r)] = 0.5 * (raw[sheet_.index(c, r)] + sum / count);
        }
    }
  }
  const glm::dvec3& placed(int c, int r) const { return at_P_mm_[sheet_.index(c, r)]; }
  const SheetVertex& at(int c, int r) const { return sheet_.vertices()[sheet_.index(c, r)]; }
  const glm::dvec3& normal(int c, int r) const { return normals_[sheet_.index(c, r)]; }

  glm::dvec3 normalAt(int c, int r) const {
    if (!at(c, r).isFree() && r + 1 < sheet_.rows()) return at(c, r).normal_P;
    const auto p = [&](int x, int y) {
      return placed(std::clamp(x, 0, sheet_.columns() - 1), std::clamp(y, 0, sheet_.rows() - 1));
    };
    const glm::dvec3 n = glm::cross(p(c + 1, r) - p(c - 1, r), p(c, r + 1) - p(c, r - 1));
    if (!(glm::length(n) > 1e-9)) return at(c, r).normal_P;
    return side() * glm::normalize(n);
  }
  /// Which way columns and rows turn about the gum's normal.
  double side() const {
    const int c = sheet_.columns() / 2, r = sheet_.rows() / 2;
    const glm::dvec3 n =
        glm::cross(at(c + 1, r).home_P_mm - at(c, r).home_P_mm, at(c, r + 1).home_P_mm - at(c, r).home_P_mm);
    return glm::dot(n, at(c, r).normal_P) < 0.0 ? -1.0 : 1.0;
  }
  bool isGone(int c, int r) const {
    return at(c, r).is_torn || at(c + 1, r).is_torn || at(c, r + 1).is_torn || at(c + 1, r + 1).is_torn;
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, bool turned) {
    if ((side() > 0.0) != turned)
      addQuad(part_, a, b, c, d);
    else
      addQuad(part_, d, c, b, a);
  }

  /// Outer side, and the underside where it is free.
  void faces() {
    const int columns = sheet_.columns(), rows = sheet_.rows();
    std::vector<std::uint32_t> outer, under;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const SheetVertex& v = at(c, r);
        const double edge = v.is_cut ? 0.35 : 0.0;
        outer.push_back(
            addVertex(part_, placed(c, r), normal(c, r),
                      glm::mix(assets::gumColour(v.home_P_mm), assets::kWoundColour, static_cast<float>(edge))));
        under.push_back(addVertex(part_, placed(c, r) - v.thickness_mm * normal(c, r), -normal(c, r),
                                  assets::rawGumColour(v.home_P_mm)));
      }
    for (int r = 0; r + 1 < rows; ++r)
      for (int c = 0; c + 1 < columns; ++c) {
        if (isGone(c, r)) continue;
        const std::size_t a = sheet_.index(c, r), b = sheet_.index(c + 1, r), d = sheet_.index(c, r + 1),
                          e = sheet_.index(c + 1, r + 1);
        quad(outer[a], outer[b], outer[e], outer[d], false);
        const auto& all = sheet_.vertices();
        if (all[a].isFree() || all[b].isFree() || all[d].isFree() || all[e].isFree())
          quad(under[a], under[b], under[e], under[d], true);
      }
  }

  /// Round the edge that is cut: from the outer side to the underside.
  void rim() {
    const int columns = sheet_.columns(), rows = sheet_.rows();
    std::vector<glm::ivec2> way;
    for (int r = rows - 1; r > 0; --r) way.emplace_back(0, r);
    for (int c = 0; c < columns; ++c) way.emplace_back(c, 0);
    for (int r = 1; r < rows; ++r) way.emplace_back(columns - 1, r);
    std::vector<std::uint32_t> before;
    for (std::size_t n = 0; n < way.size(); ++n) {
      const glm::ivec2 here = way[n];
      const SheetVertex& v = at(here.x, here.y);
      if (!v.is_cut || v.is_torn) {
        before.clear();
        continue;
      }
      const std::vector<std::uint32_t> now = rimAt(here);
      if (!before.empty())
        for (std::size_t k = 0; k + 1 < now.size(); ++k) addQuad(part_, before[k], now[k], now[k + 1], before[k + 1]);
      before = now;
    }
  }
  std::vector<std::uint32_t> rimAt(glm::ivec2 here) {
    const SheetVertex& v = at(here.x, here.y);
    const glm::ivec2 inwards(here.x == 0 ? 1 : here.x + 1 == sheet_.columns() ? -1 : 0, here.y == 0 ? 1 : 0);
    const glm::dvec3& n = normal(here.x, here.y);
    glm::dvec3 out = placed(here.x, here.y) - placed(here.x + inwards.x, here.y + inwards.y);
    out -= glm::dot(out, n) * n;
    out = glm::length(out) > 1e-9 ? glm::normalize(out) : glm::dvec3(0.0);
    const double half_mm = 0.5 * v.thickness_mm, bulge = v.isFree() ? kRimBulge : 0.0;
    std::vector<std::uint32_t> ring;
    for (int k = 0; k <= kRimSteps; ++k) {
      const double turn = M_PI * k / kRimSteps;
      const glm::dvec3 round = std::cos(turn) * n + std::sin(turn) * out;
      const glm::dvec3 p =
          placed(here.x, here.y) - half_mm * n + half_mm * (std::cos(turn) * n + bulge * std::sin(turn) * out);
      const float raw = static_cast<float>(std::clamp(0.35 + 1.3 * k / kRimSteps, 0.0, 1.0));
      const glm::vec3 colour = glm::mix(assets::gumColour(v.home_P_mm),
                                        0.5f * (assets::kWoundColour + assets::rawGumColour(v.home_P_mm)), raw);
      ring.push_back(addVertex(part_, p, glm::normalize(round), colour));
    }
    return ring;
  }

  const FlapSheet& sheet_;
  assets::MeshPart part_;
  std::vector<glm::dvec3> at_P_mm_, normals_;
};

/// Where the sheet is still in its place, or there is none.
bool isLineShown(const Flap& flap, const IncisionPoint& point) {
  if (!flap.sheet()) return true;
  return std::ranges::none_of(flap.sheet()->vertices(), [&](const SheetVertex& v) {
    return v.isFree() && glm::distance(v.home_P_mm, point.at_P_mm) < kLineAtSheet_mm;
  });
}

assets::MeshPart incisionLine(const Flap& flap) {
  assets::MeshPart part;
  part.name = "Incision";
  part.material = {glm::vec4(1.0f), 0.3f, 0.0f};
  const std::vector<IncisionPoint>& points = flap.incision().points();
  std::vector<std::uint32_t> before;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const IncisionPoint& point = points[n];
    const bool begins = n == 0 || points[n - 1].stroke != point.stroke;
    const bool ends = n + 1 == points.size() || points[n + 1].stroke != point.stroke;
    if (begins || !isLineShown(flap, point)) before.clear();
    if ((begins && ends) || !isLineShown(flap, point)) continue;
    const glm::dvec3 along = points[ends ? n : n + 1].at_P_mm - points[begins ? n : n - 1].at_P_mm;
    const glm::dvec3 normal = flap.chart().normal_P(point.at);
    const glm::dvec3 aside = glm::normalize(glm::cross(along, normal));
    const double wide_mm = (point.is_full ? kLineFull_mm : kLineWide_mm) * (begins || ends ? 0.3 : 1.0);
    const glm::vec3 dark(0.42f, 0.02f, 0.02f), side(0.5f, 0.09f, 0.08f);
    const std::vector<std::uint32_t> now{
        addVertex(part, point.at_P_mm - wide_mm * aside - kLineUnder_mm * normal, normal, side),
        addVertex(part, point.at_P_mm + kLineOver_mm * normal, normal, dark),
        addVertex(part, point.at_P_mm + wide_mm * aside - kLineUnder_mm * normal, normal, side)};
    if (!before.empty())
      for (std::size_t k = 0; k < 2; ++k) addQuad(part, before[k], now[k], now[k + 1], before[k + 1]);
    before = now;
  }
  return part;
}

}  // namespace

assets::MeshModel flapMesh(const Flap& flap) {
  assets::MeshModel model;
  if (flap.sheet()) model.parts.push_back(SheetMesh(*flap.sheet()).take());
  assets::MeshPart line = incisionLine(flap);
  if (!line.triangles.empty()) model.parts.push_back(std::move(line));
  return model;
}

}  // namespace app
