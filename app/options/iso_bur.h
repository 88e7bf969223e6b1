// Burs by their ISO 6360 number: shape of the head (ISO 6360-2) and largest diameter in tenths of a millimetre, as
// `289/016`, a torpedo of 1.6 mm; with `,L` another length than the usual one. Numbers and lengths as makers' lists
// have them (unverified against the standard). Start-up only.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "haptics/tool/bur_shape.h"

namespace app {

/// Throws UsageError beginning with `option`; `text` is what follows "iso:".
haptics::BurShape isoBurFrom(std::string_view text, const std::string& option);

/// "001, 010, …"
std::string isoShapes();

}  // namespace app
