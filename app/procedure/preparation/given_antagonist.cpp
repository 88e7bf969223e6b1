#include "app/procedure/preparation/given_antagonist.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/core.h>

#include "app/procedure/preparation/jaw_closing.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/tooth.h"
#include "assets/trilinear.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

constexpr int kOpposingSide = OcclusalRaster::kSide;
static_assert(kOpposingSide == assets::OpposingTeeth::kSide &&
              OcclusalRaster::kStep_mm == assets::OpposingTeeth::kStep_mm);
constexpr double kFarOver_mm = 25.0;  ///< nothing higher bites
constexpr double kDeepest_mm = 1.0, kFarthest_mm = 5.0, kLeastOver_mm2 = 1.0;
constexpr double kArch_mm = 35.0;
constexpr std::uint64_t kMostPlaces = 400'000'000;  ///< of all faces together: seconds

/// A face's heights over the places that it covers.
class LowestSurface {
 public:
  /// False: too much to go through.
  bool take(const assets::StlTriangle& face) {
    const glm::dvec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    if (!(std::abs(normal.z) > 1e-12)) return true;
    const auto [low_x, high_x] = std::minmax({face[0].x, face[1].x, face[2].x});
    const auto [low_y, high_y] = std::minmax({face[0].y, face[1].y, face[2].y});
    const int from_x = first(low_x), end_x = first(high_x + kRim_mm), from_y = first(low_y),
              end_y = first(high_y + kRim_mm);
    places_ += static_cast<std::uint64_t>(std::max(0, end_x - from_x)) *
               static_cast<std::uint64_t>(std::max(0, end_y - from_y));
    if (places_ > kMostPlaces) return false;
    for (int y = from_y; y < end_y; ++y)
      for (int x = from_x; x < end_x; ++x) {
        const glm::dvec2 at = OcclusalRaster::place_mm(x, y);
        if (!covers(face, normal.z, at)) continue;
        const glm::dvec2 off = at - glm::dvec2(face[0]);
        const double z = face[0].z - (normal.x * off.x + normal.y * off.y) / normal.z;
        // Beside the neck stands something else.
        if (!(z > 0.0 && z < kFarOver_mm)) continue;
        float& height = surface_.at(x, y);
        if (!(static_cast<double>(height) < z)) height = static_cast<float>(z);
      }
    return true;
  }
  const OcclusalRaster& surface() const { return surface_; }

 private:
  static constexpr double kRim_mm = 1e-9;  ///< that a place on an edge belongs to both faces

  static int first(double mm) {
    const double cell = std::ceil((mm - kRim_mm + OcclusalRaster::kHalf_mm) / OcclusalRaster::kStep_mm);
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(kOpposingSide)));
  }
  static bool covers(const assets::StlTriangle& face, double way, const glm::dvec2& at) {
    for (std::size_t n = 0; n < 3; ++n) {
      const glm::dvec2 a(face[n]), b(face[(n + 1) % 3]);
      const double side = (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
      if (side * (way > 0.0 ? 1.0 : -1.0) < -kRim_mm) return false;
    }
    return true;
  }

  OcclusalRaster surface_;
  std::uint64_t places_ = 0;
};

std::string digestOfFile(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return calibration::sha256Of(bytes.str());
}

struct Over {
  double least_mm = std::numeric_limits<double>::infinity();  ///< below 0: it stands in the tooth
  double area_mm2 = 0.0;
};

Over overTooth(const OcclusalRaster& surface, const OcclusalRaster& intact) {
  Over over;
  for (int y = 0; y < kOpposingSide; ++y)
    for (int x = 0; x < kOpposingSide; ++x) {
      if (!surface.has(x, y) || !intact.has(x, y)) continue;
      over.least_mm = std::min(over.least_mm, static_cast<double>(surface.at(x, y) - intact.at(x, y)));
      over.area_mm2 += OcclusalRaster::kStep_mm * OcclusalRaster::kStep_mm;
    }
  return over;
}

assets::OpposingTeeth teethOf(const OcclusalRaster& surface, double up_mm, std::string digest) {
  assets::OpposingTeeth teeth{std::move(digest), {}};
  teeth.height_mm.reserve(static_cast<std::size_t>(kOpposingSide) * kOpposingSide);
  for (int y = 0; y < kOpposingSide; ++y)
    for (int x = 0; x < kOpposingSide; ++x) teeth.height_mm.push_back(surface.at(x, y) + static_cast<float>(up_mm));
  return teeth;
}

/// Greatest extent across the tooth's axis.
bool isArch(std::span<const assets::StlTriangle> mesh) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const assets::StlTriangle& face : mesh)
    for (const glm::dvec3& p : face) low = glm::min(low, p), high = glm::max(high, p);
  return std::max(high.x - low.x, high.y - low.y) > kArch_mm;
}

bool isOfOtherJaw(int tooth, int fdi) {
  return assets::isToothNumber(tooth) && assets::isUpper(tooth) != assets::isUpper(fdi);
}

