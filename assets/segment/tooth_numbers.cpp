#include "assets/segment/tooth_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace assets {
namespace {

constexpr double kLeastTooth_mm3 = 80.0, kLeastCrown_mm3 = 1.0;
constexpr int kPlaces = 16;
/// From the midline: mesio-distal width, volume.
constexpr std::array<double, 9> kWidth_mm = {0.0, 5.0, 5.5, 7.0, 7.0, 7.0, 11.0, 10.5, 10.0};
constexpr std::array<double, 9> kVolume_mm3 = {0.0, 260.0, 290.0, 440.0, 430.0, 480.0, 980.0, 940.0, 800.0};
constexpr double kVolumeSpread = 0.35, kThirdMolarSpread = 0.5;  ///< of its logarithm
constexpr double kMissing = 2.0, kMissingAtEnd = 0.5, kSpare = 4.0, kCrumbSpare = 1.5, kSpareCrumb_mm3 = 150.0;
constexpr double kMostMisfit = 12.0, kAgainstAPerson = 1e6, kLeastContact_mm2 = 3.0;

/// Place 0 is 48, 7 is 41, 8 is 31, 15 is 38.
constexpr int fdiAt(int place) { return place < 8 ? 48 - place : 23 + place; }
constexpr std::size_t positionAt(int place) { return static_cast<std::size_t>(fdiAt(place) % 10); }

/// Centre of a place from the midline, to the left.
double expectedAlong_mm(int place) {
  double along = 0.5 * kWidth_mm[positionAt(place)];
  for (std::size_t n = 1; n < positionAt(place); ++n) along += kWidth_mm[n];
  return place < 8 ? -along : along;
}

double squareHalved(double x) { return 0.5 * x * x; }

/// How far along the arch a point lies, from angle 0 to the left.
double along_mm(const JawArch& arch, const glm::dvec3& p_P_mm) {
  const double angle = arch.angleOf(p_P_mm), step = angle / 200.0;
  double length = 0.0;
  for (int n = 0; n < 200; ++n) {
    const double from = n * step, to = from + step;
    const auto point_at = [&](double at) {
      const double place = (at / kArchEnd_rad + 1.0) * 0.5 * kArchBins - 0.5;
      const int low = std::clamp(static_cast<int>(std::floor(place)), 0, kArchBins - 2);
      const double share = std::clamp(place - low, 0.0, 1.0);
      const double radius = (1.0 - share) * arch.radius_mm[static_cast<std::size_t>(low)] +
                            share * arch.radius_mm[static_cast<std::size_t>(low + 1)];
      return radius * glm::dvec2(std::sin(at), -std::cos(at));
    };
    length += glm::distance(point_at(from), point_at(to));
  }
  return angle < 0.0 ? -length : length;
}

/// The cost of one tooth having one number, and of two being neighbours among the found.
class Misfit {
 public:
  Misfit(const JawArch& arch, const std::vector<FoundTooth>& teeth) : arch_(arch), teeth_(teeth) {
    for (const FoundTooth& tooth : teeth) along_.push_back(along_mm(arch, tooth.centre_P_mm));
  }

