// What keeps the pieces of a tooth in, as an event of a recording: found by a search while the rehearsal went on, for
// display and record alone. Written when it was found; the last one stands for the session. Frame P, mm. Pure; any
// thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace app {

/// Kind of these events.
inline constexpr char kWayEvent[] = "way out";

/// One kind of hard tissue on one side of a piece.
struct Keeper {
  std::string what;  ///< "distobuccal bone", "tooth 47", "the root"
  double volume_mm3 = 0.0;
  glm::dvec3 centre_P_mm{0.0};

  bool operator==(const Keeper&) const = default;
};
inline constexpr std::size_t kMostKeepers = 16;

enum class KeptIn { free, tightly, held, not_found };

struct WayOfPiece {
  std::string piece;  ///< "crown", "mesial root", "tooth"
  KeptIn answer = KeptIn::not_found;
  bool waits = false;           ///< it comes after those before it in the list
  std::string lift;             ///< "up and back"; empty: unknown
  std::vector<Keeper> kept_by;  ///< the most first
  double kept_by_mm3 = 0.0;     ///< in all
  std::size_t poses = 0;        ///< that were looked at

  bool operator==(const WayOfPiece&) const = default;
};

/// In the order in which they come out.
struct WayRecord {
  bool was_asked = false;  ///< by the surgeon; false: after a cut
  std::vector<WayOfPiece> pieces;

  bool operator==(const WayRecord&) const = default;
};
inline constexpr std::size_t kMostWays = 8;

/// The piece that the surgeon has to do with next: the first one that is kept in; null: all are free.
const WayOfPiece* nextKept(const WayRecord& way);

/// One line of JSON.
std::string wayText(const WayRecord& way);
/// None of other words, numbers that are not finite, or amounts below 0.
std::optional<WayRecord> wayFrom(const std::string& text);

/// "distobuccal bone holds the crown: 3.1 mm³; the root after it", "the crown is free: lift it up and back; then
/// distal bone holds the root: 2.4 mm³", "no way found for the tooth in 12000 poses". Empty: no piece.
std::string wayInWords(const WayRecord& way);

}  // namespace app
