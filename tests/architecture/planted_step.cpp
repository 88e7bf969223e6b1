// A servo step with an allocation behind a branch no test takes: what the symbol check must find.
#include <vector>

namespace planted {
namespace {

__attribute__((noinline)) void grow(std::vector<double>& forces, double force) { forces.push_back(force); }

}  // namespace

double step(std::vector<double>& forces, double force_N) noexcept {
  if (force_N > 1e300) grow(forces, force_N);
  return force_N;
}

/// Calls through a pointer that is on nobody's list.
double ask(double (*who)()) noexcept { return who() + 1.0; }

}  // namespace planted
