// A study's result for people: a page, and lines for a terminal; and a questionnaire as a sheet of paper. No path, no
// name of a person. Pure; any thread; milliseconds.
#pragma once

#include <string>

#include "app/study/study_result.h"

namespace app {

class HtmlPage;

/// One file without script or request; prints on A4.
std::string studyPage(const StudyResult& result);
/// Its sections but the limits: problems, tasks, answers, words, what is compared.
void addResults(HtmlPage& page, const StudyResult& result);
std::string studyLines(const StudyResult& result);

/// To be printed and filled in by hand.
std::string questionnaireSheet(const Questionnaire& questionnaire);

}  // namespace app
