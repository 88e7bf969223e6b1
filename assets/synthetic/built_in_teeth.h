// The canals of the teeth of the built-in jaw, in closed form: straight, an arc, straight to a foramen beside the apex;
// sections oval from cheek to tongue. Numbers of a first molar: two mesial canals 3.6 to 3.8 mm apart at the orifice
// with foramina of their own, one distal; chamber 1.57 mm high with its roof at the cervical line; constriction 0.28 mm
// wide, 0.5 to 1.5 mm short of the foramen (Deutsch and Musikant 2004, JOE 30:388; reference/sisters 3.2). Second and
// third molar: the mesial canals join. Curves as far as the roots leave dentine around. Frame P, mm. Any thread; the
// first call makes the tooth's shape (0.2 s).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assets/scan/fine_tooth.h"
#include "assets/synthetic/jaw.h"
#include "assets/synthetic/root_canal.h"
#include "assets/synthetic/tooth_row.h"
#include "assets/tooth_canals.h"

namespace assets {

/// A tooth of the built-in jaw where it stands.
struct BuiltInTooth {
  int fdi = 36;
  PlacedTooth placed;
  ToothFrame frame;  ///< the placed tooth's, in P
};

/// FDI numbers, from the midline.
std::vector<int> builtInTeeth(const JawParameters& jaw);

/// Throws LoadError where the jaw has no such tooth.
BuiltInTooth builtInTooth(const JawParameters& jaw, int fdi);

ToothCanals canalsOf(const BuiltInTooth& tooth);

/// One of these canals alone, round: sections are circles as large as its ellipses, dentine 1 mm around.
struct RoundCanal {
  std::string name;
  RootCanal canal;
};
/// Those with a foramen of their own.
std::vector<RoundCanal> roundCanals(const BuiltInTooth& tooth);

/// `ct`: the jaw's, of the built-in patient of the same parameters.
std::unique_ptr<ToothSampler> fineBuiltInTooth(const BuiltInTooth& tooth, const CtVolume& ct,
                                               double spacing_mm = kFineSpacing_mm);

}  // namespace assets
