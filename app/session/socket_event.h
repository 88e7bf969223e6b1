// The state of the socket as an event of a recording: chips that came loose, and once a piece of tooth is out what is
// left of it, what was laid open or broken through, sharp edges. Written when it changes; the last one stands for the
// session. Frame P, mm. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace app {

/// Kind of these events.
inline constexpr char kSocketEvent[] = "socket";

/// So much of something, and where.
struct Place {
  double amount = 0.0;
  glm::dvec3 centre_P_mm{0.0};

  bool operator==(const Place&) const = default;
};
double sumOf(const std::vector<Place>& places);

/// So many, and so much of them.
struct Amount {
  int count = 0;
  double mm3 = 0.0;

  bool operator==(const Amount&) const = default;
};

/// The largest first; at most kMostPlaces of each are kept.
struct SocketRecord {
  Amount chips;                         ///< loose in the mouth
  std::vector<Place> chip_places;       ///< mm³, where they lie
  std::optional<double> follicle_left;  ///< share; none: there was none
  Amount chips_taken;                   ///< by suction
  bool is_out = true;                   ///< a piece of tooth is out; false: the rest was not looked at
  std::vector<Place> retained;          ///< pieces of tooth, mm³
  Place canal;                          ///< laid open, mm²; 0: not
  double canal_by_root_mm2 = 0.0;       ///< of that, where the tooth itself lay on it: no bone was there to be kept
  std::vector<Place> lingual;           ///< holes in the lingual plate, mm²
  std::vector<Place> edges;             ///< sharp, mm

  int stitches = 0, stitch_places = 0;  ///< confirmed, of so many

  /// Nothing is left to do. What was laid open or broken through stays so.
  bool isClean() const;
  bool operator==(const SocketRecord&) const = default;
};
inline constexpr std::size_t kMostPlaces = 32;
/// As chips go, dust.
inline constexpr double kDust_mm3 = 0.05;
/// A smaller share of the follicle is let be.
inline constexpr double kFollicleLeft = 0.1;
/// Shorter in all, sharp edges are let be.
inline constexpr double kEdgesLeft_mm = 2.0;

/// One line of JSON.
std::string socketText(const SocketRecord& socket);
/// None of other words, numbers that are not finite, or amounts below 0.
std::optional<SocketRecord> socketFrom(const std::string& text);

/// "clean", "not clean: tooth 34.2 mm³, 3 chips 1.2 mm³, follicle 40 %, sharp edges 12 mm; canal laid open 2.5 mm²; 2
/// of 3 stitches"; before a piece is out "3 chips 1.2 mm³", or nothing.
std::string socketInWords(const SocketRecord& socket);

}  // namespace app
