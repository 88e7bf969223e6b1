#include "assets/synthetic/mandible_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/synthetic/band_limited_noise.h"
#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

constexpr double kAnteriorCutAlong_mm = 17.7;
constexpr double kPosteriorCut_mm = 66.0;
constexpr double kUpperCut_mm = 9.5;
constexpr LatticeBox kBox{{3.0, 0.0, -43.0}, {50.0, 72.0, 16.0}};
constexpr double kLattice_mm = 1.0;

constexpr std::size_t kSectionPoints = 15;
using Section =
    std::array<glm::dvec2, kSectionPoints>;  ///< (buccal, z) mm, from the lingual crest over the top and round

struct SectionStation {
  double posterior_mm;  ///< y of the arch there
  Section section;
};

// Order: lingual crest, crest, buccal crest, valley, ridge medial, ridge, ridge lateral, upper buccal, mid buccal,
// lower buccal, inferior border, lower lingual, submandibular hollow, mylohyoid ridge, upper lingual.
constexpr std::array<SectionStation, 9> kStations = {{
    {3.0,
     {{{-3.3, -11.0},
       {0.2, -9.5},
       {3.4, -10.6},
       {4.4, -13},
       {4.7, -15.5},
       {4.9, -18},
       {5.0, -20},
       {5.3, -23},
       {6.0, -28},
       {6.5, -34},
       {2.6, -38.8},
       {-3.2, -37.8},
       {-5.8, -31},
       {-5.4, -23},
       {-4.4, -15}}}},
    {16.0,
     {{{-3.5, -10.9},
       {0.0, -9.5},
       {3.7, -10.6},
       {4.9, -13},
       {5.3, -15.5},
       {5.7, -18},
       {5.9, -20},
       {6.3, -22.5},
       {6.9, -27},
       {6.7, -32.5},
       {2.7, -37.2},
       {-2.5, -36.2},
       {-4.7, -30.5},
       {-5.4, -22},
       {-4.6, -15}}}},
    {28.0,
     {{{-4.9, -10.2},
       {0.0, -8.9},
       {5.0, -10.0},
       {6.0, -12.5},
       {6.6, -14.8},
       {7.1, -17},
       {7.4, -19.4},
       {7.6, -22},
       {7.5, -26},
       {6.8, -31},
       {2.8, -35.9},
       {-1.2, -34.8},
       {-2.8, -29},
       {-5.0, -20.5},
       {-5.5, -14.5}}}},
    {38.0,
     {{{-5.2, -9.9},
       {0.0, -8.7},
       {5.3, -9.9},
       {7.2, -11.4},
       {8.6, -12.4},
       {10.0, -13.8},
       {10.8, -16.4},
       {10.6, -20},
       {9.6, -25},
       {7.8, -30.2},
       {4.0, -34.4},
       {0.6, -33.3},
       {-1.4, -26.5},
       {-5.4, -18},
       {-6.2, -13.5}}}},
    {46.0,
     {{{-5.2, -9.0},
       {-0.8, -7.4},
       {4.2, -8.2},
       {7.2, -8.4},
       {9.6, -7.4},
       {11.6, -7.8},
       {13.0, -11.0},
       {12.8, -17},
       {11.4, -23.5},
       {9.2, -29.2},
       {5.2, -32.8},
       {1.8, -31.8},
       {-0.6, -25},
       {-5.6, -16},
       {-6.3, -12}}}},
    {52.0,
     {{{-4.8, -7.2},
       {-1.6, -5.0},
       {2.4, -4.6},
       {5.8, -4.0},
       {8.6, -1.7},
       {11.2, -0.2},
       {13.2, -4.2},
       {13.4, -13},
       {12.2, -22},
       {10.0, -28.4},
       {6.2, -31.8},
       {2.8, -30.9},
       {0.4, -24},
       {-4.9, -14.5},
       {-5.8, -10.5}}}},
    {57.0,
     {{{-3.8, -4},
       {-1.4, -1.2},
       {1.6, 0.8},
       {4.6, 3.6},
       {7.2, 7.4},
       {9.8, 9.6},
       {12.0, 4.2},
       {13.0, -7},
       {12.4, -19},
       {10.6, -27.2},
       {7.2, -30.7},
       {4.0, -29.8},
       {1.6, -23},
       {-3.6, -12.5},
       {-4.8, -8}}}},
    {62.0,
     {{{-1.8, 0},
       {0.0, 6},
       {1.6, 11},
       {3.4, 16},
       {5.4, 20},
       {7.8, 22},
       {10.0, 16},
       {11.8, 2},
       {11.8, -15},
       {10.4, -26},
       {7.8, -30.5},
       {5.0, -29.6},
       {3.0, -22},
       {-1.2, -11},
       {-2.6, -5}}}},
    {74.0,
     {{{1.0, 2},
       {1.8, 10},
       {2.8, 16},
       {3.8, 21},
       {5.0, 25},
       {6.6, 27},
       {8.6, 20},
       {10.0, 4},
       {10.4, -13},
       {9.6, -24.5},
       {7.6, -31.6},
       {5.4, -30.6},
       {4.0, -21},
       {1.6, -11},
       {0.8, -4}}}},
}};
constexpr int kRidgePointsPerSpan = 5;

