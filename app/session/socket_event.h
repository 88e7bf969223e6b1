// The state of the socket as an event of a recording: what is left of the tooth, what was laid open or broken through,
// sharp edges. Written when it was looked at after a piece came out; the last one stands for the session. Frame P, mm.
// Pure; any thread.
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

/// The largest first; at most kMostPlaces of each are kept.
struct SocketRecord {
  std::vector<Place> retained;  ///< pieces of tooth, mm³
  Place canal;                  ///< laid open, mm²; 0: not
  std::vector<Place> lingual;   ///< holes in the lingual plate, mm²
  std::vector<Place> edges;     ///< sharp, mm

  /// Nothing is left to do. What was laid open or broken through stays so.
  bool isClean() const;
  bool operator==(const SocketRecord&) const = default;
};
inline constexpr std::size_t kMostPlaces = 32;
/// Shorter in all, sharp edges are let be.
inline constexpr double kEdgesLeft_mm = 2.0;

/// One line of JSON.
std::string socketText(const SocketRecord& socket);
/// None of other words.
std::optional<SocketRecord> socketFrom(const std::string& text);

/// "clean", "not clean: tooth 34.2 mm³, sharp edges 12 mm; canal laid open 2.5 mm²".
std::string socketInWords(const SocketRecord& socket);

}  // namespace app
