#include "assets/synthetic/mandible_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/mesh/catmull_rom.h"
#include "assets/synthetic/band_limited_noise.h"
#include "assets/synthetic/implicit_shape.h"

namespace assets {
namespace {

constexpr double kAnteriorCutAlong_mm = 17.7;
constexpr double kPosteriorCut_mm = 66.0;
constexpr double kUpperCut_mm = 9.5;
constexpr BoundingBox kBox{{3.0, 0.0, -43.0}, {50.0, 72.0, 16.0}};
constexpr double kLattice_mm = 1.0;

constexpr std::size_t kSectionPoints = 15;
using Section =
    std::array<glm::dvec2, kSectionPoints>;  ///< (buccal, z) mm, from the lingual crest over the top and round

/// Sections by y of the arch: buccal coordinates of the points, then their z.
constexpr std::size_t kStations = 9;
constexpr std::array<double, kStations> kPosterior_mm = {3.0, 16.0, 28.0, 38.0, 46.0, 52.0, 57.0, 62.0, 74.0};
// Order: lingual crest, crest, buccal crest, valley, ridge medial, ridge, ridge lateral, upper buccal, mid buccal,
// lower buccal, inferior border, lower lingual, submandibular hollow, mylohyoid ridge, upper lingual.
constexpr double kSections_mm[kStations][2][kSectionPoints] = {
    {{-3.3, 0.2, 3.4, 4.4, 4.7, 4.9, 5.0, 5.3, 6.0, 6.5, 2.6, -3.2, -5.8, -5.4, -4.4},
     {-11.0, -9.5, -10.6, -13, -15.5, -18, -20, -23, -28, -34, -38.8, -37.8, -31, -23, -15}},
    {{-3.5, 0.0, 3.7, 4.9, 5.3, 5.7, 5.9, 6.3, 6.9, 6.7, 2.7, -2.5, -4.7, -5.4, -4.6},
     {-10.9, -9.5, -10.6, -13, -15.5, -18, -20, -22.5, -27, -32.5, -37.2, -36.2, -30.5, -22, -15}},
    {{-4.9, 0.0, 5.0, 6.0, 6.6, 7.1, 7.4, 7.6, 7.5, 6.8, 2.8, -1.2, -2.8, -5.0, -5.5},
     {-10.2, -8.9, -10.0, -12.5, -14.8, -17, -19.4, -22, -26, -31, -35.9, -34.8, -29, -20.5, -14.5}},
    {{-5.2, 0.0, 5.3, 7.2, 8.6, 10.0, 10.8, 10.6, 9.6, 7.8, 4.0, 0.6, -1.4, -5.4, -6.2},
     {-9.9, -8.7, -9.9, -11.4, -12.4, -13.8, -16.4, -20, -25, -30.2, -34.4, -33.3, -26.5, -18, -13.5}},
    {{-5.2, -0.8, 4.2, 7.2, 9.6, 11.6, 13.0, 12.8, 11.4, 9.2, 5.2, 1.8, -0.6, -5.6, -6.3},
     {-9.0, -7.4, -8.2, -8.4, -7.4, -7.8, -11.0, -17, -23.5, -29.2, -32.8, -31.8, -25, -16, -12}},
    {{-4.8, -1.6, 2.4, 5.8, 8.6, 11.2, 13.2, 13.4, 12.2, 10.0, 6.2, 2.8, 0.4, -4.9, -5.8},
     {-7.2, -5.0, -4.6, -4.0, -1.7, -0.2, -4.2, -13, -22, -28.4, -31.8, -30.9, -24, -14.5, -10.5}},
    {{-3.8, -1.4, 1.6, 4.6, 7.2, 9.8, 12.0, 13.0, 12.4, 10.6, 7.2, 4.0, 1.6, -3.6, -4.8},
     {-4, -1.2, 0.8, 3.6, 7.4, 9.6, 4.2, -7, -19, -27.2, -30.7, -29.8, -23, -12.5, -8}},
    {{-1.8, 0.0, 1.6, 3.4, 5.4, 7.8, 10.0, 11.8, 11.8, 10.4, 7.8, 5.0, 3.0, -1.2, -2.6},
     {0, 6, 11, 16, 20, 22, 16, 2, -15, -26, -30.5, -29.6, -22, -11, -5}},
    {{1.0, 1.8, 2.8, 3.8, 5.0, 6.6, 8.6, 10.0, 10.4, 9.6, 7.6, 5.4, 4.0, 1.6, 0.8},
     {2, 10, 16, 21, 25, 27, 20, 4, -13, -24.5, -31.6, -30.6, -21, -11, -4}}};
constexpr int kRidgePointsPerSpan = 5;

/// Section at an arch position: Hermite through the stations, point by point.
Section sectionAt(const DentalArch& arch, double along_mm) {
  std::array<ProfileKnot, kStations> knots;
  Section section;
  for (std::size_t point = 0; point < kSectionPoints; ++point)
    for (int axis = 0; axis < 2; ++axis) {
      for (std::size_t n = 0; n < kStations; ++n)
        knots[n] = {arch.arcLengthAtPosterior(kPosterior_mm[n]), kSections_mm[n][axis][point]};
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
      contour.push_back(catmullRom(s[(n + kSectionPoints - 1) % kSectionPoints], s[n], s[(n + 1) % kSectionPoints],
                                   s[(n + 2) % kSectionPoints], t));
    }
  return contour;
}

DistanceLattice loft(const DentalArch& arch, std::uint64_t seed) {
  // Contours every half millimetre.
  constexpr double kStep_mm = 0.5;
  const double first_mm = arch.arcLengthAtPosterior(0.5), last_mm = arch.arcLengthAtPosterior(80.0);
  std::vector<Contour> contours;
  for (double along_mm = first_mm; along_mm < last_mm; along_mm += kStep_mm)
    contours.push_back(contourOf(sectionAt(arch, along_mm)));

  // Surface roughness: swellings and pits.
  const BandLimitedNoise swelling(seed, 5.0, 11.0, 24), pitting(seed + 1, 2.2, 4.0, 32);
  // The arch coordinates of each vertical line of the lattice.
  const glm::ivec2 lines = glm::ivec2(glm::ceil(glm::dvec2(kBox.high_mm - kBox.low_mm) / kLattice_mm)) + 1;
  std::vector<ArchCoordinates> of_line;
  for (int j = 0; j < lines.y; ++j)
    for (int i = 0; i < lines.x; ++i)
      of_line.push_back(arch.coordinatesOf(glm::dvec2(kBox.low_mm) + kLattice_mm * glm::dvec2(i, j)));
  DistanceLattice lattice(kBox, kLattice_mm, [&](const glm::dvec3& p) {
    const glm::ivec2 line(glm::round((glm::dvec2(p) - glm::dvec2(kBox.low_mm)) / kLattice_mm));
    const ArchCoordinates c = of_line[static_cast<std::size_t>(line.y * lines.x + line.x)];
    const double position =
        std::clamp((c.along_mm - first_mm) / kStep_mm, 0.0, static_cast<double>(contours.size()) - 1.001);
    const auto n = static_cast<std::size_t>(position);
    const glm::dvec2 q(c.buccal_mm, p.z);
    const double distance_mm = glm::mix(polygonDistance_mm(contours[n], q), polygonDistance_mm(contours[n + 1], q),
                                        position - std::floor(position));
    if (std::abs(distance_mm) > 4.0) return distance_mm;
    return distance_mm + 0.11 * swelling.at(p) + 0.07 * pitting.at(p);
  });
  lattice.redistance();
  return lattice;
}

}  // namespace

ArchStation anteriorCut(const DentalArch& arch) { return arch.stationAt(kAnteriorCutAlong_mm); }

MandibleShape::MandibleShape(const DentalArch& arch, std::uint64_t seed)
    : anterior_cut_(anteriorCut(arch)), outer_(loft(arch, seed)) {}

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

  // Thin lingual plate at the third molar's roots.
  const double third_molar = smoothStep(43.0, 48.0, p_J.y) * smoothStep(62.0, 57.0, p_J.y);
  const double lingual = (1.0 - cheek) * smoothStep(-27.0, -22.0, p_J.z);
  return glm::mix(thickness_mm, 1.05, third_molar * lingual);
}

}  // namespace assets
