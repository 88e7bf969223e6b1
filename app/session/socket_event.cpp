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

Json listOf(const Amount& amount) { return {amount.count, rounded(amount.mm3)}; }

bool readAmount(const Json& list, Amount& amount) {
  constexpr int kMost = 1'000'000;
  if (!list.is_array() || list.size() != 2 || !list[0].is_number_integer() || !list[1].is_number()) return false;
  const double count = list[0].get<double>();
  amount.mm3 = list[1].get<double>();
  if (!(count >= 0.0 && count <= kMost) || !std::isfinite(amount.mm3)) return false;
  amount.count = static_cast<int>(count);
  return amount.mm3 >= 0.0;
}

void add(std::string& words, const std::string& more) { words += (words.empty() ? "" : ", ") + more; }

}  // namespace

double sumOf(const std::vector<Place>& places) {
  return std::accumulate(places.begin(), places.end(), 0.0,
                         [](double sum, const Place& place) { return sum + place.amount; });
}

bool SocketRecord::isClean() const {
  const bool has_chip = !chip_places.empty() && chip_places[0].amount >= kDust_mm3;
  return retained.empty() && !has_chip && follicle_left.value_or(0.0) <= kFollicleLeft && sumOf(edges) < kEdgesLeft_mm;
}

std::string socketText(const SocketRecord& socket) {
  const Json all = {{"chips", listOf(socket.chips)},
                    {"chip_places", listOf(socket.chip_places)},
                    {"chips_taken", listOf(socket.chips_taken)},
                    {"follicle", socket.follicle_left ? Json(rounded(*socket.follicle_left)) : Json()},
                    {"stitches", Json{socket.stitches, socket.stitch_places}},
                    {"out", socket.is_out},
                    {"retained", listOf(socket.retained)},
                    {"canal", listOf(socket.canal)},
                    {"canal_by_root", rounded(socket.canal_by_root_mm2)},
                    {"lingual", listOf(socket.lingual)},
                    {"edges", listOf(socket.edges)}};
  return all.dump();
}

std::optional<SocketRecord> socketFrom(const std::string& text) {
  if (assets::isNestedTooDeep(text)) return {};
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object()) return {};
  for (const char* key :
       {"chips", "chip_places", "chips_taken", "follicle", "stitches", "out", "retained", "canal", "lingual", "edges"})
    if (!all.contains(key)) return {};
  SocketRecord socket;
  if (!all["out"].is_boolean()) return {};
  if (const Json& share = all["follicle"]; !share.is_null()) {
    if (!share.is_number() || !(share.get<double>() >= 0.0 && share.get<double>() <= 1.0)) return {};
    socket.follicle_left = share.get<double>();
  }
  socket.is_out = all["out"].get<bool>();
  // Sessions before 2026-11-29 do not tell it apart.
  if (const auto by_root = all.find("canal_by_root"); by_root != all.end()) {
    if (!by_root->is_number() || !(by_root->get<double>() >= 0.0) || !std::isfinite(by_root->get<double>())) return {};
    socket.canal_by_root_mm2 = by_root->get<double>();
  }
  const Json& stitches = all["stitches"];
  constexpr int kMostStitches = 100;
  if (!stitches.is_array() || stitches.size() != 2) return {};
  for (const Json& count : stitches)
    if (!count.is_number_integer() || !(count.get<double>() >= 0.0 && count.get<double>() <= kMostStitches)) return {};
  socket.stitches = stitches[0].get<int>();
  socket.stitch_places = stitches[1].get<int>();
  constexpr double kRounded_mm2 = 0.01;
  const bool is_whole = readAmount(all["chips"], socket.chips) && readPlaces(all["chip_places"], socket.chip_places) &&
                        readAmount(all["chips_taken"], socket.chips_taken) &&
                        readPlaces(all["retained"], socket.retained) && readPlace(all["canal"], socket.canal) &&
                        readPlaces(all["lingual"], socket.lingual) && readPlaces(all["edges"], socket.edges) &&
                        socket.canal_by_root_mm2 <= socket.canal.amount + kRounded_mm2;
  return is_whole ? std::optional(std::move(socket)) : std::nullopt;
}

std::string socketInWords(const SocketRecord& socket) {
  std::string left, harmed;
  const auto chips = [&] {
    return fmt::format("{} chip{} {:.1f} mm³", socket.chips.count, socket.chips.count == 1 ? "" : "s",
                       socket.chips.mm3);
  };
  if (!socket.is_out) return socket.chips.count == 0 ? "" : chips();
  if (!socket.retained.empty())
    add(left, socket.retained.size() == 1
                  ? fmt::format("tooth {:.1f} mm³", socket.retained[0].amount)
                  : fmt::format("{} pieces of tooth {:.1f} mm³", socket.retained.size(), sumOf(socket.retained)));
  if (!socket.chip_places.empty() && socket.chip_places[0].amount >= kDust_mm3) add(left, chips());
  if (socket.follicle_left.value_or(0.0) > kFollicleLeft)
    add(left, fmt::format("follicle {:.0f} %", 100.0 * *socket.follicle_left));
  if (const double edges_mm = sumOf(socket.edges); edges_mm >= kEdgesLeft_mm)
    add(left, fmt::format("sharp edges {:.0f} mm", edges_mm));
  if (socket.canal.amount > 0.0)
    add(harmed, fmt::format("canal laid open {:.1f} mm²", socket.canal.amount) +
                    (socket.canal_by_root_mm2 > 0.0
                         ? fmt::format(" ({:.1f} of it where the tooth lay on it)", socket.canal_by_root_mm2)
                         : ""));
  if (!socket.lingual.empty())
    add(harmed, fmt::format("lingual plate broken through {:.1f} mm²", sumOf(socket.lingual)));
  return (left.empty() ? "clean" : "not clean: " + left) + (harmed.empty() ? "" : "; " + harmed) +
         (socket.stitches == 0 ? "" : fmt::format("; {} of {} stitches", socket.stitches, socket.stitch_places));
}

}  // namespace app
