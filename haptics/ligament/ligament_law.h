// Law of the periodontal ligament per area of root, and of bare contact. Fibres stiffen exponentially to a peak, then
// tear; a wall compresses what lies between root and bone; fluid resists quick movement along the normal; a fibre held
// below its peak creeps until it fails; a socket pressed beyond its yield widens. Stretch: displacement over width.
// mm, N, s; energies in N mm, which are mJ. Plain values; any thread. Formulas and values: reference/extraction 3.1
// and 4.2; all are our defaults except where a line names what they were fitted to.
#pragma once

namespace haptics {

struct LigamentLaw {
  // Fibres: stress (E0/B)(e^(B stretch) - 1) to the peak, then constant times what is not torn.
  double fibre_N_per_mm2 = 0.10;  ///< E0, tangent at rest: 5 N on the crown move it by 0.14 mm
  double fibre_stiffening = 6.3;  ///< B: peak stress 2.44 MPa, within what molars were pulled with
  double peak_stretch = 0.80;
  double torn_stretch = 2.0;
  double shear_weight = 1.0;  ///< of the square of shear beside that of opening

  // Wall: pressure (Ec/Bc)(e^(Bc e) - 1) to e = 1, linear beyond. Intrusion at 1, 10, 100 N: 0.007, 0.040, 0.105 mm.
  double wall_N_per_mm2 = 0.20;
  double wall_stiffening = 6.0;

  // Fluid: a Maxwell branch along the normal; tan delta does not grow with frequency.
  double fluid_N_per_mm2 = 0.4;
  double fluid_relaxation_s = 0.25;

  // Creep: torn share grows by dt/creep_s (stress/peak)^6 above a floor.
  double creep_s = 20.0;     ///< average removal takes 20 s
  double creep_floor = 0.3;  ///< of the peak stress

  // The socket's wall gives way: trabecular 10 MPa, cortical 80.
  double yield_N_per_mm2 = 10.0;
  double yield_Ns_per_mm3 = 200.0;

  double width_mm = 0.2;
  double width_scatter = 0.3;  ///< uniform within this share about the width

  double contact_N_per_mm3 = 50.0;  ///< bare surface against bone or tooth: 1 mm2, 0.02 mm deep, holds 1 N

  // Drag of the whole piece; the lever makes it one of rotation.
  double drag_Ns_per_mm = 0.01;
  double drag_lever_mm = 6.0;

  /// What a fibre holds at most.
  double peakStress_N_per_mm2() const noexcept;
  /// To tear all fibres of an area, from rest and slowly: 0.367 mJ/mm2 at 0.2 mm.
  double tearEnergy_Nmm_per_mm2(double width_at_mm) const noexcept;

  /// Each within what the kernels and the solve can bear; not a number becomes the default.
  LigamentLaw sanitised() const noexcept;

  bool operator==(const LigamentLaw&) const = default;
};

}  // namespace haptics
