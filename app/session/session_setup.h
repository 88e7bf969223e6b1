// What a rehearsal needs besides the bone to go on later and to be measured: the parameters of the built-in patient,
// the tools on the tray, which session it continues, the operated tooth and the canal. Plain values; any thread. Never
// a person's name, identifier or folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/metal_fragment.h"
#include "assets/operative_site.h"
#include "assets/prepared_tooth.h"
#include "assets/proposed.h"
#include "assets/synthetic/jaw.h"
#include "assets/tooth_canals.h"
#include "haptics/tool/tool.h"

namespace app {

/// The session that was continued.
struct FormerSession {
  std::string file;               ///< name without folder
  double duration_s = 0.0;        ///< of all parts until its end
  std::uint64_t bone_digest = 0;  ///< haptics::Bodies::digest of the bone taken over, as never cut
};

struct SessionSetup {
  bool isImported() const { return !built_in && practice.empty(); }

  std::optional<assets::JawParameters> built_in;  ///< none: an imported patient, or a practice block
  std::string practice;                           ///< assets::PracticeText::key of a practice block; empty: none
  std::vector<haptics::Tool> tray;                ///< the first in the hand at the start
  std::optional<FormerSession> former;            ///< none: the patient was untouched
  std::optional<assets::OperativeSite> site;      ///< none: no such tooth, or recorded before it was stored
  std::vector<glm::dvec3> canal_P_mm;             ///< centre line of the mandibular canal; empty: as `site`
  double canal_radius_mm = 0.0;
  std::optional<assets::ToothCanals> canals;      ///< of the tooth of a root-canal treatment; none: another operation
  std::vector<assets::MetalFragment> fragments;   ///< of files that broke in it before
  std::optional<assets::PreparedTooth> prepared;  ///< for a restoration; none: another operation
  assets::Proposed proposed;                      ///< nobody had confirmed it when it was recorded
  std::optional<glm::dvec3> down_P;               ///< unit, along gravity as the patient lay; none: as `site`
};

}  // namespace app
