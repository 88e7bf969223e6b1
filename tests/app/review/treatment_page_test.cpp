// What a report tells of a root-canal treatment: its gates plainly, its measures with units, its figures.
#include "app/review/treatment_page.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace app {
namespace {

/// One straight canal of 10 mm, filed evenly from 0.15 to 0.25 mm.
TreatmentReview someTreatment() {
  TreatmentReview review;
  assets::ToothCanals& tooth = review.of.tooth;
  tooth.fdi = 45;
  assets::ToothCanal canal;
  canal.name = "single";
  for (int n = 0; n <= 10; ++n) canal.places.push_back({{0.0, 0.0, -1.0 * n}, 1.0 * n, 0.15, 0.15});
  canal.reference_P_mm = {0.0, 0.0, 7.0};
  tooth.canals.push_back(canal);
  TreatedCanal treated;
  treated.name = "single";
  treated.size = 25;
  for (std::size_t n = 0; n < kSections_mm.size(); ++n) {
    CanalSection& section = treated.outcomes.sections[n];
    section.from_foramen_mm = kSections_mm[n];
    section.before_mm.fill(0.15), section.after_mm.fill(0.25), section.root_mm.fill(1.0);
  }
  treated.outcomes.removed_mm3 = 1.234;
  treated.outcomes.untouched = 0.35;
  treated.outcomes.least_wall_mm = 0.42;
  treated.outcomes.axis_before_P_mm = treated.outcomes.axis_after_P_mm = {{0.0, 0.0, 0.0}, {0.0, 0.0, -10.0}};
  treated.length = LengthError{0.0, 0.3, 0.0, 0.0};
  review.of.treatment.canals.push_back(treated);
  return review;
}

std::string pageOf(const TreatmentReview& review) {
  HtmlPage page("A treatment", "");
  addTreatment(page, review);
  return page.text("");
}

bool tells(const std::string& page, std::string_view words) { return page.find(words) != std::string::npos; }

TEST(TreatmentPage, WhatMustNotHappenIsToldFirstAndPlainly) {
  TreatmentReview review = someTreatment();
  const std::string clean = pageOf(review);
  for (const char* gate : {"Root or chamber perforated", "File separated", "Foramen transported"})
    EXPECT_TRUE(tells(clean, std::string("<b>No</b>: ") + gate)) << gate;
  Treatment& all = review.of.treatment;
  all.perforations = {{PerforationKind::strip, 0.456, {}}};
  all.broken_files = 2;
  all.fragments_left = 1;
  all.fragments = {{20, false, 3.14, "single", 2.36}};
  all.canals[0].outcomes.foramen_moved_mm = 0.15;
  const std::string page = pageOf(review);
  EXPECT_TRUE(tells(page, "<b>Yes</b>: Root or chamber perforated<br><span class=\"quiet\">strip, 0.46 mm²"));
  EXPECT_TRUE(tells(page,
                    "<b>Yes</b>: File separated<br><span class=\"quiet\">2 in this session, 1 in the tooth at the "
                    "end; 3.1 mm of a #20 in the single canal, its tip 2.4 mm from the foramen"));
  EXPECT_TRUE(tells(page, "<b>Yes</b>: Foramen transported<br><span class=\"quiet\">single canal, 0.15 mm"));
  EXPECT_LT(page.find("Root or chamber perforated"), page.find("Access cavity"));
}

TEST(TreatmentPage, MeasuresHaveTheirUnits) {
  const std::string page = pageOf(someTreatment());
  EXPECT_TRUE(tells(page, "<td>E1 dentine filed</td><td>1.234 mm³</td>"));
  EXPECT_TRUE(tells(page, "<td>E4 wall untouched</td><td>35 %</td>"));
  EXPECT_TRUE(tells(page, "<td>E6 least dentine</td><td>0.42 mm: thin</td>"));
  EXPECT_TRUE(tells(page, "<td>E7 deepest file, from the working length</td><td>+0.3 mm</td>"));
  EXPECT_TRUE(tells(page, "<td>E2, E3 moved, centring at 1 mm</td><td>0.000 mm, 1.00</td>"));
  EXPECT_TRUE(tells(page, "least dentine 0.75 mm")) << "of a section";
}

TEST(TreatmentPage, ARootFillingIsToldWhereThereIsOne) {
  TreatmentReview review = someTreatment();
  EXPECT_FALSE(tells(pageOf(review), "Root filling"));
  RootFilling filling;
  filling.end_mm = -0.8, filling.canal_mm3 = 2.0, filling.filled_mm3 = 1.84;
  filling.voids = {{0.213, {}}}, filling.largest_void_mm3 = 0.213;
  review.of.tooth.canals.push_back(review.of.tooth.canals[0]);
  review.of.treatment.canals.push_back(review.of.treatment.canals[0]);
  review.of.treatment.canals[0].filling = filling;
  review.of.treatment.canals[1].name = "other";
  const std::string page = pageOf(review);
  EXPECT_TRUE(tells(page, "Root filling"));
  EXPECT_TRUE(tells(page,
                    "<td>single</td><td>−0.8 mm: short</td><td>92 % of 2.00 mm³</td><td>1, largest 0.213 mm³</td>"
                    "<td>0.00 mm³</td>"))
      << page;
  EXPECT_TRUE(tells(page, "<td>other</td><td>not filled</td>"));
}

TEST(TreatmentPage, RadiographsAreBesideEachOtherAndSayWhatTheyAreOf) {
  TreatmentReview review = someTreatment();
  EXPECT_FALSE(tells(pageOf(review), "Radiographs"));
  const render::Image film{4, 3, std::vector<std::uint8_t>(48, 200)};
  review.films.pairs = {{0.0, film, film}, {20.0, film, film}};
  const std::string page = pageOf(review);
  EXPECT_TRUE(tells(page, "parallel: before, after"));
  EXPECT_TRUE(tells(page, "tube 20° to mesial: before, after"));
  EXPECT_TRUE(tells(page, "The treated volume alone"));
  std::size_t pictures = 0;
  for (std::size_t at = page.find("data:image/png"); at != std::string::npos; at = page.find("data:image/png", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 4u);
}

/// A tooth of dentine with one canal down its middle, at 0.1 mm.
TEST(TreatmentFilms, ShowThatACanalWasWidened) {
  StoredStart start;
  start.grid = {glm::ivec3(64, 64, 160), 0.1, {0.0, 0.0, 0.0}};
  assets::ToothCanals tooth;
  tooth.fdi = 45;
  start.setup.canals = tooth;
  const auto drilled = [&](double radius_mm) {
    std::vector<std::uint8_t> solid(start.grid.voxelCount());
    assets::forVoxels(start.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double r_mm = 0.1 * std::hypot(ijk.x - 32.0, ijk.y - 32.0);
      solid[v] = r_mm < 2.5 && r_mm > radius_mm ? 255 : 0;
    });
    return solid;
  };
  start.solid = drilled(0.2);
  start.label.assign(start.grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::dentine));
  const TreatmentFilms films = treatmentFilms(start, {drilled(0.8), {}}, nullptr);
  EXPECT_FALSE(films.in_jaw);
  ASSERT_EQ(films.pairs.size(), kTubeShifts_deg.size());
  for (const FilmPair& pair : films.pairs) {
    // The middle of the film is the canal: dark is what lets through.
    const auto grey = [](const render::Image& film) {
      return static_cast<int>(film.rgba[4 * (static_cast<std::size_t>(film.h / 2 * film.w + film.w / 2))]);
    };
    EXPECT_LT(grey(pair.after) + 10, grey(pair.before)) << pair.shift_deg;
  }
  const TreatmentFilms same = treatmentFilms(start, {start.solid, {}}, nullptr);
  EXPECT_EQ(same.pairs[0].before.rgba, same.pairs[0].after.rgba);

