// Sound libraries report every card that they do not find. They are asked to be silent, by their names, so that no
// header of theirs is needed; stderr itself stays open for the lines of other threads. Before PortAudio is begun.
#pragma once

namespace app {

void silenceSoundLibraries();

}  // namespace app
