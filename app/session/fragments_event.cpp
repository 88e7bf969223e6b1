#include "app/session/fragments_event.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/session/session_error.h"
#include "assets/json_depth.h"

namespace app {
namespace {

using FragmentJson = nlohmann::json;

constexpr double kFarthestNode_mm = 1e4, kThickest_mm = 2.0;
constexpr int kLargestSize = 140;

[[noreturn]] void refuseFragments() { throw damagedSession("it has no valid fragments of files"); }

double numberOf(const FragmentJson& value, double least, double most) {
  if (!value.is_number()) refuseFragments();
  const double number = value.get<double>();
  if (!(number >= least && number <= most)) refuseFragments();
  return number;
}

assets::MetalFragment fragmentFrom(const FragmentJson& object) {
  if (!object.is_object() || !object.contains("size") || !object.contains("nickel_titanium") ||
      !object.contains("nodes"))
    refuseFragments();
  const FragmentJson &size = object["size"], &metal = object["nickel_titanium"], &nodes = object["nodes"];
  if (!size.is_number_integer() || !metal.is_boolean() || !nodes.is_array() || nodes.size() < 2 ||
      nodes.size() > assets::kMostMetalNodes)
    refuseFragments();
  assets::MetalFragment one;
  one.size = static_cast<int>(numberOf(size, 1, kLargestSize));
  one.nickel_titanium = metal.get<bool>();
  for (const FragmentJson& node : nodes) {
    if (!node.is_array() || node.size() != 4) refuseFragments();
    const auto coordinate = [&](std::size_t n) { return numberOf(node[n], -kFarthestNode_mm, kFarthestNode_mm); };
    one.node_P_mm.emplace_back(coordinate(0), coordinate(1), coordinate(2));
    one.radius_mm.push_back(numberOf(node[3], 0.0, kThickest_mm));
  }
  return one;
}

}  // namespace

std::string fragmentsText(const std::vector<assets::MetalFragment>& fragments) {
  FragmentJson list = FragmentJson::array();
  for (const assets::MetalFragment& one : fragments) {
    FragmentJson nodes = FragmentJson::array();
    for (std::size_t n = 0; n < one.node_P_mm.size(); ++n)
      nodes.push_back({one.node_P_mm[n].x, one.node_P_mm[n].y, one.node_P_mm[n].z, one.radius_mm[n]});
    list.push_back({{"size", one.size}, {"nickel_titanium", one.nickel_titanium}, {"nodes", std::move(nodes)}});
  }
  return list.dump();
}

std::vector<assets::MetalFragment> fragmentsFrom(std::string_view text) {
  const FragmentJson list = assets::isNestedTooDeep(text) ? FragmentJson() : FragmentJson::parse(text, nullptr, false);
  if (!list.is_array() || list.size() > assets::kMostMetalFragments) refuseFragments();
  std::vector<assets::MetalFragment> fragments;
  std::ranges::transform(list, std::back_inserter(fragments), fragmentFrom);
  return fragments;
}

std::vector<assets::MetalFragment> fragmentsIn(const SessionSetup& setup, const std::vector<SessionEvent>& events,
                                               std::uint64_t last_tick) {
  const SessionEvent* newest = nullptr;
  for (const SessionEvent& event : events)
    if (event.kind == kFragmentsEvent && event.tick <= last_tick) newest = &event;
  return newest == nullptr ? setup.fragments : fragmentsFrom(newest->text);
}

}  // namespace app