  // Gutta-percha in it is lighter than dentine.
  haptics::Filling::Volumes filling;
  filling.laid.assign(start.grid.voxelCount(), 0), filling.tissue = filling.laid;
  assets::forVoxels(start.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (0.1 * std::hypot(ijk.x - 32.0, ijk.y - 32.0) > 0.8) return;
    filling.laid[v] = 255, filling.tissue[v] = static_cast<std::uint8_t>(assets::Tissue::gutta_percha);
  });
  const TreatmentFilms filled = treatmentFilms(start, {drilled(0.8), {}, &filling}, nullptr);
  for (const FilmPair& pair : filled.pairs) {
    const render::Image& film = pair.after;
    const auto at = 4 * static_cast<std::size_t>(film.h / 2 * film.w + film.w / 2);
    EXPECT_GT(static_cast<int>(film.rgba[at]), static_cast<int>(pair.before.rgba[at]) + 20) << pair.shift_deg;
  }

  // A fragment in it is lighter than anything around.
  const assets::MetalFragment steel{25, false, {{3.2, 3.2, 9.0}, {3.2, 3.2, 7.0}}, {0.15, 0.13}};
  const TreatmentFilms broken = treatmentFilms(start, {start.solid, std::span(&steel, 1)}, nullptr);
  for (const FilmPair& pair : broken.pairs) {
    const render::Image& film = pair.after;
    const auto at = 4 * static_cast<std::size_t>(film.h / 2 * film.w + film.w / 2);
    EXPECT_GT(static_cast<int>(film.rgba[at]), static_cast<int>(pair.before.rgba[at]) + 20) << pair.shift_deg;
  }
}

}  // namespace
}  // namespace app
