#include "app/review/preparation_review.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/procedure/preparation/bite_watch.h"
#include "app/procedure/preparation/preparation_picture.h"
#include "app/procedure/root_canal/dense_tooth.h"
#include "assets/tooth.h"

namespace app {
namespace {

using OrderedJson = nlohmann::ordered_json;

double inDegrees(double rad) { return rad * 180.0 / std::numbers::pi; }
OrderedJson orNull(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(); }

constexpr double kToldHigh_um = 5.0;

bool isMolar(int fdi) { return assets::positionOf(fdi) >= 6; }

OrderedJson crownJson(const PreparationOutcomes& of, int fdi) {
  const WallForm& walls = *of.walls;
  const MarginLine& margin = *of.margin;
  return {{"P3_convergence_deg", orNull(inDegrees(walls.convergence_rad))},
          {"P3_mesiodistal_deg", orNull(inDegrees(walls.mesiodistal_rad))},
          {"P3_buccolingual_deg", orNull(inDegrees(walls.buccolingual_rad))},
          {"P3_height_mm", walls.height_mm},
          {"P3_wanted_height_mm", leastHeight_mm(isMolar(fdi))},
          {"P3_height_over_width", walls.height_over_width},
          {"P4_margin_mm", orNull(margin.mean_mm)},
          {"P4_margin_least_mm", orNull(margin.least_mm)},
          {"P4_margin_most_mm", orNull(margin.most_mm)},
          {"P4_margin_waviness_mm", margin.waviness_mm},
          {"P4_margin_missing_share", margin.missing_share},
          {"P4_margin_above_mm", margin.off_height_mm},
          {"P5_undercut_mm3", of.axis->undercut_mm3},
          {"P5_deepest_undercut_mm", of.deepest_undercut_mm},
          {"P5_insertion_off_axis_deg", inDegrees(of.insertion->off_axis_rad)},
          {"P5_insertion_undercut_mm3", of.insertion->undercut_mm3},
          {"P6_roughness_mm", walls.roughness_mm},
          {"P6_sharp_line_angles_share", walls.sharp_share}};
}

OrderedJson cavityJson(const CavityForm& form) {
  return {{"P9_depth_mm", form.depth_mm},
          {"P9_least_depth_mm", form.least_depth_mm},
          {"P9_most_depth_mm", form.most_depth_mm},
          {"P9_isthmus_mm", form.isthmus_mm},
          {"P9_least_isthmus_mm", form.least_isthmus_mm},
          {"P9_length_mm", orNull(form.length_mm)},
          {"P9_divergence_deg", inDegrees(form.divergence_rad)},
          {"P9_box_axial_mm", orNull(form.box_axial_mm)},
          {"P9_box_width_mm", orNull(form.box_width_mm)},
          {"P9_box_height_mm", form.box_height_mm},
          {"P9_unsupported_enamel_mm2", form.unsupported_mm2}};
}

OrderedJson biteJson(const BiteRecord& of) {
  OrderedJson marks = OrderedJson::array();
  for (const BiteRecord::Contact& one : of.contacts)
    marks.push_back({{"where", one.where}, {"area_mm2", one.area_mm2}, {"gap_um", one.gap_um}});
  return {{"paper_um", of.paper_um},
          {"antagonist", of.is_made ? "made" : "scanned"},
          {"closing", of.closing.empty() ? "axis" : of.closing},
          {"balanced", of.is_balanced},
          {"high_spot_um", of.high_um},
          {"first_contact", of.first.empty() ? OrderedJson() : OrderedJson(of.first)},
          {"clearance_um", of.clearance_um ? OrderedJson(*of.clearance_um) : OrderedJson()},
          {"contacts", of.contacts.size()},
          {"mark_area_mm2", of.area_mm2()},
          {"marks", marks}};
}

std::string crownTable(const PreparationOfSession& of) {
  const WallForm& walls = *of.outcomes.walls;
  const MarginLine& margin = *of.outcomes.margin;
  if (!std::isfinite(walls.convergence_rad)) return "no wall is prepared\n";
  std::string text = fmt::format(
      "walls converge by {:.1f}° (wanted {:g} to {:g}; mesial to distal {:.1f}°, cheek to tongue {:.1f}°)\n",
      inDegrees(walls.convergence_rad), kLeastConvergence_deg, kMostConvergence_deg, inDegrees(walls.mesiodistal_rad),
      inDegrees(walls.buccolingual_rad));
  text += fmt::format("height of the walls {:.1f} mm (at least {:g}), over their width {:.2f} (at least {:g})\n",
                      walls.height_mm, leastHeight_mm(isMolar(of.tooth.fdi)), walls.height_over_width,
                      kLeastHeightOverWidth);
  if (std::isfinite(margin.mean_mm))
    text += fmt::format(
        "margin {:.2f} mm wide (wanted {:.2g}; {:.2f} to {:.2f}, waves {:.2f} mm), {:+.2f} mm above the "
        "wanted height\n",
        margin.mean_mm, of.rule.margin_mm, margin.least_mm, margin.most_mm, margin.waviness_mm, margin.off_height_mm);
  if (margin.missing_share > 0.0)
    text += fmt::format("no margin around {:.0f} % of the tooth\n", 100.0 * margin.missing_share);
  text += fmt::format("undercut {:.2f} mm3, at most {:.2f} mm deep{}\n", of.outcomes.axis->undercut_mm3,
                      of.outcomes.deepest_undercut_mm,
                      of.outcomes.insertion->off_axis_rad > 0.0
                          ? fmt::format("; {:.2f} mm3 by a way that leans {:.1f}°", of.outcomes.insertion->undercut_mm3,
                                        inDegrees(of.outcomes.insertion->off_axis_rad))
                          : std::string());
  text += fmt::format("walls are rough by {:.3f} mm; line angles are sharp along {:.0f} %\n", walls.roughness_mm,
                      100.0 * walls.sharp_share);
  return text;
}

OrderedJson fillingJson(const FillingOutcomes& of) {
  OrderedJson materials = OrderedJson::object(), increments = OrderedJson::array(), voids = OrderedJson::array();
  for (std::size_t tissue = 0; tissue < of.laid_of_mm3.size(); ++tissue)
    if (of.laid_of_mm3[tissue] > 0.0) materials[std::string(assets::kTissues[tissue].key)] = of.laid_of_mm3[tissue];
  for (const Increment& one : of.increments)
    increments.push_back({{"number", one.number},
                          {"laid_mm3", one.laid_mm3},
                          {"depth_mm", one.depth_mm},
                          {"cured_share", one.cured_share},
                          {"too_deep", one.isTooDeep()}});
  for (const EnclosedAir& one : of.voids)
    voids.push_back(
        {{"mm3", one.volume_mm3}, {"middle_P_mm", {one.middle_P_mm.x, one.middle_P_mm.y, one.middle_P_mm.z}}});
  return {{"F1_laid_mm3", of.laid_mm3},
          {"F1_materials_mm3", materials},
          {"F2_cavity_mm3", of.cavity_mm3},
          {"F2_filled_share", of.filledShare()},
          {"F3_voids", voids},
          {"F4_overhang_mm3", of.overhang_mm3},
          {"F4_overhang_mm", of.overhang_mm},
          {"F5_contour_rms_mm", of.contour_rms_mm},
          {"F5_contour_mean_mm", of.contour_mean_mm},
          {"F5_too_high_mm", of.too_high_mm},
          {"F5_too_low_mm", of.too_low_mm},
          {"F6_increments", increments},
          {"F7_cured_share", of.curable_mm3 > 0.0 ? OrderedJson(of.curedShare()) : OrderedJson()}};
}

std::string fillingTable(const FillingOutcomes& of) {
  std::string text = fmt::format("\nFilling: {:.2f} mm3 laid, {:.0f} % of a cavity of {:.2f} mm3 filled\n", of.laid_mm3,
                                 100.0 * of.filledShare(), of.cavity_mm3);
  for (std::size_t tissue = 0; tissue < of.laid_of_mm3.size(); ++tissue)
    if (of.laid_of_mm3[tissue] > 0.0)
      text += fmt::format("  {:<22} {:>7.2f} mm3\n", assets::kTissues[tissue].name, of.laid_of_mm3[tissue]);
  if (of.curable_mm3 > 0.0) text += fmt::format("of what light sets {:.0f} % is cured\n", 100.0 * of.curedShare());
  for (const Increment& one : of.increments)
    text += fmt::format(
        "increment {}: {:.2f} mm3, {:.2f} mm deep{}\n", one.number, one.laid_mm3, one.depth_mm,
        one.isTooDeep() ? fmt::format(", an error: over {:g} mm before curing", kDeepestIncrement_mm) : std::string());
  text += fmt::format("voids of {:g} mm3 and more: {}", kLeastVoid_mm3, of.voids.size());
  for (const EnclosedAir& one : of.voids) text += fmt::format(", {:.3f} mm3", one.volume_mm3);
  return text + fmt::format(
                    "\noverhang {:.2f} mm3, {:.2f} mm at most; contour {:.2f} mm off the intact tooth (root mean "
                    "square), {:.2f} mm too high and {:.2f} mm too low at most\n",
                    of.overhang_mm3, of.overhang_mm, of.contour_rms_mm, of.too_high_mm, of.too_low_mm);
}

std::string cavityTable(const PreparationOfSession& of) {
  const CavityForm& form = *of.outcomes.cavity;
  if (!form.isCut()) return "no cavity along the fissure\n";
  std::string text = fmt::format(
      "{:.2f} mm deep (wanted {:g}; {:.2f} to {:.2f}), {:.2f} mm wide (wanted {:g}, least {:.2f}), walls diverge by "
      "{:+.1f}°\n",
      form.depth_mm, of.rule.depth_mm, form.least_depth_mm, form.most_depth_mm, form.isthmus_mm, of.rule.isthmus_mm,
      form.least_isthmus_mm, inDegrees(form.divergence_rad));
  if (of.rule.box_side != 0)
    text += std::isfinite(form.box_axial_mm) && form.box_axial_mm > 0.0
                ? fmt::format(
                      "box {:.2f} mm deep (wanted {:g}), {:.2f} mm wide (wanted {:g}), its floor {:.2f} mm over "
                      "the cervical line (wanted {:g})\n",
                      form.box_axial_mm, of.rule.box_axial_mm, form.box_width_mm, of.rule.box_mm, form.box_height_mm,
                      of.rule.box_height_mm)
                : std::string("no box\n");
  return text + fmt::format("{:.1f} mm2 of cut enamel with no dentine behind it\n", form.unsupported_mm2);
}

}  // namespace

std::optional<PreparationOfSession> preparationOfSession(SessionReader& session, const StoredStart& start,
                                                         const BoneLeft& left) {
  if (!start.setup.prepared) return {};
  PreparationOfSession of{*start.setup.prepared, {}, {}, {}, {}, {}};
  for (const SessionEvent& event : session.events())
    if (event.kind == kBiteEvent)
      if (auto bite = biteFrom(event.text)) of.bites.push_back(std::move(*bite));
  const ToothBlocks before(DenseTooth(start.grid, start.whole.empty() ? start.solid : start.whole, start.label));
  PreparationMeasure measure(Crown(before, of.tooth.frame), of.tooth, "--ideal");
  of.rule = measure.rule();
  const std::optional<haptics::Filling::Volumes>& filling = left.laid;
  const BoxBytes made(DenseSolid(start.grid, left.solid), measure.crown().solid.grid());
  of.outcomes = measure.outcomesOf(made);
  if (filling) of.outcomes.filling = measure.fillingOf(made, laidBoxes(*filling, start.grid, made.grid()));
  of.picture = preparationPicture(measure, made, of.outcomes);
  const double paper_um = of.bites.empty() ? kUsualPaper_um : of.bites.back().paper_um;
  const BoxBytes bitten = filling ? filledTooth(made, *filling, start.grid) : made;
  of.bite = recordOf(BittenTooth(measure.crown(), of.tooth).bitten(bitten, 0.001 * paper_um).bite, 0.0);
  return of;
}

std::optional<PreparationOfSession> preparationOfSession(const std::string& path) {
  SessionReader session(path);
  if (!session.about().setup.prepared) return {};
  const StoredStart start = session.start();
  auto end = session.finalBone(start);
  if (!end) return {};
  return preparationOfSession(session, start, {std::move(end->solid), session.finalFilling(start), {}, {}, {}});
}

std::string preparationJson(const PreparationOfSession& of) {
  const RemovedMaterial& removed = of.outcomes.removed;
  const Deviation& deviation = of.outcomes.deviation;
  OrderedJson zones = OrderedJson::object();
  for (std::size_t n = 0; n < kPreparedZones; ++n)
    zones[std::string(nameOf(static_cast<PreparedZone>(n)))] = {{"over_mm3", removed.zones[n].over_mm3},
                                                                {"under_mm3", removed.zones[n].under_mm3}};
  OrderedJson within = OrderedJson::object();
  for (std::size_t n = 0; n < kTolerances_mm.size(); ++n)
    within[fmt::format("{:g}", kTolerances_mm[n])] = deviation.within[n];
  OrderedJson json = {{"fdi", of.tooth.fdi},
                      {"ideal", of.tooth.ideal},
                      {"P1_over_mm3", removed.over_mm3()},
                      {"P1_under_mm3", removed.under_mm3()},
                      {"P1_wanted_mm3", removed.wanted_mm3},
                      {"P1_zones", zones},
                      {"P2_mean_mm", deviation.mean_mm},
                      {"P2_rms_mm", deviation.rms_mm},
                      {"P2_too_high_mm", deviation.most_left_mm},
                      {"P2_too_deep_mm", deviation.deepest_mm},
                      {"P7_neighbour_mm3", removed.neighbour_mm3},
                      {"P8_within_mm", within},
                      {"enamel_mm3", removed.enamel_mm3},
                      {"dentine_mm3", removed.dentine_mm3},
                      {"pulp_open_mm2", removed.pulp_open_mm2}};
  if (of.tooth.given) json["ideal_sha256"] = of.tooth.given->digest;
  if (of.tooth.opposing && !of.tooth.opposing->digest.empty()) json["antagonist_sha256"] = of.tooth.opposing->digest;
  if (const auto& caries = of.outcomes.caries)
    json["caries"] = {{"place", of.tooth.caries.empty() ? OrderedJson() : OrderedJson(of.tooth.caries)},
                      {"soft_mm3", caries->soft_before_mm3},
                      {"firm_mm3", caries->firm_before_mm3},
                      {"soft_left_mm3", caries->soft_left_mm3},
                      {"firm_left_mm3", caries->firm_left_mm3},
                      {"sound_cut_mm3", caries->sound_cut_mm3},
                      {"least_over_pulp_mm", orNull(caries->least_over_pulp_mm)},
                      {"pulp_open_mm2", removed.pulp_open_mm2}};
  if (of.outcomes.filling) json["filling"] = fillingJson(*of.outcomes.filling);
  json["bite"] = biteJson(of.bite);
  json["bites"] = OrderedJson::array();
  for (const BiteRecord& one : of.bites) {
    OrderedJson bite = {{"t_s", one.t_s}};
    bite.update(biteJson(one));
    json["bites"].push_back(std::move(bite));
  }
  if (of.outcomes.cavity) json.update(cavityJson(*of.outcomes.cavity));
  if (of.outcomes.walls) json.update(crownJson(of.outcomes, of.tooth.fdi));
  return json.dump();
}

std::string preparationTable(const PreparationOfSession& of) {
  const RemovedMaterial& removed = of.outcomes.removed;
  const Deviation& deviation = of.outcomes.deviation;
  std::string text = fmt::format("\nPreparation of tooth {}: {}\n", of.tooth.fdi, of.rule.for_people);
  text += fmt::format("cut too much {:.1f} mm3, left too much {:.1f} mm3, of {:.1f} to be cut\n", removed.over_mm3(),
                      removed.under_mm3(), removed.wanted_mm3);
  for (std::size_t n = 0; n < kPreparedZones; ++n)
    text += fmt::format("  {:<9} {:>6.1f} mm3 too much, {:>6.1f} mm3 left\n", nameOf(static_cast<PreparedZone>(n)),
                        removed.zones[n].over_mm3, removed.zones[n].under_mm3);
  if (of.outcomes.cavity) text += cavityTable(of);
  if (of.outcomes.walls) text += crownTable(of);
  text += fmt::format("surface {:.2f} mm off (root mean square), {:.2f} mm too high and {:.2f} mm too deep at most; ",
                      deviation.rms_mm, deviation.most_left_mm, deviation.deepest_mm);
  text += fmt::format("{:.0f} % of it within 0.2 mm\n", 100.0 * deviation.within[1]);
  text += fmt::format("enamel {:.1f} mm3, dentine {:.1f} mm3; of a neighbour {:.2f} mm3; pulp open {:.2f} mm2\n",
                      removed.enamel_mm3, removed.dentine_mm3, removed.neighbour_mm3, removed.pulp_open_mm2);
  if (const auto& caries = of.outcomes.caries)
    text += fmt::format(
        "caries: soft {:.2f} of {:.2f} mm3 left, firm {:.2f} of {:.2f} mm3 left; sound tissue cut {:.1f} mm3; {}\n",
        caries->soft_left_mm3, caries->soft_before_mm3, caries->firm_left_mm3, caries->firm_before_mm3,
        caries->sound_cut_mm3,
        std::isfinite(caries->least_over_pulp_mm) ? fmt::format("{:.2f} mm over the pulp", caries->least_over_pulp_mm)
                                                  : std::string("the way to the pulp is not known"));
  if (of.outcomes.filling) text += fillingTable(*of.outcomes.filling);
  return text + "bite as it was left: " + biteInWords(of.bite) + "\n";
}

std::string biteInWords(const BiteRecord& of) {
  std::string text = fmt::format("{:g} µm paper{}{}: ", of.paper_um, of.is_made ? " on a made antagonist" : "",
                                 of.closing == "hinge" ? ", closing about the hinge"
                                 : of.is_balanced      ? ", resting on three contacts"
                                                       : "");
  if (of.high_um >= kToldHigh_um) text += fmt::format("{:.0f} µm too high, {}; ", of.high_um, of.first);
  if (of.contacts.empty())
    return text + (of.clearance_um ? fmt::format("no mark, free by {:.2f} mm", 0.001 * *of.clearance_um)
                                   : std::string("nothing opposes the tooth"));
  text += fmt::format("{} mark{}, {:.2f} mm2:", of.contacts.size(), of.contacts.size() == 1 ? "" : "s", of.area_mm2());
  for (const BiteRecord::Contact& one : of.contacts) text += fmt::format(" {} {:.2f}", one.where, one.area_mm2);
  return text;
}

}  // namespace app
