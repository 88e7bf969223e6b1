// Force and torque on the hand in one frame. N, N mm; the torque's reference point is stated where a wrench is passed.
// Trivially copyable; any thread.
#pragma once

#include "calibration/geometry/pose.h"

namespace haptics {

template <class A>
struct Wrench {
  calibration::Vector<A> force_N;
  calibration::Vector<A> torque_Nmm;
};

template <class A>
Wrench<A> operator+(const Wrench<A>& a, const Wrench<A>& b) {
  return {a.force_N + b.force_N, a.torque_Nmm + b.torque_Nmm};
}
template <class A>
Wrench<A> operator-(const Wrench<A>& a, const Wrench<A>& b) {
  return {a.force_N - b.force_N, a.torque_Nmm - b.torque_Nmm};
}
template <class A>
Wrench<A> operator*(double s, const Wrench<A>& w) {
  return {s * w.force_N, s * w.torque_Nmm};
}

}  // namespace haptics
