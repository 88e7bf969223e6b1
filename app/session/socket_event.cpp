#include "app/session/socket_event.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "assets/json_depth.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) { return std::round(100.0 * value) / 100.0; }

Json listOf(const Place& place) {
  const glm::dvec3& p = place.centre_P_mm;
  return {rounded(place.amount), rounded(p.x), rounded(p.y), rounded(p.z)};
}

Json listOf(const std::vector<Place>& places) {
  Json list = Json::array();
  for (std::size_t n = 0; n < std::min(places.size(), kMostPlaces); ++n) list.push_back(listOf(places[n]));
  return list;
}

/// False: not what jsonOf makes.
bool readPlace(const Json& list, Place& place) {
  if (!list.is_array() || list.size() != 4) return false;
  for (const Json& number : list)
    if (!number.is_number() || !std::isfinite(number.get<double>())) return false;
  place = {list[0].get<double>(), {list[1].get<double>(), list[2].get<double>(), list[3].get<double>()}};
  return place.amount >= 0.0;
}

bool readPlaces(const Json& list, std::vector<Place>& places) {
  if (!list.is_array() || list.size() > kMostPlaces) return false;
  places.resize(list.size());
  for (std::size_t n = 0; n < places.size(); ++n)
    if (!readPlace(list[n], places[n])) return false;
  return true;
}

void add(std::string& words, const std::string& more) { words += (words.empty() ? "" : ", ") + more; }

}  // namespace

double sumOf(const std::vector<Place>& places) {
  return std::accumulate(places.begin(), places.end(), 0.0,
                         [](double sum, const Place& place) { return sum + place.amount; });
}

bool SocketRecord::isClean() const { return retained.empty() && sumOf(edges) < kEdgesLeft_mm; }

std::string socketText(const SocketRecord& socket) {
  const Json all = {{"retained", listOf(socket.retained)},
                    {"canal", listOf(socket.canal)},
                    {"lingual", listOf(socket.lingual)},
                    {"edges", listOf(socket.edges)}};
  return all.dump();
}

std::optional<SocketRecord> socketFrom(const std::string& text) {
  if (assets::isNestedTooDeep(text)) return {};
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object()) return {};
  for (const char* key : {"retained", "canal", "lingual", "edges"})
    if (!all.contains(key)) return {};
  SocketRecord socket;
  const bool is_whole = readPlaces(all["retained"], socket.retained) && readPlace(all["canal"], socket.canal) &&
                        readPlaces(all["lingual"], socket.lingual) && readPlaces(all["edges"], socket.edges);
  return is_whole ? std::optional(std::move(socket)) : std::nullopt;
}

std::string socketInWords(const SocketRecord& socket) {
  std::string left, harmed;
  if (!socket.retained.empty())
    add(left, socket.retained.size() == 1
                  ? fmt::format("tooth {:.1f} mm³", socket.retained[0].amount)
                  : fmt::format("{} pieces of tooth {:.1f} mm³", socket.retained.size(), sumOf(socket.retained)));
  if (const double edges_mm = sumOf(socket.edges); edges_mm >= kEdgesLeft_mm)
    add(left, fmt::format("sharp edges {:.0f} mm", edges_mm));
  if (socket.canal.amount > 0.0) add(harmed, fmt::format("canal laid open {:.1f} mm²", socket.canal.amount));
  if (!socket.lingual.empty())
    add(harmed, fmt::format("lingual plate broken through {:.1f} mm²", sumOf(socket.lingual)));
  return (left.empty() ? "clean" : "not clean: " + left) + (harmed.empty() ? "" : "; " + harmed);
}

}  // namespace app
