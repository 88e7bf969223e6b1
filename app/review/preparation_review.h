// What a recorded tooth preparation has come to: JSON, a table and a picture. Any one thread; some seconds. Throws
// SessionError.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/session/session_reader.h"
#include "assets/prepared_tooth.h"
#include "render/image.h"

namespace app {

struct PreparationOfSession {
  assets::PreparedTooth tooth;
  IdealRule rule;
  PreparationOutcomes outcomes;
  render::Image picture;
};

/// None: another operation.
std::optional<PreparationOfSession> preparationOfSession(const StoredStart& start,
                                                         std::span<const std::uint8_t> solid_after,
                                                         const std::optional<haptics::Filling::Volumes>& filling);
/// None: another operation, or one that was not ended in order.
std::optional<PreparationOfSession> preparationOfSession(const std::string& path);

std::string preparationJson(const PreparationOfSession& of);
/// For people, with its first line.
std::string preparationTable(const PreparationOfSession& of);

}  // namespace app
