// Figures of a session's report as markup: its timeline, the force over bone, its pictures. Pure; any thread.
#pragma once

#include <string>

#include "app/review/session_review.h"

namespace app {

/// The page's element that tells of the mark of this number, from 1.
std::string markId(int number);
/// Instruments, drilling, force, bone removed and marks over one axis of time. The pointer tells values, a click on a
/// mark leads to it.
std::string timelineFigure(const SessionCourse& course, const std::optional<ProcedureRun>& procedure);
/// Time drilling in bone by force. Empty: there was none.
std::string forceFigure(const SessionCourse& course);
/// Side by side, each with where it is seen from.
std::string picturesFigure(const std::vector<BonePicture>& pictures);
/// A disc for "no", a square for "yes", a dashed outline for "not known".
std::string answerSymbol(std::optional<bool> is_error);

}  // namespace app
