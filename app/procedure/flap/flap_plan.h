// What a flap has to bare for a planned cut, and the incision that does it: from the cheek's side of the ramus to the
// middle of the ridge, along it to the second molar, round it in the sulcus on the cheek's side, and a releasing cut in
// front of what is bared, down and forwards. From the map of the closed gum; frame P, mm. Immutable; any thread; some
// ms. The triangular flap of the textbooks (Koerner 2006); margins are our own choice.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/procedure/flap/gum_chart.h"
#include "assets/patient.h"

namespace app {

class FlapPlan {
 public:
  /// Borrows the chart.
  FlapPlan(const GumChart& chart, const assets::Patient& patient, const assets::PlannedCut& cut);

  /// False: the plan bares no gum.
  bool isPossible() const { return line_.size() > 1; }
  /// From behind forwards; a releasing cut at either end.
  const std::vector<ChartPlace>& incision() const { return line_; }
  std::vector<glm::dvec3> incision_P_mm() const;
  double incisionLength_mm() const;
  /// Lattice points whose gum lies over the cut and on the cheek's side of the planned incision.
  const std::vector<ChartPlace>& bared() const { return bared_; }
  /// Of the flap's base, where it stays attached.
  double base_rad() const { return base_rad_; }
  /// Where the ridge begins to fall off towards the tongue.
  double lingualCrest_rad(double m_mm) const;
  /// Of the planned incision without its releasing cut.
  double crest_rad(double m_mm) const;
  /// Along the arch, of the papilla in front of the second molar.
  std::optional<double> papilla_m_mm() const { return papilla_m_mm_; }

 private:
  void findLingualCrest();
  void findTeeth(const assets::Patient& patient);
  void findBared(const assets::PlannedCut& cut);
  void findIncision();
  std::vector<ChartPlace> towardsCheek(ChartPlace at, double length_mm, double along) const;

  const GumChart& chart_;
  std::vector<ChartPlace> line_, bared_;
  std::size_t first_crest_ = 0, crest_points_ = 0;   ///< of the line, between the releasing cuts
  std::vector<double> lingual_rad_;                  ///< by column
  std::vector<std::optional<glm::dvec2>> over_rad_;  ///< by column: lowest and highest angle of gum over the cut
  double base_rad_ = 1.0, middle_b_mm_ = -100.0;     ///< of the second molar, towards the cheek
  std::optional<double> papilla_m_mm_;
};

/// Along a column of the map's gum.
double acrossGum_mm(const GumChart& chart, double m_mm, double from_rad, double to_rad);

}  // namespace app
