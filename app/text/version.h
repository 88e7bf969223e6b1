// Version of the program. Any thread.
#pragma once

#include <string_view>

namespace app {

/// Release, "0.1.0": written into sessions, rigs and reports. A session re-runs bit for bit within one version.
std::string_view programVersion();

/// Release and commit, "0.1.0 (1a2b3c4d)"; "+" follows the commit when files differed from it. The release alone when
/// built outside a git checkout.
std::string_view programBuild();

}  // namespace app
