// Clicks on teeth change the regions that were found (tooth_regions.h), before their surfaces are placed. Nothing is
// computed anew from clicks alone: where the automatic result was right that makes it worse. A piece is the nearest
// within 1.5 mm of a click. Frame P, mm. Any thread but the servo; some 50 ms a click.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/segment/jaw_clicks.h"
#include "assets/segment/tooth_numbers.h"

namespace assets {

/// What clicks have said of the parts; by part, [0] is none.
struct ToldParts {
  std::vector<int> fdi;                ///< 0: nothing
  std::vector<std::uint8_t> is_apart;  ///< it joins no other part by itself

  /// Onto teeth that were measured. Throws LoadError when one that has a number is too small to be a tooth.
  void tell(std::vector<FoundTooth>& teeth) const;
};

/// Throws LoadError of one line for a click that does not fit, by its number from 1.
ToldParts editTeeth(const Mandible& jaw, const GreyLevels& levels, std::span<const ToothClick> clicks,
                    ToothRegions& regions);

}  // namespace assets