  double ofPlace(std::size_t tooth, int place) const {
    if (const int told = teeth_[tooth].told_fdi; told != 0) return told == fdiAt(place) ? 0.0 : kAgainstAPerson;
    const std::size_t position = positionAt(place);
    const double spread = position == 8 ? kThirdMolarSpread : kVolumeSpread;
    const double size = squareHalved(std::log(teeth_[tooth].volume_mm3 / kVolume_mm3[position]) / spread);
    // On the wrong side of the middle by more than an incisor.
    const double aside = teeth_[tooth].centre_P_mm.x - arch_.centre_P_mm.x;
    const double wrong_mm = std::max(0.0, (place < 8 ? aside : -aside) - 3.0);
    return std::min(kMostMisfit, size) + squareHalved(wrong_mm / 2.0);
  }
  double ofStep(std::size_t from, int from_place, std::size_t to, int to_place) const {
    const double expected = expectedAlong_mm(to_place) - expectedAlong_mm(from_place);
    const bool is_third = positionAt(from_place) == 8 || positionAt(to_place) == 8;
    const double spread = (is_third ? 4.0 : 1.5) + 0.08 * expected;
    return std::min(kMostMisfit, squareHalved((along_[to] - along_[from] - expected) / spread)) +
           missing(from_place + 1, to_place);
  }
  /// Places without a tooth between two of the found.
  static double missing(int first, int end) {
    double cost = 0.0;
    for (int place = first; place < end; ++place) cost += positionAt(place) == 8 ? 0.0 : kMissing;
    return cost;
  }
  /// Beyond the last tooth; the other side of a scan of one side is not missed.
  double missingAtEnd(int first, int end) const {
    double cost = 0.0;
    for (int place = first; place < end && !arch_.is_one_sided; ++place)
      cost += positionAt(place) == 8 ? 0.0 : kMissingAtEnd;
    return cost;
  }
  double ofSpare(std::size_t tooth) const {
    if (teeth_[tooth].told_fdi != 0) return kAgainstAPerson;
    return teeth_[tooth].volume_mm3 < kSpareCrumb_mm3 ? kCrumbSpare : kSpare;
  }

 private:
  const JawArch& arch_;
  const std::vector<FoundTooth>& teeth_;
  std::vector<double> along_;
};

}  // namespace

std::vector<FoundTooth> measuredTeeth(const Mandible& jaw, const ToothRegions& regions, const GreyLevels& levels) {
  struct Sums {
    glm::dvec3 all{0.0}, enamel{0.0}, low{1e9}, high{-1e9};
    double count = 0.0, enamel_count = 0.0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>(regions.count) + 1);
  forCells(regions.box.size(), [&](glm::ivec3 ijk, std::size_t n) {
    if (regions.part[n] == 0) return;
    Sums& sum = sums[regions.part[n]];
    const glm::ivec3 at = regions.box.low + ijk;
    const glm::dvec3 p = jaw.grid.centre_P_mm(at);
    sum.all += p, sum.count += 1.0;
    sum.low = glm::min(sum.low, p), sum.high = glm::max(sum.high, p);
    if (jaw.smooth_hu[jaw.grid.index(at)] > levels.enamel_hu()) sum.enamel += p, sum.enamel_count += 1.0;
  });
  std::vector<FoundTooth> found;
  const double voxel_mm3 = jaw.grid.voxelVolume_mm3();
  for (int part = 1; part <= regions.count; ++part) {
    const Sums& sum = sums[static_cast<std::size_t>(part)];
    if (sum.count * voxel_mm3 < kLeastTooth_mm3) continue;
    FoundTooth tooth;
    tooth.part = part;
    tooth.volume_mm3 = sum.count * voxel_mm3;
    tooth.centre_P_mm = sum.all / sum.count;
    tooth.extent_mm = sum.high - sum.low;
    tooth.low_z_P_mm = sum.low.z;
    if (sum.enamel_count * voxel_mm3 > kLeastCrown_mm3)
      tooth.crown_P_mm = sum.enamel / sum.enamel_count - tooth.centre_P_mm;
    found.push_back(tooth);
  }
  return found;
}

