// The picture of an experiment: the psychometric function with what was answered, the tracks of a staircase trial by
// trial, or the share so far of a comparison of two. Pure; drawn by chart/chart.
#pragma once

#include "app/psychophysics/summary.h"
#include "app/report/chart.h"

namespace app {

Chart chartOf(const Protocol& protocol, const Outcome& outcome);

}  // namespace app
