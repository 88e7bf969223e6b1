#include "app/review/treatment_page.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/core.h>

#include "app/report/markup.h"
#include "app/review/review_figures.h"
#include "app/review/treatment_figures.h"
#include "assets/tooth.h"

namespace app {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string angleWords(double rad) { return fixedText(rad * 180.0 / std::numbers::pi, 0) + "°"; }

std::string lengthText(double value, int digits = 2) {
  return std::isfinite(value) ? fixedText(value, digits) + " mm" : std::string("not found");
}

std::string verdict(bool is_error, const std::string& question, const std::string& words) {
  return "<div class=\"verdict\">\n" + answerSymbol(is_error) + "<div><b>" + (is_error ? "Yes" : "No") +
         "</b>: " + escaped(question) +
         (words.empty() ? "" : "<br><span class=\"quiet\">" + escaped(words) + "</span>") + "</div>\n</div>\n";
}

std::string gates(const Treatment& all) {
  std::string holes, moved, separated;
  if (all.broken_files > 0 || all.fragments_left > 0)
    separated = fmt::format("{} in this session, {} in the tooth at the end", all.broken_files, all.fragments_left);
  for (const PlacedFragment& one : all.fragments) separated += "; " + inWords(one);
  for (const Perforation& hole : all.perforations)
    holes += fmt::format("{}{}, {} mm²", holes.empty() ? "" : "; ", nameOf(hole.kind), fixedText(hole.area_mm2, 2));
  for (const TreatedCanal& canal : all.canals)
    if (canal.outcomes.foramen_moved_mm > kForamenMoved_mm)
      moved += fmt::format("{}{} canal, {}", moved.empty() ? "" : "; ", canal.name,
                           lengthText(canal.outcomes.foramen_moved_mm));
  return "<div class=\"beside\">\n" + verdict(!holes.empty(), "Root or chamber perforated", holes) +
         verdict(all.broken_files > 0, "File separated", separated) +
         verdict(all.isForamenMoved(), "Foramen transported", moved) + "</div>\n" +
         fmt::format("<p class=\"quiet\">A foramen counts as transported from {} on.</p>\n",
                     lengthText(kForamenMoved_mm, 1));
}

std::string canalsOf(const assets::ToothCanals& tooth) {
  Rows rows;
  for (const assets::ToothCanal& canal : tooth.canals)
    rows.push_back({canal.name, lengthText(canal.workingLength_mm(), 1), angleWords(canal.schneider_rad),
                    lengthText(canal.smallestWidth_mm()),
                    canal.joins ? "joins the " + tooth.canals[*canal.joins].name + " canal" : "a foramen of its own"});
  const std::string of = tooth.is_modelled ? "modelled by rule into the scan, which does not show them"
                                           : "of the built-in tooth, as they were made";
  return "<p>" + escaped(fmt::format("{} ({}); canals {}.", assets::toothName(tooth.fdi), tooth.fdi, of)) + "</p>\n" +
         tableMarkup({"Canal", "working length", "Schneider", "narrowest", ""}, rows);
}

std::string depthWords(const LostTissue& lost) {
  if (!(lost.deepest_mm > 0.0)) return "nothing was cut";
  const DepthBand band = depthBand(lost.deepest_mm);
  return lengthText(lost.deepest_mm, 1) + (band == DepthBand::fine    ? ""
                                           : band == DepthBand::amber ? ": below the usual roof"
                                                                      : ": below the usual floor");
}

std::string access(const Treatment& all) {
  const auto& [roof, outline, lost] = std::tie(all.roof, all.outline, all.lost);
  Rows rows{
      {"roof of the chamber removed", fixedText(100.0 * roof.removed, 0) + " %"},
      {"overhang left", fixedText(roof.overhang_mm2, 2) + " mm², " + fixedText(roof.overhang_mm3, 2) + " mm³"},
      {"outline opened, ideal", fixedText(outline.opened_mm2, 1) + " mm², " + fixedText(outline.ideal_mm2, 1) + " mm²"},
      {"too wide, missing", fixedText(outline.too_wide_mm2, 1) + " mm², " + fixedText(outline.missing_mm2, 1) + " mm²"},
      {"enamel, dentine cut", fixedText(lost.enamel_mm3, 1) + " mm³, " + fixedText(lost.dentine_mm3, 1) + " mm³"},
      {"floor gouged", fixedText(lost.floor_mm3, 2) + " mm³"},
      {"deepest cut below the cusp", depthWords(lost)}};
  for (const TreatedCanal& canal : all.canals)
    rows.push_back({"straight-line access, " + canal.name,
                    std::string(canal.straight_line.isFree() ? "yes, " : "no, ") +
                        angleWords(canal.straight_line.least_angle_rad) + "; " +
                        fixedText(canal.straight_line.blocked_mm3, 2) + " mm³ of tooth in the way"});
  return tableMarkup({}, rows);
}

std::string lengthWords(const TreatedCanal& canal) {
  if (!canal.length) return "no file was in it";
  std::string words = signedText(canal.length->deepest_mm, 1) + " mm";
  if (canal.length->most_over_mm > 0.0)
    words += fmt::format(", {} beyond the foramen for {} s", lengthText(canal.length->most_over_mm, 1),
                         fixedText(canal.length->over_s, 1));
  return words;
}

/// A row a measure, a column a canal.
std::string canals(const Treatment& all) {
  std::vector<std::string> heads{"Measure"};
  Rows rows;
  for (const TreatedCanal& canal : all.canals) heads.push_back(canal.name);
  const auto row = [&](const std::string& name, const auto& words) {
    rows.push_back({name});
    for (const TreatedCanal& canal : all.canals) rows.back().push_back(words(canal));
  };
  row("largest file at length", [](const TreatedCanal& canal) {
    return canal.size == 0 ? std::string("none") : "#" + std::to_string(canal.size);
  });
  row("E1 dentine filed", [](const TreatedCanal& canal) { return fixedText(canal.outcomes.removed_mm3, 3) + " mm³"; });
  for (std::size_t n = 0; n < kSections_mm.size(); ++n)
    row(fmt::format("E2, E3 moved, centring at {:g} mm", kSections_mm[n]), [n](const TreatedCanal& canal) {
      const CanalSection& section = canal.outcomes.sections[n];
      return signedText(transportation_mm(section), 3) + " mm, " + fixedText(centring(section), 2);
    });
  row("E4 wall untouched",
      [](const TreatedCanal& canal) { return fixedText(100.0 * canal.outcomes.untouched, 0) + " %"; });
  row("E5 Schneider before, after", [](const TreatedCanal& canal) {
    return angleWords(canal.outcomes.schneider_before_rad) + ", " + angleWords(canal.outcomes.schneider_after_rad);
  });
  row("E6 least dentine", [](const TreatedCanal& canal) {
    const double least_mm = canal.outcomes.least_wall_mm;
    return lengthText(least_mm) + (least_mm < kThinWall_mm ? ": thin" : "");
  });
  row("wall thinner than 0.5 mm",
      [](const TreatedCanal& canal) { return fixedText(100.0 * canal.outcomes.thin_share, 0) + " %"; });
  row("E7 deepest file, from the working length", lengthWords);
  row("E9 apical diameters", [](const TreatedCanal& canal) {
    return fixedText(canal.outcomes.apical_long_mm, 2) + ", " + lengthText(canal.outcomes.apical_short_mm);
  });
  row("E9 taper", [](const TreatedCanal& canal) { return fixedText(canal.outcomes.taper, 3) + " mm/mm"; });
  row("foramen's wall moved", [](const TreatedCanal& canal) { return lengthText(canal.outcomes.foramen_moved_mm); });
  return tableMarkup(heads, rows) +
         "<p class=\"quiet\">Moved: towards the furcation positive (Gambill 1996). Centring: 1 is even on both sides, "
         "0 on one side only. Least dentine: from 2 mm above the foramen. Untouched, in extracted upper molars after "
         "rotary and hand files: 35 % and more (Peters 2001).</p>\n";
}

/// Empty: nothing was laid.
std::string rootFillings(const Treatment& all) {
  Rows rows;
  for (const TreatedCanal& canal : all.canals) {
    if (!canal.filling) {
      rows.push_back({canal.name, "not filled", "", "", ""});
      continue;
    }
    const RootFilling& of = *canal.filling;
    const std::string length = lengthWord(of);
    rows.push_back({canal.name, signedText(of.end_mm, 1) + " mm" + (length == "right" ? "" : ": " + length),
                    fmt::format("{} % of {} mm³", fixedText(100.0 * of.share(), 0), fixedText(of.canal_mm3, 2)),
                    fmt::format("{}, largest {} mm³", of.voids.size(), fixedText(of.largest_void_mm3, 3)),
                    fixedText(of.extruded_mm3, 2) + " mm³"});
  }
  if (std::ranges::none_of(all.canals, [](const TreatedCanal& canal) { return canal.filling.has_value(); })) return "";
  return tableMarkup({"Canal", "end, from the working length", "filled to the orifice",
                      fmt::format("voids of {:g} mm³ and more", kLeastVoid_mm3), "beyond the foramen"},
                     rows) +
         fmt::format(
             "<p class=\"quiet\">Right within {:g} mm of the working length. Filled: gutta-percha and sealer alike, "
             "of the canal as it is prepared.</p>\n",
             kRightLength_mm);
}

std::string shapes(const TreatmentOfSession& of) {
  std::string content;
  for (std::size_t n = 0; n < of.treatment.canals.size(); ++n) {
    const TreatedCanal& canal = of.treatment.canals[n];
    content += "<h3>" + escaped(fmt::format("{} canal", canal.name)) + "</h3>\n";
    content +=
        figureMarkup(sectionsFigure(canal),
                     "Sections, seen towards the apex, the furcation to the right: above the root, below the "
                     "canal four times as large. Blue, dashed: as it was; orange: as it is; rose: what was laid.");
    content +=
        figureMarkup(axisFigure(of.tooth, n, canal.outcomes),
                     escaped(fmt::format("The canal and its axis, to scale. Blue, dashed: as it was, {}; orange: "
                                         "as it is, {} by Schneider.",
                                         angleWords(canal.outcomes.schneider_before_rad),
                                         angleWords(canal.outcomes.schneider_after_rad))));
  }
  return content;
}

std::string films(const TreatmentFilms& films) {
  std::string content;
  for (const FilmPair& pair : films.pairs) {
    const std::string tube = pair.shift_deg == 0.0 ? std::string("parallel")
                                                   : fmt::format("tube {:g}° to {}", std::abs(pair.shift_deg),
                                                                 pair.shift_deg > 0.0 ? "mesial" : "distal");
    content += figureMarkup(filmsFigure(pair), escaped(tube + ": before, after"));
  }
  if (content.empty()) return "";
  return content + "<p class=\"quiet\">" +
         (films.in_jaw ? "The tooth as the session left it, within the jaw. "
                       : "The treated volume alone: the jaw around it was not named. ") +
         "Attenuations are ratios, no dose is modelled.</p>\n";
}

std::string files(const Treatment& all, haptics::WearLaw wear) {
  const std::string motions = motionWords(all);
  return tableMarkup({}, {{"law of wear", std::string(nameOf(wear))},
                          {"dentine filed", fixedText(all.filed_mm3, 3) + " mm³"},
                          {"time against the wall", fixedText(all.filing_s, 0) + " s"},
                          {"moved, share of that time", motions.empty() ? "hardly" : motions},
                          {"with full flutes", fixedText(all.full_s, 0) + " s"},
                          {"chips left in the canals", fixedText(all.debris_left_mm3, 3) + " mm³"},
                          {"largest torque", fixedText(100.0 * all.torque_share, 0) + " % of what breaks a file"},
                          {"separated, bent", fmt::format("{}, {}", all.broken_files, all.bent_files)}});
}

}  // namespace

void addTreatment(HtmlPage& page, const TreatmentReview& review, bool is_confirmed) {
  const Treatment& all = review.of.treatment;
  const auto marked = [is_confirmed](const std::string& content_markup) {
    return is_confirmed || content_markup.empty()
               ? content_markup
               : "<div class=\"unconfirmed\">\n<p>Not confirmed.</p>\n" + content_markup + "</div>\n";
  };
  page.section("Errors", marked(gates(all)));
  page.section("Tooth and canals", marked(canalsOf(review.of.tooth)));
  page.section("Access cavity", marked(access(all)));
  page.section("Canals", marked(canals(all)));
  if (const std::string filled = rootFillings(all); !filled.empty()) page.section("Root filling", marked(filled));
  page.section("Shape of each canal", shapes(review.of));
  page.section("Radiographs", films(review.films));
  page.section("Files", files(all, review.of.wear));
}

}  // namespace app
