// Tools as text, as a dentist orders them: `round:D`, `fissure:D,L` (D the diameter in mm or an ISO 6360 size as iso023
// = 2.3 mm, L the length of the head); or by shape: heads `sphere:R`, `capsule:R,L` (L the cylindrical part),
// `cylinder:R,L`, `cone:R,L` (R at the base, L high), `flame:R,L` and other outlines (assets/bur_outline; R the
// largest, L the whole length) and shafts `R,L`, all in mm; or `iso:289/016` (iso_bur). Start-up only. Throws
// UsageError with the accepted forms. `forceps`, `elevator:KIND` and hand instruments (`scalpel:15`, `curette`, …) are
// tools without a head.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "haptics/tool/tool.h"

namespace app {

inline constexpr const char* kShaftHelp = "Shaft above the head, felt and never cutting: R,L (mm) or none";

/// "round:D, fissure:D,L, sphere:R, … or cone:R,L"
std::string headForms();
inline std::string headHelp() {
  return "Cutting head: " + headForms() + "; D diameter in mm or ISO size (iso023 is 2.3 mm), R radius, L length, mm";
}

/// "sphere", "capsule", …
std::multimap<haptics::ShapeKind, std::string_view> headKinds();

/// Radius 0.1..20, length 0.1..40 mm (a capsule's from 0).
haptics::BurShape headFrom(const std::string& text);

/// "elevator:301, elevator:34s, elevator:cryer-left or elevator:cryer-right"
std::string elevatorForms();

/// "scalpel:15, periosteal, curette, bone-file or suction"
std::string handInstrumentForms();
/// "k-file:SIZE,LENGTH …, or gp-cone:SIZE,TAPER …"
std::string fileForm();

/// `forceps`, an elevator, a hand instrument, or a head with this shaft; empty: what is usual for it.
haptics::Tool toolFrom(const std::string& text, const std::string& shaft);

/// `none` or radius 0.1..5 and length 0.1..100 mm, counted from the head's centre.
haptics::Shaft shaftFrom(const std::string& text);

/// In the form that `headFrom` reads.
std::string textOf(const haptics::BurShape& head);

}  // namespace app
