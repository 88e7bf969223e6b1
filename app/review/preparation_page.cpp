#include "app/review/preparation_page.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/report/drawing.h"
#include "app/report/markup.h"
#include "app/review/review_figures.h"
#include "assets/tooth.h"

namespace app {
namespace {

using TableRows = std::vector<std::vector<std::string>>;

std::string millimetres(double value, int digits = 2) {
  return std::isfinite(value) ? fixedText(value, digits) + " mm" : std::string("none");
}
std::string degreesText(double rad) {
  return std::isfinite(rad) ? fixedText(rad * 180.0 / std::numbers::pi, 1) + "°" : std::string("none");
}
std::string cubic(double value) { return fixedText(value, 1) + " mm³"; }

std::string gate(bool is_error, const std::string& question, const std::string& words) {
  return "<div class=\"verdict\">\n" + answerSymbol(is_error) + "<div><b>" + (is_error ? "Yes" : "No") +
         "</b>: " + escaped(question) + (is_error ? "<br><span class=\"quiet\">" + escaped(words) + "</span>" : "") +
         "</div>\n</div>\n";
}

std::string gatesOf(const PreparationOutcomes& of) {
  constexpr double kTouched_mm3 = 0.005, kSoftLeft_mm3 = 0.05;
  return "<div class=\"beside\">\n" +
         gate(of.removed.neighbour_mm3 > kTouched_mm3, "Neighbour cut",
              fixedText(of.removed.neighbour_mm3, 2) + " mm³") +
         gate(of.removed.pulp_open_mm2 > 0.0, "Pulp opened", fixedText(of.removed.pulp_open_mm2, 2) + " mm²") +
         (of.caries ? gate(of.caries->soft_left_mm3 > kSoftLeft_mm3, "Soft caries left",
                           fixedText(of.caries->soft_left_mm3, 2) + " mm³")
                    : std::string()) +
         "</div>\n";
}

std::string crownForm(const PreparationOfSession& of) {
  const WallForm& walls = *of.outcomes.walls;
  const MarginLine& margin = *of.outcomes.margin;
  if (!std::isfinite(walls.convergence_rad)) return "<p>No wall is prepared.</p>\n";
  const bool is_molar = assets::positionOf(of.tooth.fdi) >= 6;
  TableRows rows{
      {"P3 convergence of the walls", degreesText(walls.convergence_rad),
       fmt::format("{:g}° to {:g}°", kLeastConvergence_deg, kMostConvergence_deg)},
      {"from mesial to distal, from cheek to tongue",
       degreesText(walls.mesiodistal_rad) + ", " + degreesText(walls.buccolingual_rad), ""},
      {"height of the walls", millimetres(walls.height_mm, 1),
       fmt::format("at least {:g} mm", leastHeight_mm(is_molar))},
      {"height over width", fixedText(walls.height_over_width, 2), fmt::format("at least {:g}", kLeastHeightOverWidth)},
      {"P4 width of the margin", millimetres(margin.mean_mm), fmt::format("{:.2g} mm", of.rule.margin_mm)},
      {"from, to; waves (standard deviation)",
       millimetres(margin.least_mm) + ", " + millimetres(margin.most_mm) + "; " + millimetres(margin.waviness_mm), ""},
      {"margin above the wanted height", signedText(margin.off_height_mm, 2) + " mm", "0"},
      {"no margin", fixedText(100.0 * margin.missing_share, 0) + " % around the tooth", "0"},
      {"P5 undercut along the tooth's axis",
       fixedText(of.outcomes.axis->undercut_mm3, 2) + " mm³, at most " + millimetres(of.outcomes.deepest_undercut_mm),
       "none deeper than 0.02 mm, the voxels' roughness"},
      {"best way of insertion",
       degreesText(of.outcomes.insertion->off_axis_rad) + " off the axis, " +
           fixedText(of.outcomes.insertion->undercut_mm3, 2) + " mm³",
       ""},
      {"P6 roughness of the walls", millimetres(walls.roughness_mm, 3), ""},
      {"sharp line angles", fixedText(100.0 * walls.sharp_share, 0) + " % around the tooth", "round"}};
  return tableMarkup({"Measure", "made", "wanted"}, rows) +
         "<p class=\"quiet\">Convergence, height and round angles: Goodacre 2001; dentists' own mean is 26.7° (Güth "
         "2013).</p>\n";
}

std::string cavityFormOf(const PreparationOfSession& of) {
  const CavityForm& form = *of.outcomes.cavity;
  if (!form.isCut()) return "<p>No cavity was cut along the fissure.</p>\n";
  TableRows rows{
      {"P9 depth; from, to",
       millimetres(form.depth_mm) + "; " + millimetres(form.least_depth_mm) + ", " + millimetres(form.most_depth_mm),
       millimetres(of.rule.depth_mm, 1)},
      {"isthmus; narrowest", millimetres(form.isthmus_mm) + "; " + millimetres(form.least_isthmus_mm),
       millimetres(of.rule.isthmus_mm, 1)},
      {"length from mesial to distal", millimetres(form.length_mm), ""},
      {"walls diverge towards the bite by", degreesText(form.divergence_rad), "0° or less"},
      {"cut enamel with no dentine within 1.5 mm", fixedText(form.unsupported_mm2, 1) + " mm²", "0"}};
  if (of.rule.box_side != 0) {
    rows.push_back(
        {"box: from the side inwards", millimetres(form.box_axial_mm), millimetres(of.rule.box_axial_mm, 1)});
    rows.push_back({"box: from cheek to tongue", millimetres(form.box_width_mm), millimetres(of.rule.box_mm, 1)});
    rows.push_back({"box: its floor over the cervical line", millimetres(form.box_height_mm),
                    millimetres(of.rule.box_height_mm, 1)});
  }
  return tableMarkup({"Measure", "made", "wanted"}, rows);
}

std::string cariesOf(const CariesOutcome& of) {
  return tableMarkup({"Caries", "before", "left"},
                     {{"soft (infected): to be removed", fixedText(of.soft_before_mm3, 2) + " mm³",
                       fixedText(of.soft_left_mm3, 2) + " mm³"},
                      {"firm (affected): may stay over the pulp", fixedText(of.firm_before_mm3, 2) + " mm³",
                       fixedText(of.firm_left_mm3, 2) + " mm³"}}) +
         "<p>Sound enamel and dentine cut: " + cubic(of.sound_cut_mm3) +
         ". Least between the cut and the pulp: " + millimetres(of.least_over_pulp_mm) + ".</p>\n";
}

std::string againstIdeal(const PreparationOutcomes& of) {
  TableRows rows;
  for (std::size_t n = 0; n < kPreparedZones; ++n)
    rows.push_back({std::string(nameOf(static_cast<PreparedZone>(n))), cubic(of.removed.zones[n].over_mm3),
                    cubic(of.removed.zones[n].under_mm3)});
  rows.push_back({"in all", cubic(of.removed.over_mm3()), cubic(of.removed.under_mm3())});
  std::string within;
  for (std::size_t n = 0; n < kTolerances_mm.size(); ++n)
    within += fmt::format("{}{} % within {:g} mm", within.empty() ? "" : ", ",
                          fixedText(100.0 * of.deviation.within[n], 0), kTolerances_mm[n]);
  return tableMarkup({"P1, of " + cubic(of.removed.wanted_mm3) + " to be cut", "cut too much", "left too much"}, rows) +
         "<p>P2: the surface is " + millimetres(of.deviation.rms_mm) + " off (root mean square), at most " +
         millimetres(of.deviation.most_left_mm) + " too high and " + millimetres(of.deviation.deepest_mm) +
         " too deep (99 % of it). P8: " + within + ".</p>\n";
}

std::string fillingOf(const FillingOutcomes& of) {
  TableRows rows{{"F1 laid", fixedText(of.laid_mm3, 2) + " mm³", ""},
                 {"F2 share of the cavity filled",
                  fixedText(100.0 * of.filledShare(), 0) + " % of " + fixedText(of.cavity_mm3, 2) + " mm³", "100 %"}};
  for (std::size_t tissue = 0; tissue < of.laid_of_mm3.size(); ++tissue)
    if (of.laid_of_mm3[tissue] > 0.0)
      rows.insert(rows.begin() + 1,
                  {std::string(assets::kTissues[tissue].name), fixedText(of.laid_of_mm3[tissue], 2) + " mm³", ""});
  std::string sizes;
  for (const EnclosedAir& one : of.voids)
    sizes += (sizes.empty() ? ": " : ", ") + fixedText(one.volume_mm3, 2) + " mm³";
  rows.push_back(
      {fmt::format("F3 voids of {:g} mm³ and more", kLeastVoid_mm3), std::to_string(of.voids.size()) + sizes, "none"});
  rows.push_back({fmt::format("F4 overhang, more than {:g} mm outside of the intact tooth", kLeastOverhang_mm),
                  fixedText(of.overhang_mm3, 2) + " mm³, " + millimetres(of.overhang_mm), "none"});
  rows.push_back({"F5 contour: off the intact tooth (root mean square)", millimetres(of.contour_rms_mm), "0"});
  rows.push_back(
      {"too high, too low (99 % of it)", millimetres(of.too_high_mm) + ", " + millimetres(of.too_low_mm), "0"});
  for (const Increment& one : of.increments)
    rows.push_back({fmt::format("F6 increment {}", one.number),
                    fixedText(one.laid_mm3, 2) + " mm³, " + millimetres(one.depth_mm) + " deep" +
                        (one.is_cured_by_light ? ", " + fixedText(100.0 * one.cured_share, 0) + " % cured" : ""),
                    one.is_cured_by_light ? fmt::format("at most {:g} mm before curing", kDeepestIncrement_mm) : ""});
  if (of.curable_mm3 > 0.0)
    rows.push_back({"F7 cured, of what light sets", fixedText(100.0 * of.curedShare(), 0) + " %", "100 %"});
  bool is_too_deep = false;
  for (const Increment& one : of.increments) is_too_deep = is_too_deep || one.isTooDeep();
  return "<div class=\"beside\">\n" + gate(is_too_deep, "An increment over 2 mm before curing", "light reaches 2 mm") +
         gate(!of.voids.empty(), "Voids", sizes.empty() ? sizes : sizes.substr(2)) + "</div>\n" +
         tableMarkup({"Measure", "made", "wanted"}, rows);
}

std::string pictureOf(const PreparationOfSession& of) {
  const render::Image& picture = of.picture;
  if (picture.w == 0) return "";
  const glm::dvec2 size(picture.w, picture.h);
  Drawing drawing(size);
  drawing.image(picture, glm::dvec2(0.0), size);
  return figureMarkup(drawing.markup("the preparation from five sides in colours of its deviation, and two sections"),
                      "Coloured by the distance to the ideal: blue is cut too deep, red is left too high.");
}

std::string biteOf(const PreparationOfSession& of) {
  const BiteRecord& bite = of.bite;
  TableRows rows;
  for (const BiteRecord::Contact& one : bite.contacts)
    rows.push_back({one.where, fixedText(one.area_mm2, 2) + " mm²", fixedText(one.gap_um, 0) + " µm"});
  std::string text = "<p>" + escaped(fmt::format("On paper of {:g} µm, on the tooth as it was left: ", bite.paper_um));
  if (bite.high_um > 0.0)
    text += escaped(fmt::format("it keeps the jaws {:.0f} µm open and touches first {}. ", bite.high_um, bite.first));
  if (rows.empty())
    text += escaped(bite.clearance_um ? fmt::format("no mark; it is free by {:.2f} mm. ", 0.001 * *bite.clearance_um)
                                      : std::string("nothing opposes it. "));
  if (bite.closing == "hinge") text += "The jaws close about the hinge of the condyles. ";
  if (bite.is_balanced) text += "What opposes it rests on three contacts around the middle. ";
  if (bite.closing == "balance" && !bite.is_balanced && !rows.empty())
    text += "No three contacts hold what opposes it: it would tip over. ";
  if (bite.is_made) text += "The opposing tooth was made from the tooth's own biting surface, not scanned. ";
  text += "A mark's area tells where teeth meet, not how hard.</p>\n";
  if (!rows.empty()) text += tableMarkup({"mark", "area along the way of closing", "narrowest gap"}, rows);
  if (of.bites.empty()) return text;
  TableRows times;
  for (const BiteRecord& one : of.bites)
    times.push_back({fmt::format("{:.0f} s", one.t_s), fmt::format("{:g} µm", one.paper_um),
                     std::to_string(one.contacts.size()), fixedText(one.area_mm2(), 2) + " mm²",
                     fixedText(one.high_um, 0) + " µm"});
  return text + tableMarkup({"bites", "paper", "marks", "area", "jaws kept open"}, times);
}

}  // namespace

void addPreparation(HtmlPage& page, const PreparationOfSession& of) {
  page.section("Errors", gatesOf(of.outcomes));
  page.section(of.outcomes.walls ? "Walls and margin" : "Form of the cavity",
               "<p>" +
                   escaped(fmt::format("{} ({}), measured against: {}.", assets::toothName(of.tooth.fdi), of.tooth.fdi,
                                       of.rule.for_people)) +
                   "</p>\n" +
                   (of.outcomes.cavity  ? cavityFormOf(of)
                    : of.outcomes.walls ? crownForm(of)
                                        : "<p>The ideal is no crown: walls and margin are not measured.</p>\n"));
  if (of.outcomes.caries) page.section("Caries", cariesOf(*of.outcomes.caries));
  if (of.outcomes.filling) page.section("Filling", fillingOf(*of.outcomes.filling));
  page.section("Against the ideal", againstIdeal(of.outcomes) + pictureOf(of));
  page.section("Bite", biteOf(of));
}

}  // namespace app
