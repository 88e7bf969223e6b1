// What broken files have left in a tooth, as text: of a session's start (session_setup) and as an event whenever it
// changes, so that the last one tells what is in the tooth at the end. Written by SessionWriter from the ticks, whoever
// records. A stranger's text is refused (SessionError). Pure; any thread.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/session_reader.h"
#include "assets/metal_fragment.h"

namespace app {

/// Kind of these events.
inline constexpr char kFragmentsEvent[] = "file fragments";

/// A list of objects: size, nickel_titanium, nodes of x, y, z in P and radius, mm.
std::string fragmentsText(const std::vector<assets::MetalFragment>& fragments);
/// Throws SessionError.
std::vector<assets::MetalFragment> fragmentsFrom(std::string_view text);

/// In the tooth after tick `last_tick`; usually at the end. Throws SessionError.
std::vector<assets::MetalFragment> fragmentsIn(const SessionSetup& setup, const std::vector<SessionEvent>& events,
                                               std::uint64_t last_tick = std::numeric_limits<std::uint64_t>::max());

}  // namespace app
