// Which program this is. Any thread; plain text.
#pragma once

#include <string_view>

namespace app {

/// Of the release, "0.1.0": what sessions, rigs and reports say of the program that made them. A session re-runs bit
/// for bit within one version.
std::string_view programVersion();

/// With the commit it was built from, "0.1.0 (1a2b3c4d)", where it was built in a git checkout; "+" after a commit
/// whose files were changed since.
std::string_view programBuild();

}  // namespace app
