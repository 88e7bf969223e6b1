// The canals of one tooth and its pulp chamber as closed forms, whatever the tooth's own shape comes from: centre lines
// with elliptic sections from the chamber's floor to the foramen, and a chamber between roof and floor. Frame P; the
// tooth's own frame (mesial, buccal, occlusal; a left-handed one on one side of the mouth) for the chamber. mm, rad.
// Plain data, immutable; any thread. PulpDistance: some 100 ns a point, at any spacing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

struct ToothFrame {
  glm::dvec3 cervix_P_mm{0.0};
  glm::dmat3 axes_P{1.0};  ///< columns: mesial, buccal, occlusal

  glm::dvec3 local(const glm::dvec3& p_P) const { return (p_P - cervix_P_mm) * axes_P; }
  glm::dvec3 inP(const glm::dvec3& p) const { return cervix_P_mm + axes_P * p; }
};

/// A place of a centre line.
struct CanalPlace {
  glm::dvec3 p_P_mm{0.0};
  double along_mm = 0.0;                  ///< from the orifice
  double narrow_mm = 0.2, wide_mm = 0.2;  ///< radii of its section, from mesial to distal and from cheek to tongue
};

struct ToothCanal {
  std::string name;                  ///< "mesiobuccal"
  std::vector<CanalPlace> places;    ///< from the orifice to the foramen
  std::optional<std::size_t> joins;  ///< the canal whose foramen it shares
  double schneider_rad = 0.0;
  double constriction_mm = 0.0;    ///< from the orifice
  glm::dvec3 apex_P_mm{0.0};       ///< of its root, beside the foramen
  glm::dvec3 reference_P_mm{0.0};  ///< on the crown: lengths of files are read there

  double length_mm() const { return places.back().along_mm; }
  const glm::dvec3& orifice_P_mm() const { return places.front().p_P_mm; }
  const glm::dvec3& foramen_P_mm() const { return places.back().p_P_mm; }
  /// From the reference straight to the orifice, then along, to 0.5 mm short of the foramen.
  double workingLength_mm() const;
  /// The smallest width of the canal.
  double smallestWidth_mm() const;
  CanalPlace at(double along_mm) const;
};

/// Between the plane of the roof and that of the floor, around an outline; horns reach towards the cusps.
struct PulpChamber {
  struct Horn {
    glm::dvec3 from_mm, to_mm;
    double from_radius_mm, to_radius_mm;
  };
  std::vector<glm::dvec2> outline_mm;  ///< in the tooth's frame, towards mesial and cheek: a point, a line, a polygon
  double round_mm = 0.5;               ///< beyond it
  double roof_mm = 0.4, floor_mm = -1.17;
  std::vector<Horn> horns;
};

struct ToothCanals {
  int fdi = 0;
  bool is_modelled = false;  ///< by rule into a scanned tooth, whose canals its scan does not show
  ToothFrame frame;
  PulpChamber chamber;
  std::vector<ToothCanal> canals;
};

/// Between the axis of the first third and the line from where the canal leaves it to the foramen (Schneider 1971, Oral
/// Surg. 32:271); for centre lines without a closed form.
double schneider_rad(const std::vector<CanalPlace>& places);

/// The convex hull, counter-clockwise; the points themselves where they are fewer than three.
std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points);

/// Negative inside a polygon; of one point or two the distance to them or the line between.
double outlineDistance_mm(const std::vector<glm::dvec2>& outline_mm, const glm::dvec2& p_mm);

/// Signed distance to the wall of canals and chamber, negative in the pulp; first order for sections that are no
/// circle.
class PulpDistance {
 public:
  explicit PulpDistance(const ToothCanals& canals);

  double at_mm(const glm::dvec3& p_P_mm) const { return at_mm(p_P_mm, kAllParts); }

  /// A bit for the chamber and one for each canal that decide the distance within `reach_mm` of a place, for at_mm()
  /// there: a canal alone takes a third of the time.
  using Parts = unsigned;
  static constexpr Parts kAllParts = ~0u;
  Parts partsNear(const glm::dvec3& p_P_mm, double reach_mm) const;
  double at_mm(const glm::dvec3& p_P_mm, Parts parts) const;
  double chamber_mm(const glm::dvec3& p_P_mm) const { return chamberDistance_mm(frame_.local(p_P_mm)); }

 private:
  /// A piece of a centre line in the tooth's frame.
  struct Piece {
    glm::dvec3 from_mm, along, wide;
    double length_mm, narrow_mm, narrow_step, wide_mm, wide_step;
  };
  struct Line {
    std::vector<Piece> pieces;
    std::vector<std::size_t> by_height;  ///< the piece at each height below the top
    double top_mm = 0.0;
    glm::dvec3 low_mm{0.0}, high_mm{0.0};
  };
  double chamberDistance_mm(const glm::dvec3& p) const;
  static double lineDistance_mm(const Line& line, const glm::dvec3& p);

  ToothFrame frame_;
  PulpChamber chamber_;
  std::vector<Line> lines_;
};

}  // namespace assets
