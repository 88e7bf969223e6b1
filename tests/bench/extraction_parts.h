// The parts of haptics_extraction_bench: a source file each.
#pragma once

#include <time.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace bench {

inline double threadTime_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

/// Tenth percentile of some runs.
template <class Work>
double p10_us(int times, Work work) {
  std::vector<double> us;
  for (int n = 0; n < times; ++n) {
    const double began = threadTime_us();
    work();
    us.push_back(threadTime_us() - began);
  }
  std::sort(us.begin(), us.end());
  return us[us.size() / 10];
}

void benchElevator();
void benchLigament();
void benchPieces();
void benchSite();
void benchWayOut();

struct ExtractionPart {
  std::string_view name;
  void (*run)();
};
inline constexpr std::array kExtractionParts{
    ExtractionPart{"elevator", benchElevator}, ExtractionPart{"ligament", benchLigament},
    ExtractionPart{"pieces", benchPieces}, ExtractionPart{"site", benchSite}, ExtractionPart{"way-out", benchWayOut}};

}  // namespace bench
