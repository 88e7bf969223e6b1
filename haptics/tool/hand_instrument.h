// Hand instruments that neither turn, nor grip, nor lever: scalpel, periosteal elevator, curette, bone file, suction
// tip, and those that fill a tooth. They meet bone and tooth with a ball at the tip and a round shank behind it. A file
// that is pressed and drawn takes bone (servo/filing); while the pedal is down what fills a tooth works
// (servo/filling_hand); what the others do to gum, follicle and chips is the procedure's. Part of a Tool; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace haptics {

enum class HandInstrument : std::uint8_t {
  none = 0,
  scalpel_15 = 1,  ///< handle no. 3 with blade no. 15
  periosteal = 2,  ///< periosteal elevator, as Molt no. 9: a broad thin blade
  curette = 3,     ///< as Lucas no. 85: a spoon of 2.4 mm
  bone_file = 4,   ///< as Miller: a flat toothed head
  suction = 5,     ///< a surgical suction tip of 3 mm
  // Applicators with a material on them.
  composite = 6,
  glass_ionomer = 7,
  amalgam = 8,
  wax = 9,
  gutta_percha = 10,
  plugger = 11,      ///< round, of 1.4 mm
  carver = 12,       ///< takes filling away, the softer the faster, and nothing else
  curing_lamp = 13,  ///< its light goes towards -z
  /// For root canals, of 0.5 mm; hot while the pedal is down: what it softens goes towards -z, where there is room.
  root_plugger = 14,
};

constexpr bool isApplicator(HandInstrument kind) {
  return kind >= HandInstrument::composite && kind <= HandInstrument::gutta_percha;
}
/// Lays, packs, carves or cures filling while the pedal is down.
constexpr bool fills(HandInstrument kind) { return kind >= HandInstrument::composite; }

/// As ordered and recorded, in the order of the kinds.
inline constexpr std::array<std::string_view, 15> kHandInstrumentKeys{
    "none",    "scalpel:15", "periosteal",   "curette", "bone-file", "suction",     "composite",   "glass-ionomer",
    "amalgam", "wax",        "gutta-percha", "plugger", "carver",    "curing-lamp", "root-plugger"};

/// What of it meets bone and tooth: a ball about T's origin and a rod of `shank_radius_mm` along +z. The drawn
/// instrument (assets/instrument/hand_instrument) has its tip at z = -tip_radius_mm. Our defaults: a ball is as thick
/// as blade or head, so that no flat of it sinks in.
struct HandInstrumentSize {
  double tip_radius_mm = 0.5, shank_radius_mm = 0.5, length_mm = 40.0;
};
inline constexpr std::array<HandInstrumentSize, kHandInstrumentKeys.size()> kHandInstrumentSizes{{{},
                                                                                                  {0.3, 0.15},
                                                                                                  {0.6, 0.6},
                                                                                                  {1.2, 0.8},
                                                                                                  {1.0, 1.0},
                                                                                                  {1.5, 1.5},
                                                                                                  {0.5, 0.4},
                                                                                                  {0.5, 0.4},
                                                                                                  {0.8, 0.8},
                                                                                                  {0.5, 0.4},
                                                                                                  {0.4, 0.3},
                                                                                                  {0.7, 0.5},
                                                                                                  {0.4, 0.3},
                                                                                                  {3.0, 3.0},
                                                                                                  {0.25, 0.22}}};

}  // namespace haptics
