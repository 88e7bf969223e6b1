#include "app/session/canals_text.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/session/session_error.h"
#include "assets/json_depth.h"
#include "assets/tooth.h"

namespace app {
namespace {

using CanalJson = nlohmann::json;

constexpr std::size_t kMostCanals = 8, kMostPlaces = 2000, kMostCorners = 64, kMostName = 40;
constexpr double kFarthestCanal_mm = 1e4;

[[noreturn]] void refuseCanals() { throw damagedSession("it has no valid root canals"); }

CanalJson three(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

double numberFrom(const CanalJson& value, double most = kFarthestCanal_mm) {
  if (!value.is_number() || !(std::abs(value.get<double>()) <= most)) refuseCanals();
  return value.get<double>();
}
const CanalJson& memberOf(const CanalJson& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end()) refuseCanals();
  return *found;
}
double numberFrom(const CanalJson& object, const char* key) { return numberFrom(memberOf(object, key)); }
const CanalJson& listFrom(const CanalJson& object, const char* key, std::size_t least, std::size_t most) {
  const CanalJson& list = memberOf(object, key);
  if (!list.is_array() || list.size() < least || list.size() > most) refuseCanals();
  return list;
}
glm::dvec3 threeFrom(const CanalJson& value) {
  if (!value.is_array() || value.size() != 3) refuseCanals();
  return {numberFrom(value[0]), numberFrom(value[1]), numberFrom(value[2])};
}
glm::dvec3 threeFrom(const CanalJson& object, const char* key) { return threeFrom(memberOf(object, key)); }

CanalJson canalJson(const assets::ToothCanal& canal) {
  CanalJson places = CanalJson::array();
  for (const assets::CanalPlace& place : canal.places)
    places.push_back({place.p_P_mm.x, place.p_P_mm.y, place.p_P_mm.z, place.along_mm, place.narrow_mm, place.wide_mm});
  CanalJson one = {{"name", canal.name},
                   {"schneider_rad", canal.schneider_rad},
                   {"constriction_mm", canal.constriction_mm},
                   {"apex_P_mm", three(canal.apex_P_mm)},
                   {"reference_P_mm", three(canal.reference_P_mm)},
                   {"places", std::move(places)}};
  if (canal.joins) one["joins"] = *canal.joins;
  return one;
}

assets::ToothCanal canalFrom(const CanalJson& object, std::size_t canals) {
  assets::ToothCanal canal;
  const CanalJson& name = memberOf(object, "name");
  if (!name.is_string() || name.get_ref<const std::string&>().size() > kMostName) refuseCanals();
  canal.name = name.get<std::string>();
  canal.schneider_rad = numberFrom(object, "schneider_rad");
  canal.constriction_mm = numberFrom(object, "constriction_mm");
  canal.apex_P_mm = threeFrom(object, "apex_P_mm");
  canal.reference_P_mm = threeFrom(object, "reference_P_mm");
  for (const CanalJson& place : listFrom(object, "places", 2, kMostPlaces)) {
    if (!place.is_array() || place.size() != 6) refuseCanals();
    assets::CanalPlace one{{numberFrom(place[0]), numberFrom(place[1]), numberFrom(place[2])},
                           numberFrom(place[3]),
                           numberFrom(place[4]),
                           numberFrom(place[5])};
    const bool rises = canal.places.empty() ? one.along_mm == 0.0 : one.along_mm > canal.places.back().along_mm;
    if (!rises || !(one.narrow_mm > 0.0) || !(one.wide_mm > 0.0)) refuseCanals();
    canal.places.push_back(one);
  }
  if (const auto joins = object.find("joins"); joins != object.end()) {
    if (!joins->is_number_unsigned() || joins->get<std::size_t>() >= canals) refuseCanals();
    canal.joins = joins->get<std::size_t>();
  }
  return canal;
}

CanalJson chamberJson(const assets::PulpChamber& chamber) {
  CanalJson outline = CanalJson::array(), horns = CanalJson::array();
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

assets::PulpChamber chamberFrom(const CanalJson& object) {
  assets::PulpChamber chamber;
  for (const CanalJson& p : listFrom(object, "outline_mm", 1, kMostCorners)) {
    if (!p.is_array() || p.size() != 2) refuseCanals();
    chamber.outline_mm.emplace_back(numberFrom(p[0]), numberFrom(p[1]));
  }
  chamber.round_mm = numberFrom(object, "round_mm");
  chamber.roof_mm = numberFrom(object, "roof_mm");
  chamber.floor_mm = numberFrom(object, "floor_mm");
  for (const CanalJson& horn : listFrom(object, "horns", 0, kMostCorners))
    chamber.horns.push_back({threeFrom(horn, "from_mm"), threeFrom(horn, "to_mm"), numberFrom(horn, "from_radius_mm"),
                             numberFrom(horn, "to_radius_mm")});
  return chamber;
}

}  // namespace

std::string canalsText(const assets::ToothCanals& tooth) {
  CanalJson canals = CanalJson::array(), axes = CanalJson::array();
  for (const assets::ToothCanal& canal : tooth.canals) canals.push_back(canalJson(canal));
  for (int axis = 0; axis < 3; ++axis) axes.push_back(three(tooth.frame.axes_P[axis]));
  const CanalJson object = {{"fdi", tooth.fdi},
                            {"is_modelled", tooth.is_modelled},
                            {"cervix_P_mm", three(tooth.frame.cervix_P_mm)},
                            {"axes_P", std::move(axes)},
                            {"chamber", chamberJson(tooth.chamber)},
                            {"canals", std::move(canals)}};
  return object.dump();
}

assets::ToothCanals canalsFrom(std::string_view text) {
  const CanalJson object = assets::isNestedTooDeep(text) ? CanalJson() : CanalJson::parse(text, nullptr, false);
  if (!object.is_object()) refuseCanals();
  assets::ToothCanals tooth;
  const CanalJson& fdi = memberOf(object, "fdi");
  if (!fdi.is_number_integer() || !assets::isToothNumber(fdi.get<int>())) refuseCanals();
  tooth.fdi = fdi.get<int>();
  const CanalJson& modelled = memberOf(object, "is_modelled");
  if (!modelled.is_boolean()) refuseCanals();
  tooth.is_modelled = modelled.get<bool>();
  tooth.frame.cervix_P_mm = threeFrom(object, "cervix_P_mm");
  const CanalJson& axes = listFrom(object, "axes_P", 3, 3);
  for (int axis = 0; axis < 3; ++axis) {
    tooth.frame.axes_P[axis] = threeFrom(axes[static_cast<std::size_t>(axis)]);
    if (!(std::abs(glm::length(tooth.frame.axes_P[axis]) - 1.0) < 1e-3)) refuseCanals();
  }
  tooth.chamber = chamberFrom(memberOf(object, "chamber"));
  const CanalJson& canals = listFrom(object, "canals", 1, kMostCanals);
  for (const CanalJson& canal : canals) tooth.canals.push_back(canalFrom(canal, canals.size()));
  return tooth;
}

}  // namespace app
