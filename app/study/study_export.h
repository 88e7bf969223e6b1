// A study's result for programs. Pure; any thread; milliseconds.
#pragma once

#include <string>

#include "app/study/study_result.h"

namespace app {

std::string studyJson(const StudyResult& result);
/// kind,id,group,session,measure,value,unit: a row a number.
std::string studyCsv(const StudyResult& result);

}  // namespace app
