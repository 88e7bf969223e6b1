// The chart of an experiment: the psychometric function with the answers, the tracks of a staircase by trial, or the
// running fraction of a comparison of two. Pure; drawn by app/report/chart.h.
#pragma once

#include "app/psychophysics/summary.h"
#include "app/report/chart.h"

namespace app {

Chart chartOf(const Protocol& protocol, const Outcome& outcome);

}  // namespace app
