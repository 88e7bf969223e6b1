// Outlines of revolved bur heads: named profiles as radius over height, polylines of at most 16 knots, scaled by the
// largest radius R and the whole length L. A knot lies at (a R) from the axis and b R + c L above the lower end, so a
// round tip keeps its form on a long bur. Frame T: origin at mid-height, +z to the shaft, mm. An end off the axis is a
// flat disc; one on the axis is round. Any thread, the servo's too: the table is each object's own; 20 ns; no
// allocation. Forms as drawn in makers' catalogues (unverified); names follow ISO 6360-2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace assets {

enum class BurProfile : std::uint8_t {
  wheel,
  inverted_cone,
  taper,
  round_taper,
  torpedo,
  flame,
  pear,
  egg,
  round_cylinder
};
inline constexpr std::size_t kBurProfiles = 9;

inline constexpr std::size_t kMostKnots = 16;

/// From the lower end up; heights never fall.
struct BurOutline {
  std::array<double, kMostKnots> radius_mm{}, z_mm{};
  std::size_t count = 0;
};

namespace bur_outline {

struct Knot {
  double radius, per_radius, per_length;
};
struct Profile {
  double least_length;  ///< of the radius: shorter heads have no such outline
  std::size_t count;
  std::array<Knot, kMostKnots> knot;
};

// Internal linkage: each object has its own copy.
// Quarter circles by 15 degrees; the torpedo's point is an arc of 1.875 R that meets the side without an edge; the egg
// is an ellipse by 12 degrees.
constexpr std::array<Profile, kBurProfiles> kProfiles = {{
    {0.0, 2, {{{1.0, 0.0, 0.0}, {1.0, 0.0, 1.0}}}},
    {0.0, 2, {{{1.0, 0.0, 0.0}, {0.7, 0.0, 1.0}}}},
    {0.0, 2, {{{0.6, 0.0, 0.0}, {1.0, 0.0, 1.0}}}},
    {0.8,
     8,
     {{{0.0, 0.0, 0.0},
       {0.15529143, 0.02044450, 0.0},
       {0.3, 0.08038476, 0.0},
       {0.42426407, 0.17573593, 0.0},
       {0.51961524, 0.3, 0.0},
       {0.57955550, 0.44470857, 0.0},
       {0.6, 0.6, 0.0},
       {1.0, 0.0, 1.0}}}},
    {1.8,
     9,
     {{{0.0, 0.0, 0.0},
       {0.25, 0.08, 0.0},
       {0.52254242, 0.33, 0.0},
       {0.71107165, 0.58, 0.0},
       {0.84346564, 0.83, 0.0},
       {0.93210364, 1.08, 0.0},
       {0.98325876, 1.33, 0.0},
       {1.0, 1.58, 0.0},
       {1.0, 0.0, 1.0}}}},
    {2.0,
     13,
     {{{0.0, 0.0, 0.0},
       {0.10, 0.04, 0.0},
       {0.17, 0.12, 0.0},
       {0.30, 0.0, 0.10},
       {0.52, 0.0, 0.22},
       {0.72, 0.0, 0.36},
       {0.87, 0.0, 0.50},
       {0.97, 0.0, 0.63},
       {1.0, 0.0, 0.72},
       {0.98, 0.0, 0.80},
       {0.93, 0.0, 0.88},
       {0.86, 0.0, 0.95},
       {0.80, 0.0, 1.0}}}},
    {1.5,
     10,
     {{{0.0, 0.0, 0.0},
       {0.25881905, 0.03407417, 0.0},
       {0.5, 0.13397460, 0.0},
       {0.70710678, 0.29289322, 0.0},
       {0.86602540, 0.5, 0.0},
       {0.96592583, 0.74118095, 0.0},
       {1.0, 1.0, 0.0},
       {0.90, 0.7, 0.3},
       {0.72, 0.35, 0.65},
       {0.6, 0.0, 1.0}}}},
    {1.0,
     16,
     {{{0.0, 0.0, 0.0},
       {0.20791169, 0.0, 0.01092620},
       {0.40673664, 0.0, 0.04322727},
       {0.58778525, 0.0, 0.09549150},
       {0.74314483, 0.0, 0.16543470},
       {0.86602540, 0.0, 0.25},
       {0.95105652, 0.0, 0.34549150},
       {0.99452190, 0.0, 0.44773577},
       {0.99452190, 0.0, 0.55226423},
       {0.95105652, 0.0, 0.65450850},
       {0.86602540, 0.0, 0.75},
       {0.74314483, 0.0, 0.83456530},
       {0.58778525, 0.0, 0.90450850},
       {0.40673664, 0.0, 0.95677273},
       {0.20791169, 0.0, 0.98907380},
       {0.0, 0.0, 1.0}}}},
    {1.2,
     8,
     {{{0.0, 0.0, 0.0},
       {0.25881905, 0.03407417, 0.0},
       {0.5, 0.13397460, 0.0},
       {0.70710678, 0.29289322, 0.0},
       {0.86602540, 0.5, 0.0},
       {0.96592583, 0.74118095, 0.0},
       {1.0, 1.0, 0.0},
       {1.0, 0.0, 1.0}}}},
}};

constexpr const Profile& of(BurProfile profile) {
  return kProfiles[std::min(static_cast<std::size_t>(profile), kBurProfiles - 1)];
}

}  // namespace bur_outline

