// An import shown while it works, and stopped by a signal or in its window. Main thread; the work has one of its own.
#pragma once

#include <functional>
#include <memory>

#include "app/check_page/check_window.h"
#include "app/commands/import_course.h"

namespace app {

/// Runs it to its end; a stop ends the program (import_course.h). `in_window`: shown in a window as well, which is
/// returned open; null: there is none, or somebody asked to stop when it was too late. Throws what the work throws.
std::unique_ptr<CheckWindow> runShown(const std::function<void(ImportCourse&)>& work, bool in_window);

}  // namespace app
