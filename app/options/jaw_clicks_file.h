// A person's clicks in a scan without labels, as a JSON file for `molar import --clicks`:
// {"clicks": [{"edit": "number", "fdi": 48, "at_P_mm": [[x, y, z]]}, {"edit": "canal", "at_P_mm": [[…], […]]}, …]}
// `edit`: same-tooth and two-teeth (two points), number (with fdi), no-tooth, root-tip (one), canal (two to six, from
// one end to the other); brush (the way of its centre, with radius_mm, `as`: an FDI number, "bone" or "nothing", and
// optionally grey_hu: [low, high]), cut (a line's ends and a point of what goes). Points in frame P, mm. At most 2,000.
// Main thread, at start-up.
#pragma once

#include <string>

#include "assets/segment/jaw_clicks.h"

namespace app {

inline constexpr std::size_t kMostClicks = 2000;

/// Throws LoadError: it cannot be read; UsageError of one line: file, number of the click, what is wrong.
assets::JawClicks readJawClicks(const std::string& path);
/// The text of such a file.
std::string jawClicksText(const assets::JawClicks& clicks);
/// The same of a text; `name` stands for it in messages.
assets::JawClicks jawClicksFrom(const std::string& text, const std::string& name);

}  // namespace app
