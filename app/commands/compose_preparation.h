// What a tooth preparation adds to a rehearsal's plan: ideal, burs, a scripted hand's way, a cavity that is cut
// already. Main thread, at start-up; the ideal of a molar takes a second.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/commands/rehearse_options.h"
#include "assets/patient.h"

namespace app {

/// A crown, or the cavity over a lesion.
std::string usualIdeal(const std::string& caries);

/// What the tooth bites on, and how; `whole`: the scan that it is of. Returns what is remarked. Throws UsageError.
std::vector<std::string> chooseBite(assets::Patient& patient, const assets::CtVolume& whole,
                                    const RehearseOptions& options);
/// "55,32": behind and over, mm. Throws UsageError.
glm::dvec2 hingeFrom(const std::string& text);

/// The tray, where nothing was asked for by name.
std::vector<std::string> preparationTools(const RehearseOptions& options);

/// The tooth has room for its ideal, and a scripted hand knows its way; throws UsageError where it has none.
/// `draws_outline`: on a practice block. `grooves`: a scripted hand has burs that were named and tries them.
void planPreparation(RehearsalPlan& plan, bool draws_outline, bool grooves);

/// Cuts the tooth to its ideal. Returns the solid as it was.
std::vector<std::uint8_t> cutReady(assets::Patient& patient);

}  // namespace app