/// Section at an arch position: Hermite through the stations, point by point.
Section sectionAt(const DentalArch& arch, double along_mm) {
  std::array<ProfileKnot, kStations.size()> knots;
  Section section;
  for (std::size_t point = 0; point < kSectionPoints; ++point)
    for (int axis = 0; axis < 2; ++axis) {
      for (std::size_t n = 0; n < kStations.size(); ++n)
        knots[n] = {arch.alongAtPosterior(kStations[n].posterior_mm), kStations[n].section[point][axis]};
      section[point][axis] = profile(knots, along_mm);
    }
  return section;
}

using Contour = std::vector<glm::dvec2>;

/// Closed Catmull-Rom curve through the points of a section.
Contour contourOf(const Section& s) {
  Contour contour;
  for (std::size_t n = 0; n < kSectionPoints; ++n)
    for (int step = 0; step < kRidgePointsPerSpan; ++step) {
      const double t = static_cast<double>(step) / kRidgePointsPerSpan;
      const glm::dvec2 a = s[(n + kSectionPoints - 1) % kSectionPoints], b = s[n], c = s[(n + 1) % kSectionPoints],
                       d = s[(n + 2) % kSectionPoints];
      contour.push_back(0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                               t * t * t * (3.0 * b - a - 3.0 * c + d)));
    }
  return contour;
}

double signedDistance_mm(const Contour& contour, const glm::dvec2& p) {
  double squared = 1e30;
  bool inside = false;
  for (std::size_t n = 0; n < contour.size(); ++n) {
    const glm::dvec2 a = contour[n], b = contour[(n + 1) % contour.size()], edge = b - a;
    const glm::dvec2 offset = p - a - std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0) * edge;
    squared = std::min(squared, glm::dot(offset, offset));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * edge.x) inside = !inside;
  }
  return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

DistanceLattice loft(const DentalArch& arch, std::uint64_t seed) {
  // Contours every half millimetre, drawn once.
  constexpr double kStep_mm = 0.5;
  const double first_mm = arch.alongAtPosterior(0.5), last_mm = arch.alongAtPosterior(80.0);
  std::vector<Contour> contours;
  for (double along_mm = first_mm; along_mm < last_mm; along_mm += kStep_mm)
    contours.push_back(contourOf(sectionAt(arch, along_mm)));

  // Bone is never smooth: faint swellings and pits.
  const BandLimitedNoise swelling(seed, 5.0, 11.0, 24), pitting(seed + 1, 2.2, 4.0, 32);
  DistanceLattice lattice(kBox, kLattice_mm, [&](const glm::dvec3& p) {
    const ArchCoordinates c = arch.coordinatesOf({p.x, p.y});
    const double place =
        std::clamp((c.along_mm - first_mm) / kStep_mm, 0.0, static_cast<double>(contours.size()) - 1.001);
    const auto n = static_cast<std::size_t>(place);
    const glm::dvec2 q(c.buccal_mm, p.z);
    const double distance_mm =
        glm::mix(signedDistance_mm(contours[n], q), signedDistance_mm(contours[n + 1], q), place - std::floor(place));
    if (std::abs(distance_mm) > 4.0) return distance_mm;
    return distance_mm + 0.11 * swelling.at(p) + 0.07 * pitting.at(p);
  });
  lattice.redistance();
  return lattice;
}

}  // namespace

MandibleShape::MandibleShape(const DentalArch& arch, std::uint64_t seed)
    : anterior_cut_(arch.stationAt(kAnteriorCutAlong_mm)), outer_(loft(arch, seed)) {}

double MandibleShape::cut_mm(const glm::dvec3& p_J) const {
  const double anterior_mm = -glm::dot(glm::dvec2(p_J.x, p_J.y) - anterior_cut_.centre_mm, anterior_cut_.distal);
  return std::max({anterior_mm, p_J.y - kPosteriorCut_mm, p_J.z - kUpperCut_mm});
}

double MandibleShape::cortex_mm(const glm::dvec3& p_J, const ArchCoordinates& arch) const {
  // Inferior border 3 mm, cheek side 2.2 mm, tongue side 1.7 mm, crest 1.3 mm.
  const double below = smoothStep(-24.0, -31.0, p_J.z), above = smoothStep(-14.0, -9.5, p_J.z);
  const double cheek = smoothStep(-2.0, 5.0, arch.buccal_mm - 2.5 * smoothStep(30.0, 50.0, p_J.y));
  double thickness_mm = glm::mix(1.7, 2.3, cheek);
  thickness_mm = glm::mix(thickness_mm, 3.0, below);
  const double ramus = smoothStep(48.0, 58.0, p_J.y);
  thickness_mm = glm::mix(thickness_mm, 1.4, above * (1.0 - ramus));

  // Thin lingual plate beside the third molar's roots.
  const double third_molar = smoothStep(43.0, 48.0, p_J.y) * smoothStep(62.0, 57.0, p_J.y);
  const double lingual = (1.0 - cheek) * smoothStep(-27.0, -22.0, p_J.z);
  return glm::mix(thickness_mm, 1.05, third_molar * lingual);
}

}  // namespace assets
