#include "haptics/ligament/ligament_law.h"

#include <algorithm>
#include <cmath>

#include "haptics/ligament/series.h"

namespace haptics {

double LigamentLaw::peakStress_N_per_mm2() const noexcept {
  return fibre_N_per_mm2 / fibre_stiffening * (exponentialOf(fibre_stiffening * peak_stretch) - 1.0);
}

double LigamentLaw::tearEnergy_Nmm_per_mm2(double width_at_mm) const noexcept {
  const double to_peak_N_per_mm2 = (peakStress_N_per_mm2() - fibre_N_per_mm2 * peak_stretch) / fibre_stiffening;
  return width_at_mm * (to_peak_N_per_mm2 + 0.5 * peakStress_N_per_mm2() * (torn_stretch - peak_stretch));
}

LigamentLaw LigamentLaw::sanitised() const noexcept {
  const LigamentLaw usual;
  LigamentLaw law = *this;
  const auto within = [&](double LigamentLaw::*value, double low, double high) {
    law.*value = std::isnan(law.*value) ? usual.*value : std::clamp(law.*value, low, high);
  };
  within(&LigamentLaw::fibre_N_per_mm2, 1e-4, 10.0);
  within(&LigamentLaw::fibre_stiffening, 0.1, 10.0);
  within(&LigamentLaw::peak_stretch, 0.05, 1.5);
  within(&LigamentLaw::torn_stretch, law.peak_stretch + 0.1, 10.0);
  within(&LigamentLaw::shear_weight, 0.05, 4.0);
  within(&LigamentLaw::wall_N_per_mm2, 1e-4, 10.0);
  within(&LigamentLaw::wall_stiffening, 0.1, 8.0);
  within(&LigamentLaw::fluid_N_per_mm2, 0.0, 10.0);
  within(&LigamentLaw::fluid_relaxation_s, 1e-3, 1e3);
  within(&LigamentLaw::creep_s, 0.1, 1e9);
  within(&LigamentLaw::creep_floor, 0.0, 1.0);
  within(&LigamentLaw::yield_N_per_mm2, 0.1, 1e9);
  within(&LigamentLaw::yield_Ns_per_mm3, 1.0, 1e9);
  within(&LigamentLaw::width_mm, 0.05, 1.0);
  within(&LigamentLaw::width_scatter, 0.0, 0.8);
  within(&LigamentLaw::contact_N_per_mm3, 0.1, 500.0);
  within(&LigamentLaw::drag_Ns_per_mm, 1e-4, 10.0);
  within(&LigamentLaw::drag_lever_mm, 0.5, 30.0);
  return law;
}

}  // namespace haptics
