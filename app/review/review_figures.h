// Figures of a session's report as markup: its timeline, the force over bone, its pictures. Pure; any thread.
#pragma once

#include <string>
#include <string_view>

#include "app/review/session_review.h"
#include "app/review/session_trend.h"

namespace app {

/// The page's element that tells of the mark of this number, from 1.
std::string markId(int number);
/// That of the picture of this number, from 0.
std::string pictureId(std::size_t number);
/// Instruments, drilling, force, bone removed and marks over one axis of time. The pointer tells values, a click on a
/// mark leads to its picture, or to it.
std::string timelineFigure(const SessionCourse& course, const std::optional<ProcedureRun>& procedure,
                           const std::vector<MomentPicture>& moments);
/// The steps of two rehearsals over one axis of time.
std::string stepsFigure(const SessionMetrics& first, const SessionMetrics& second);
/// Time drilling in bone by force. Empty: there was none.
std::string forceFigure(const SessionCourse& course);
/// Side by side; `has_words`: each with where it is seen from.
std::string picturesFigure(const std::vector<BonePicture>& pictures, std::string_view description,
                           bool has_words = true);
/// A few measures over the runs, from old to new; that of the report is marked, and the median from three on.
std::string trendFigure(const CaseTrend& trend);
/// A disc for "no", a square for "yes", a dashed outline for "not known".
std::string answerSymbol(std::optional<bool> is_error);

}  // namespace app
