// How good calibration is, every figure at once, against what is asked of it: simulated truth, seeded.
//   calibration_bench [number of rigs, default 60]
// Errors are the same in every run; times are CPU time.
#include <cstdio>
#include <cstdlib>

#include "tests/bench/calibration/figures.h"

int main(int argc, char** argv) {
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 60;
  if (rigs < 1) {
    std::fprintf(stderr, "calibration_bench: the number of rigs is at least 1\n");
    return 2;
  }
  std::printf("%d rigs\n%-66s %-15s %-22s\n", rigs, "figure", "asked", "measured");
  int missed = 0;
  for (const auto& measure :
       {bench::jigFigures, bench::crossValidationFigures, bench::outlierFigures, bench::visualFigures,
        bench::rezeroFigures, bench::guardFigures, bench::seenFigures, bench::webcamFigures})
    for (const bench::Figure& figure : measure(rigs)) {
      std::printf("%-66s %-15s %-22s %s\n", figure.what.c_str(), figure.asked.c_str(), figure.measured.c_str(),
                  figure.told_only ? ""
                  : figure.holds   ? "ok"
                                   : "MISSED");
      std::fflush(stdout);
      missed += figure.holds ? 0 : 1;
    }
  std::printf("%d missed\n", missed);
  return missed == 0 ? 0 : 1;
}