/// In the order of BurProfile: keys of the text form and of sessions.
inline constexpr std::array<std::string_view, kBurProfiles> kBurProfileKeys = {
    "wheel", "inverted-cone", "taper", "round-taper", "torpedo", "flame", "pear", "egg", "round-cylinder"};

/// Shorter than this a profile of this radius would fold.
inline double leastBurLength_mm(BurProfile profile, double radius_mm) noexcept {
  return bur_outline::of(profile).least_length * radius_mm;
}

/// Both positive.
inline BurOutline burOutline(BurProfile profile, double radius_mm, double length_mm) noexcept {
  const bur_outline::Profile& form = bur_outline::of(profile);
  BurOutline outline;
  outline.count = form.count;
  double reached_mm = 0.0;
  for (std::size_t n = 0; n < form.count; ++n) {
    const bur_outline::Knot& knot = form.knot[n];
    reached_mm = std::max(reached_mm, knot.per_radius * radius_mm + knot.per_length * length_mm);
    outline.radius_mm[n] = knot.radius * radius_mm;
    outline.z_mm[n] = std::min(reached_mm, length_mm) - 0.5 * length_mm;
  }
  return outline;
}

/// Half the way round the head: negative inside, to the nearest place of its surface; `rho` from the axis.
inline double outlineDistance_mm(const BurOutline& outline, double rho_mm, double z_mm) noexcept {
  double least2 = 1e300, side = 1.0;
  const auto line = [&](double r0, double z0, double r1, double z1) {
    const double dr = r1 - r0, dz = z1 - z0, length2 = dr * dr + dz * dz;
    if (!(length2 > 0.0)) return;
    const double t = std::clamp(((rho_mm - r0) * dr + (z_mm - z0) * dz) / length2, 0.0, 1.0);
    const double x = rho_mm - r0 - t * dr, y = z_mm - z0 - t * dz;
    const double away2 = x * x + y * y;
    if (away2 < least2) least2 = away2;
  };
  const std::size_t last = outline.count - 1;
  line(0.0, outline.z_mm[0], outline.radius_mm[0], outline.z_mm[0]);
  for (std::size_t n = 0; n < last; ++n) {
    line(outline.radius_mm[n], outline.z_mm[n], outline.radius_mm[n + 1], outline.z_mm[n + 1]);
    // A place on the height of a knot belongs to both stretches.
    if (z_mm < outline.z_mm[n] || z_mm > outline.z_mm[n + 1] || !(outline.z_mm[n + 1] > outline.z_mm[n])) continue;
    const double part = (z_mm - outline.z_mm[n]) / (outline.z_mm[n + 1] - outline.z_mm[n]);
    if (rho_mm < outline.radius_mm[n] + part * (outline.radius_mm[n + 1] - outline.radius_mm[n])) side = -1.0;
  }
  line(outline.radius_mm[last], outline.z_mm[last], 0.0, outline.z_mm[last]);
  return side * std::sqrt(least2);
}

}  // namespace assets
