// The events of a rehearsal that no average may hide (reference/product 4.6): perforation of the lingual plate, second
// molar, mandibular canal, tooth left in. Told before every score. Pure; any thread.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace app {

struct SessionMetrics;

struct Gate {
  std::string_view key, name;   ///< "perforation", "lingual plate broken through"
  std::optional<bool> is_open;  ///< it happened; none: not known
  std::string words;            ///< how much, when; or why it is not known
  bool is_confirmed = true;     ///< false: of a tooth or canal that nobody has confirmed
};

std::array<Gate, 4> gatesOf(const SessionMetrics& metrics);

/// "lingual plate broken through: yes, 4.0 mm² at 3:10; second molar …: no; …".
std::string gatesInWords(const SessionMetrics& metrics);

}  // namespace app
