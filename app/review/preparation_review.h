// What a recorded tooth preparation has come to: JSON, a table and a picture. Any one thread; some seconds. Throws
// SessionError.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/session/bite_event.h"
#include "app/session/replay.h"
#include "app/session/session_reader.h"
#include "assets/prepared_tooth.h"
#include "render/image.h"

namespace app {

struct PreparationOfSession {
  assets::PreparedTooth tooth;
  IdealRule rule;
  PreparationOutcomes outcomes;
  render::Image picture;
  BiteRecord bite;                ///< on the tooth as it was left, on the paper used last
  std::vector<BiteRecord> bites;  ///< of the surgeon, as recorded
};

/// None: another operation. `start` is that of this session.
std::optional<PreparationOfSession> preparationOfSession(SessionReader& session, const StoredStart& start,
                                                         const BoneLeft& left);
/// None: another operation, or one that was not ended in order.
std::optional<PreparationOfSession> preparationOfSession(const std::string& path);

std::string preparationJson(const PreparationOfSession& of);
/// "40 µm paper on a made antagonist: 3 marks, 0.92 mm2: mesiobuccal 0.45 …".
std::string biteInWords(const BiteRecord& of);
/// For people, with its first line.
std::string preparationTable(const PreparationOfSession& of);

}  // namespace app