/// The lowest half solid of the other jaw's teeth along the tooth's axis.
OcclusalRaster lowestOf(const assets::CtVolume& scan, int fdi, const Crown& crown) {
  OcclusalRaster surface;
  const double step_mm = 0.25 * scan.grid.spacing_mm;
  const auto share = [&](const glm::dvec3& p_P) {
    return assets::trilinearAt(scan.grid, p_P, [&](glm::ivec3 ijk) {
      if (!scan.grid.contains(ijk)) return 0.0;
      const std::size_t v = scan.grid.index(ijk);
      return isOfOtherJaw(scan.tooth[v], fdi) ? scan.solid[v] / 255.0 : 0.0;
    });
  };
  for (int y = 0; y < kOpposingSide; ++y)
    for (int x = 0; x < kOpposingSide; ++x) {
      const glm::dvec2 at = OcclusalRaster::place_mm(x, y);
      if (glm::length(at) > crown.reach_mm + 1.0) continue;
      double was = share(crown.frame.inP({at, 0.0}));
      for (double z = step_mm; z < kFarOver_mm; z += step_mm) {
        const double is = share(crown.frame.inP({at, z}));
        if (was < 0.5 && is >= 0.5) {
          surface.at(x, y) = static_cast<float>(z - step_mm * (is - 0.5) / (is - was));
          break;
        }
        was = is;
      }
    }
  return surface;
}

}  // namespace

GivenAntagonist givenAntagonist(std::span<const assets::StlTriangle> mesh, const assets::ToothFrame& frame,
                                const OcclusalRaster& intact, std::string digest, const std::string& name) {
  LowestSurface lowest;
  for (const assets::StlTriangle& face : mesh)
    if (!lowest.take({frame.local(face[0]), frame.local(face[1]), frame.local(face[2])}))
      throw UsageError(name + ": its faces are too large and too many, no teeth have them");
  const Over over = overTooth(lowest.surface(), intact);
  const auto refuse = [&](const std::string& why) {
    throw UsageError(name + ": " + why + "; give the opposing teeth in the patient's frame, mm, where the teeth meet");
  };
  if (over.area_mm2 < kLeastOver_mm2) refuse("nothing of it stands over the tooth");
  if (over.least_mm < -kDeepest_mm) refuse(fmt::format("it stands {:.1f} mm deep in the tooth", -over.least_mm));
  if (over.least_mm > kFarthest_mm) refuse(fmt::format("it stands {:.1f} mm over the tooth", over.least_mm));
  return {teethOf(lowest.surface(), 0.0, std::move(digest)), isArch(mesh), {}};
}

GivenAntagonist readAntagonist(const std::string& path, const Crown& crown, const std::string& option) try {
  const std::vector<assets::StlTriangle> mesh = assets::readStl(path);
  return givenAntagonist(mesh, crown.frame, occlusalHeights(crown, crown.solid), digestOfFile(path),
                         option + " " + path);
} catch (const assets::LoadError& error) {
  throw UsageError(option + " " + error.what());
}

bool hasOpposingTeeth(const assets::CtVolume& scan, int fdi) {
  return std::ranges::any_of(scan.tooth, [&](std::uint8_t tooth) { return isOfOtherJaw(tooth, fdi); });
}

std::optional<GivenAntagonist> scannedAntagonist(const assets::CtVolume& scan, int fdi, const Crown& crown) {
  const OcclusalRaster surface = lowestOf(scan, fdi, crown);
  const Over over = overTooth(surface, occlusalHeights(crown, crown.solid));
  if (over.area_mm2 < kLeastOver_mm2 || over.least_mm < -kDeepest_mm) return {};
  // Voxels of two teeth that meet overlap by parts of one; jaws that were open are closed on this tooth.
  constexpr double kMeet_mm = 1.0;
  const bool is_open = over.least_mm > kMeet_mm;
  const double up_mm = is_open || over.least_mm < 0.0 ? -over.least_mm : 0.0;
  return GivenAntagonist{
      teethOf(surface, up_mm, {}), true,
      is_open
          ? fmt::format("the scan's jaws are {:.1f} mm apart over this tooth: closed until it meets what opposes it",
                        over.least_mm)
          : std::string()};
}

glm::dvec2 usualHinge_mm(int fdi) {
  constexpr glm::dvec2 kOfIncisors_mm{80.0, 32.0};
  constexpr std::array<double, 9> kBehindIncisors_mm{0.0, 0.0, 1.5, 5.0, 11.0, 17.0, 25.0, 34.0, 43.0};
  return kOfIncisors_mm - glm::dvec2(kBehindIncisors_mm[static_cast<std::size_t>(assets::positionOf(fdi))], 0.0);
}

glm::dvec3 hinge_P_mm(const Crown& crown, const glm::dvec2& behind_and_over_mm) {
  return crown.frame.inP({0.0, 0.0, crown.top_mm}) + glm::dvec3(0.0, behind_and_over_mm.x, behind_and_over_mm.y);
}

}  // namespace app
