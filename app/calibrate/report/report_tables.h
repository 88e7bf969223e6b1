// The tables of a calibration's report as HTML: figures against their limits, outliers, where it comes from. mm. Pure.
#pragma once

#include <string>

#include "calibration/record/rig_record.h"

namespace app {

std::string figuresTable(const calibration::RigRecord& record);
std::string outliersTable(const calibration::RigRecord& record);
std::string originTable(const calibration::RigRecord& record, const std::string& now_utc);

}  // namespace app
