#include "app/review/treatment_text.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/procedure/root_canal/section_picture.h"

namespace app {
namespace {

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

nlohmann::ordered_json numberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json sectionJson(const CanalSection& section) {
  return {{"from_foramen_mm", section.from_foramen_mm},
          {"transportation_mm", numberOrNull(transportation_mm(section))},
          {"centring", numberOrNull(centring(section))}};
}

nlohmann::ordered_json lengthOrNull(const TreatedCanal& canal, double LengthError::*value) {
  return canal.length ? nlohmann::ordered_json((*canal.length).*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json fillingJson(const RootFilling& of) {
  nlohmann::ordered_json voids = nlohmann::ordered_json::array();
  for (const EnclosedAir& one : of.voids) voids.push_back(one.volume_mm3);
  return {{"end_mm", of.end_mm},
          {"length", lengthWord(of)},
          {"filled_share", of.share()},
          {"canal_mm3", of.canal_mm3},
          {"filled_mm3", of.filled_mm3},
          {"voids_mm3", voids},
          {"largest_void_mm3", of.largest_void_mm3},
          {"extruded_mm3", of.extruded_mm3}};
}

nlohmann::ordered_json canalJson(const TreatedCanal& canal) {
  const CanalOutcomes& of = canal.outcomes;
  nlohmann::ordered_json sections = nlohmann::ordered_json::array();
  for (const CanalSection& section : of.sections) sections.push_back(sectionJson(section));
  return {{"name", canal.name},
          {"size", canal.size},
          {"E1_removed_mm3", of.removed_mm3},
          {"E2_E3_sections", sections},
          {"E4_untouched_share", of.untouched},
          {"E5_schneider_before_deg", degrees(of.schneider_before_rad)},
          {"E5_schneider_after_deg", degrees(of.schneider_after_rad)},
          {"E6_least_wall_mm", numberOrNull(of.least_wall_mm)},
          {"E6_thin_share", of.thin_share},
          {"E7_deepest_mm", lengthOrNull(canal, &LengthError::deepest_mm)},
          {"E7_at_rest_mm", lengthOrNull(canal, &LengthError::at_rest_mm)},
          {"E7_most_over_mm", lengthOrNull(canal, &LengthError::most_over_mm)},
          {"E7_over_s", lengthOrNull(canal, &LengthError::over_s)},
          {"E9_apical_long_mm", numberOrNull(of.apical_long_mm)},
          {"E9_apical_short_mm", numberOrNull(of.apical_short_mm)},
          {"E9_taper", numberOrNull(of.taper)},
          {"foramen_moved_mm", of.foramen_moved_mm},
          {"straight_line_deg", degrees(canal.straight_line.least_angle_rad)},
          {"straight_line_blocked_mm3", canal.straight_line.blocked_mm3},
          {"filling", canal.filling ? fillingJson(*canal.filling) : nlohmann::ordered_json()}};
}

}  // namespace

std::string treatmentJson(const TreatmentOfSession& of) {
  const Treatment& all = of.treatment;
  nlohmann::ordered_json canals = nlohmann::ordered_json::array(), holes = nlohmann::ordered_json::array();
  for (const TreatedCanal& canal : all.canals) canals.push_back(canalJson(canal));
  for (const Perforation& hole : all.perforations)
    holes.push_back({{"kind", nameOf(hole.kind)}, {"area_mm2", hole.area_mm2}});
  nlohmann::ordered_json fragments = nlohmann::ordered_json::array();
  for (const PlacedFragment& one : all.fragments)
    fragments.push_back({{"size", one.size},
                         {"metal", one.nickel_titanium ? "nickel-titanium" : "steel"},
                         {"length_mm", one.length_mm},
                         {"canal", one.canal.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(one.canal)},
                         {"tip_from_foramen_mm",
                          one.canal.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(one.from_foramen_mm)}});
  nlohmann::ordered_json motions = nlohmann::ordered_json::object();
  for (std::size_t n = 0; n < kFileMotions; ++n) motions[std::string(keyOf(FileMotion{n}))] = all.motion_s[n];
  const nlohmann::ordered_json json = {{"fdi", of.tooth.fdi},
                                       {"canals_are", of.tooth.is_modelled ? "modelled" : "built-in"},
                                       {"gates",
                                        {{"perforation", !all.perforations.empty()},
                                         {"separated_file", all.broken_files > 0},
                                         {"foramen_moved", all.isForamenMoved()}}},
                                       {"access",
                                        {{"roof_removed_share", all.roof.removed},
                                         {"overhang_mm2", all.roof.overhang_mm2},
                                         {"ideal_mm2", all.outline.ideal_mm2},
                                         {"opened_mm2", all.outline.opened_mm2},
                                         {"too_wide_mm2", all.outline.too_wide_mm2},
                                         {"missing_mm2", all.outline.missing_mm2},
                                         {"enamel_lost_mm3", all.lost.enamel_mm3},
                                         {"dentine_lost_mm3", all.lost.dentine_mm3},
                                         {"floor_gouged_mm3", all.lost.floor_mm3},
                                         {"deepest_below_cusp_mm", all.lost.deepest_mm}}},
                                       {"files",
                                        {{"wear_law", nameOf(of.wear)},
                                         {"filed_mm3", all.filed_mm3},
                                         {"filing_s", all.filing_s},
                                         {"largest_torque_share", all.torque_share},
                                         {"motion_s", motions},
                                         {"flutes_full_s", all.full_s},
                                         {"debris_left_mm3", all.debris_left_mm3},
                                         {"broken", all.broken_files},
                                         {"fragments_left", all.fragments_left},
                                         {"fragments", fragments},
                                         {"bent", all.bent_files}}},
                                       {"perforations", holes},
                                       {"canals", canals}};
  return json.dump();
}

std::string treatmentTable(const TreatmentOfSession& of) {
  const Treatment& all = of.treatment;
  std::string text = fmt::format("\nRoot canals of tooth {}{}\n", of.tooth.fdi,
                                 of.tooth.is_modelled ? ", modelled into the scan" : "");
  text += fmt::format("{:<16} {:>5} {:>9} {:>10} {:>11} {:>11} {:>10} {:>9} {:>10}\n", "canal", "size", "filed mm3",
                      "untouched", "Schneider °", "wall mm", "length mm", "moved mm", "straight °");
  for (const TreatedCanal& canal : all.canals) {
    const CanalOutcomes& one = canal.outcomes;
    text +=
        fmt::format("{:<16} {:>5} {:>9.3f} {:>8.0f} % {:>5.0f} > {:>3.0f} {:>11.2f} {:>+10.1f} {:>+9.2f} {:>10.0f}\n",
                    canal.name, canal.size == 0 ? "-" : std::to_string(canal.size), one.removed_mm3,
                    100.0 * one.untouched, degrees(one.schneider_before_rad), degrees(one.schneider_after_rad),
                    one.least_wall_mm, canal.length ? canal.length->deepest_mm : 0.0,
                    transportation_mm(one.sections.front()), degrees(canal.straight_line.least_angle_rad));
  }
  for (const TreatedCanal& canal : all.canals)
    if (canal.filling)
      text += fmt::format("{}: {}; largest void {:.3f} mm3\n", canal.name, fillingWords(*canal.filling),
                          canal.filling->largest_void_mm3);
  text +=
      "length: of the deepest file, from the working length; moved: at 1 mm from the foramen, towards the "
      "furcation\n";
  text += fmt::format(
      "access: {:.0f} % of the roof removed, {:.1f} mm3 of enamel and {:.1f} mm3 of dentine cut, {:.2f} "
      "mm3 of the floor\n",
      100.0 * all.roof.removed, all.lost.enamel_mm3, all.lost.dentine_mm3, all.lost.floor_mm3);
  text += fmt::format("files: {:.3f} mm3 in {:.0f} s, at most {:.0f} % of the torque that breaks one, {} broken\n",
                      all.filed_mm3, all.filing_s, 100.0 * all.torque_share, all.broken_files);
  if (of.wear != haptics::WearLaw::wear) text += fmt::format("worn by {}, for comparison\n", nameOf(of.wear));
  text +=
      fmt::format("chips: {:.3f} mm3 left in the canals; flutes full for {:.0f} s\n", all.debris_left_mm3, all.full_s);
  if (const std::string motions = motionWords(all); !motions.empty()) text += "moved: " + motions + "\n";
  for (const PlacedFragment& one : all.fragments) text += "fragment: " + inWords(one) + "\n";
  for (const Perforation& hole : all.perforations)
    text += fmt::format("perforation: {}, {:.2f} mm2\n", nameOf(hole.kind), hole.area_mm2);
  if (all.isForamenMoved()) text += "a foramen was moved by more than 0.1 mm\n";
  return text;
}

render::Image treatmentSections(const TreatmentOfSession& of) {
  std::vector<CanalRow> rows;
  for (const TreatedCanal& canal : of.treatment.canals)
    rows.push_back({fmt::format("{} {}, from the foramen", of.tooth.fdi, canal.name), canal.outcomes.sections});
  return sectionPicture(rows);
}

}  // namespace app
