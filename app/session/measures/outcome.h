// What the operation left (reference/product 4.2): O1 volumes, bone by zone, O2 share of the plan, O3 and O4 over- and
// under-cut against it, O5 perforation of the outer lingual surface, O6 wall left, O7 profile of the trough, O8 gouges,
// O9 bridge of the tooth, O10 second molar, O11 tooth left in. From the bone before and after, the times of removal,
// and what the recording says of the socket; every measure has a value, or why it has none. Frame P, mm, mm3, s. Pure;
// any thread; a second.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/measures/measure_value.h"
#include "app/session/measures/original_surface.h"
#include "app/session/measures/removal_clock.h"
#include "app/session/measures/session_case.h"
#include "app/session/measures/zones.h"
#include "app/session/session_text.h"
#include "app/session/socket_event.h"

namespace app {

struct OutcomeOf {
  const StoredStart& start;
  std::span<const std::uint8_t> after;  ///< solid at the end
  const RemovalClock& clock;
  const OriginalSurface* surface;  ///< for O7, O8; null: they have no value
  const SessionCase& about;
  const std::optional<SocketRecord>& socket;
  std::optional<double> parted_s;  ///< when the tooth first came apart; none: it did not
  /// As recorded; none: what a bur covered of the tooth counts as removed by it.
  std::optional<RemovedByTissue> removed_mm3 = {};
  /// Ids that are wanted, others may have no value; empty: all.
  std::span<const std::string> wanted = {};
};

/// By zone, in the order of Zone.
inline constexpr std::array<std::string_view, kZones> kZoneMeasures{"O1.occlusal", "O1.buccal",  "O1.distal",
                                                                    "O1.mesial",   "O1.lingual", "O1.apical"};

/// Ids, names and units of all.
std::span<const MeasureName> outcomeNames();

std::vector<MeasureValue> outcomeMeasures(const OutcomeOf& of);
/// Without the bone at the end: each measure with why.
std::vector<MeasureValue> noOutcome(std::string_view why);

}  // namespace app
