#include "app/session/canals_text.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/session/session_error.h"
#include "assets/tooth.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::size_t kMostCanals = 8, kMostPlaces = 2000, kMostCorners = 64, kMostName = 40;
constexpr double kFarthest_mm = 1e4;

[[noreturn]] void refuse() { throw damagedSession("it has no valid root canals"); }

json three(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

double numberFrom(const json& value, double most = kFarthest_mm) {
  if (!value.is_number() || !(std::abs(value.get<double>()) <= most)) refuse();
  return value.get<double>();
}
const json& member(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end()) refuse();
  return *found;
}
double numberFrom(const json& object, const char* key) { return numberFrom(member(object, key)); }
const json& listFrom(const json& object, const char* key, std::size_t least, std::size_t most) {
  const json& list = member(object, key);
  if (!list.is_array() || list.size() < least || list.size() > most) refuse();
  return list;
}
glm::dvec3 threeFrom(const json& value) {
  if (!value.is_array() || value.size() != 3) refuse();
  return {numberFrom(value[0]), numberFrom(value[1]), numberFrom(value[2])};
}
glm::dvec3 threeFrom(const json& object, const char* key) { return threeFrom(member(object, key)); }

json canalJson(const assets::ToothCanal& canal) {
  json places = json::array();
  for (const assets::CanalPlace& place : canal.places)
    places.push_back({place.p_P_mm.x, place.p_P_mm.y, place.p_P_mm.z, place.along_mm, place.narrow_mm, place.wide_mm});
  json one = {{"name", canal.name},
              {"schneider_rad", canal.schneider_rad},
              {"constriction_mm", canal.constriction_mm},
              {"apex_P_mm", three(canal.apex_P_mm)},
              {"reference_P_mm", three(canal.reference_P_mm)},
              {"places", std::move(places)}};
  if (canal.joins) one["joins"] = *canal.joins;
  return one;
}

assets::ToothCanal canalFrom(const json& object, std::size_t canals) {
  assets::ToothCanal canal;
  const json& name = member(object, "name");
  if (!name.is_string() || name.get_ref<const std::string&>().size() > kMostName) refuse();
  canal.name = name.get<std::string>();
  canal.schneider_rad = numberFrom(object, "schneider_rad");
  canal.constriction_mm = numberFrom(object, "constriction_mm");
  canal.apex_P_mm = threeFrom(object, "apex_P_mm");
  canal.reference_P_mm = threeFrom(object, "reference_P_mm");
  for (const json& place : listFrom(object, "places", 2, kMostPlaces)) {
    if (!place.is_array() || place.size() != 6) refuse();
    assets::CanalPlace one{{numberFrom(place[0]), numberFrom(place[1]), numberFrom(place[2])},
                           numberFrom(place[3]),
                           numberFrom(place[4]),
                           numberFrom(place[5])};
    const bool rises = canal.places.empty() ? one.along_mm == 0.0 : one.along_mm > canal.places.back().along_mm;
    if (!rises || !(one.narrow_mm > 0.0) || !(one.wide_mm > 0.0)) refuse();
    canal.places.push_back(one);
  }
  if (const auto joins = object.find("joins"); joins != object.end()) {
    if (!joins->is_number_unsigned() || joins->get<std::size_t>() >= canals) refuse();
    canal.joins = joins->get<std::size_t>();
  }
  return canal;
}

json chamberJson(const assets::PulpChamber& chamber) {
  json outline = json::array(), horns = json::array();
  for (const glm::dvec2& p : chamber.outline_mm) outline.push_back({p.x, p.y});
  for (const assets::PulpChamber::Horn& horn : chamber.horns)
    horns.push_back({{"from_mm", three(horn.from_mm)},
                     {"to_mm", three(horn.to_mm)},
                     {"from_radius_mm", horn.from_radius_mm},
                     {"to_radius_mm", horn.to_radius_mm}});
  return {{"outline_mm", std::move(outline)},
          {"round_mm", chamber.round_mm},
          {"roof_mm", chamber.roof_mm},
          {"floor_mm", chamber.floor_mm},
          {"horns", std::move(horns)}};
}

assets::PulpChamber chamberFrom(const json& object) {
  assets::PulpChamber chamber;
  for (const json& p : listFrom(object, "outline_mm", 1, kMostCorners)) {
    if (!p.is_array() || p.size() != 2) refuse();
    chamber.outline_mm.emplace_back(numberFrom(p[0]), numberFrom(p[1]));
  }
  chamber.round_mm = numberFrom(object, "round_mm");
  chamber.roof_mm = numberFrom(object, "roof_mm");
  chamber.floor_mm = numberFrom(object, "floor_mm");
  for (const json& horn : listFrom(object, "horns", 0, kMostCorners))
    chamber.horns.push_back({threeFrom(horn, "from_mm"), threeFrom(horn, "to_mm"), numberFrom(horn, "from_radius_mm"),
                             numberFrom(horn, "to_radius_mm")});
  return chamber;
}

}  // namespace

json canalsJson(const assets::ToothCanals& tooth) {
  json canals = json::array(), axes = json::array();
  for (const assets::ToothCanal& canal : tooth.canals) canals.push_back(canalJson(canal));
  for (int axis = 0; axis < 3; ++axis) axes.push_back(three(tooth.frame.axes_P[axis]));
  return {{"fdi", tooth.fdi},
          {"is_modelled", tooth.is_modelled},
          {"cervix_P_mm", three(tooth.frame.cervix_P_mm)},
          {"axes_P", std::move(axes)},
          {"chamber", chamberJson(tooth.chamber)},
          {"canals", std::move(canals)}};
}

assets::ToothCanals canalsFrom(const json& object) {
  assets::ToothCanals tooth;
  const json& fdi = member(object, "fdi");
  if (!fdi.is_number_integer() || !assets::isToothNumber(fdi.get<int>())) refuse();
  tooth.fdi = fdi.get<int>();
  const json& modelled = member(object, "is_modelled");
  if (!modelled.is_boolean()) refuse();
  tooth.is_modelled = modelled.get<bool>();
  tooth.frame.cervix_P_mm = threeFrom(object, "cervix_P_mm");
  const json& axes = listFrom(object, "axes_P", 3, 3);
  for (int axis = 0; axis < 3; ++axis) {
    tooth.frame.axes_P[axis] = threeFrom(axes[static_cast<std::size_t>(axis)]);
    if (!(std::abs(glm::length(tooth.frame.axes_P[axis]) - 1.0) < 1e-3)) refuse();
  }
  tooth.chamber = chamberFrom(member(object, "chamber"));
  const json& canals = listFrom(object, "canals", 1, kMostCanals);
  for (const json& canal : canals) tooth.canals.push_back(canalFrom(canal, canals.size()));
  return tooth;
}

}  // namespace app
