// The force laws of the field behind one call: which one, and with which parameters, is a value that may change from
// tick to tick. Every law is a file of its own in contact/. Servo thread; costs as the laws say. No allocation, no
// throw; a law answers a zero Contact where it does not admit the shape.
#pragma once

#include <cstdint>

#include "haptics/contact/agus.h"
#include "haptics/contact/contact.h"

namespace haptics {

enum class LawKind : std::uint8_t { agus };

/// All laws' parameters live side by side, so that switching back finds them as they were.
struct LawSettings {
  LawKind kind = LawKind::agus;
  TissueStiffness tissue;
  AgusParameters agus;
};

Contact contactOf(const LawSettings& law, const ToolInBone& at) noexcept;

}  // namespace haptics