void numberTeeth(const JawArch& arch, std::vector<FoundTooth>& teeth) {
  const auto along = [&](const FoundTooth& tooth) { return along_mm(arch, tooth.centre_P_mm); };
  std::ranges::stable_sort(teeth, {}, along);
  const Misfit misfit(arch, teeth);
  // Cheapest way in which a tooth has a place, and the tooth and place before it.
  struct Way {
    double cost = std::numeric_limits<double>::infinity();
    int tooth = -1, place = -1;
  };
  std::vector<std::array<Way, kPlaces>> ways(teeth.size());
  std::vector<double> spared(teeth.size() + 1, 0.0);
  for (std::size_t t = 0; t < teeth.size(); ++t) spared[t + 1] = spared[t] + misfit.ofSpare(t);
  Way best{spared.back(), -1, -1};
  for (std::size_t t = 0; t < teeth.size(); ++t)
    for (int place = 0; place < kPlaces; ++place) {
      Way& way = ways[t][static_cast<std::size_t>(place)];
      way = {spared[t] + misfit.missingAtEnd(0, place), -1, -1};
      for (std::size_t before = 0; before < t; ++before)
        for (int at = 0; at < place; ++at) {
          const double cost = ways[before][static_cast<std::size_t>(at)].cost + spared[t] - spared[before + 1] +
                              misfit.ofStep(before, at, t, place);
          if (cost < way.cost) way = {cost, static_cast<int>(before), at};
        }
      way.cost += misfit.ofPlace(t, place);
      const double whole = way.cost + spared.back() - spared[t + 1] + misfit.missingAtEnd(place + 1, kPlaces);
      if (whole < best.cost) best = {whole, static_cast<int>(t), place};
    }
  for (Way at = best; at.tooth >= 0;) {
    const auto t = static_cast<std::size_t>(at.tooth);
    teeth[t].fdi = fdiAt(at.place);
    at = ways[t][static_cast<std::size_t>(at.place)];
  }
  // Numbers out of their order along the arch, or of upper teeth, are a person's too.
  for (FoundTooth& tooth : teeth) {
    if (tooth.told_fdi == 0) continue;
    for (FoundTooth& other : teeth)
      if (other.fdi == tooth.told_fdi) other.fdi = 0;
    tooth.fdi = tooth.told_fdi;
  }
}

bool joinSpareParts(const Mandible& jaw, const std::vector<FoundTooth>& teeth, ToothRegions& regions) {
  const auto parts = static_cast<std::size_t>(regions.count) + 1;
  std::vector<std::size_t> faces(parts * parts, 0);
  const glm::ivec3 size = regions.box.size();
  for (std::size_t n = 0; n < regions.part.size(); ++n) {
    if (regions.part[n] == 0) continue;
    forNeighbours(size, n, [&](std::size_t next) { ++faces[regions.part[n] * parts + regions.part[next]]; });
  }
  std::vector<std::uint8_t> joined(parts);
  for (std::size_t part = 0; part < parts; ++part) joined[part] = static_cast<std::uint8_t>(part);
  std::vector<double> volume_mm3(parts, 0.0);
  for (const FoundTooth& tooth : teeth) volume_mm3[static_cast<std::size_t>(tooth.part)] = tooth.volume_mm3;
  const double least_faces = kLeastContact_mm2 / (jaw.grid.spacing_mm * jaw.grid.spacing_mm);
  bool has_joined = false;
  for (const FoundTooth& spare : teeth) {
    if (spare.fdi != 0 || spare.is_apart) continue;
    const FoundTooth* owner = nullptr;
    std::size_t most = static_cast<std::size_t>(least_faces);
    const auto row = static_cast<std::size_t>(spare.part) * parts;
    for (const FoundTooth& tooth : teeth)
      if (const std::size_t touch = faces[row + static_cast<std::size_t>(tooth.part)]; tooth.fdi != 0 && touch > most)
        most = touch, owner = &tooth;
    if (owner == nullptr) continue;
    double& volume = volume_mm3[static_cast<std::size_t>(owner->part)];
    const double usual = kVolume_mm3[static_cast<std::size_t>(owner->fdi % 10)];
    if (std::abs(std::log((volume + spare.volume_mm3) / usual)) >= std::abs(std::log(volume / usual))) continue;
    volume += spare.volume_mm3;
    joined[static_cast<std::size_t>(spare.part)] = static_cast<std::uint8_t>(owner->part);
    has_joined = true;
  }
  for (std::uint8_t& part : regions.part) part = joined[part];
  return has_joined;
}

}  // namespace assets
