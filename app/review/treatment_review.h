// What a recorded root-canal treatment has come to, read from its session. Frame P, mm. Any one thread; a second or
// two. Throws SessionError.
#pragma once

#include <optional>
#include <string>

#include "app/procedure/root_canal/treatment.h"
#include "app/session/replay.h"
#include "app/session/session_reader.h"
#include "assets/tooth_canals.h"

namespace app {

struct TreatmentOfSession {
  assets::ToothCanals tooth;
  Treatment treatment;
  haptics::WearLaw wear = haptics::WearLaw::wear;  ///< at the end
};

/// None: the session is of another operation, or its bone at the end is not known.
std::optional<TreatmentOfSession> treatmentOfSession(const std::string& path);
/// The same with what it left, which is known. `start`: that of the session, which is rewound.
std::optional<TreatmentOfSession> treatmentOfSession(SessionReader& session, const StoredStart& start,
                                                     const BoneLeft& left);

}  // namespace app
