// CPU time of all threads of the process, so that other work on the machine disturbs a measurement least.
#pragma once

#include <sys/resource.h>

#include <cstdio>

namespace bench {

inline double cpu_ms() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return ms(used.ru_utime) + ms(used.ru_stime);
}

/// Prints one line: what some work costs in CPU time and what it answers.
template <class Work>
void printCost(const char* what, const Work& work) {
  const double began_ms = cpu_ms();
  const double answer = work();
  std::printf("%-34s %8.1f ms   %.4g\n", what, cpu_ms() - began_ms, answer);
}

}  // namespace bench
