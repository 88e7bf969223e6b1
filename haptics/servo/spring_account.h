// What a hand has put into a spring whose far end wanders, and how far the spring may act for what is left of it. The
// end of a tool that slips past a lip, or is turned by a cheek, can draw the spring without any work of the hand: such
// a spring would give back what nobody put in. It acts with the largest deflection c <= d of which
//   U(c) + f(c) a / 2 <= E - W / 2 + tolerance
// f the force at a deflection, U = integral of f, a the hand's way along the force in this tick, W the work that the
// last force did in it (work by the midpoint rule), E the account: E <- E - work, at most U(d), so that what was lost
// on the way is no credit. A spring with a fixed end is left alone. From one touch the hand gets at most the tolerance,
// and what the last force gives it in one tick (the leak of sampling): paid back before more is given. Saturating
// spring f = F (1 - exp(-k d / F)). mm, N. Servo thread; some exponentials, 60 of them where the account falls short.
#pragma once

namespace haptics {

class SpringAccount {
 public:
  static constexpr double kTolerance_Nmm = 0.002;  ///< of the midpoint rule in a slow press and release

  SpringAccount(double stiffness_N_per_mm, double max_force_N)
      : stiffness_N_per_mm_(stiffness_N_per_mm), max_force_N_(max_force_N) {}

  double force_N(double deflection_mm) const noexcept;
  double stored_Nmm(double deflection_mm) const noexcept;

  /// c of `deflection_mm`; `last_work_Nmm` and `along_mm`: W and a.
  double covered_mm(double deflection_mm, double last_work_Nmm, double along_mm) const noexcept;
  /// The work that was done on the hand in this tick, and the deflection as it is; 0 when it is free.
  void close(double work_Nmm, double deflection_mm) noexcept;
  /// Nothing is owed by either side: before a touch.
  void open() noexcept { balance_Nmm_ = 0.0; }

  /// Below 0: the hand got more than it put in.
  double balance_Nmm() const { return balance_Nmm_; }

 private:
  double stiffness_N_per_mm_, max_force_N_;
  double balance_Nmm_ = 0.0;
};

}  // namespace haptics
