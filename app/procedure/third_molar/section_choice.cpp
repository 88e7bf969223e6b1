#include "app/procedure/third_molar/section_choice.h"

#include <algorithm>

#include "app/procedure/third_molar/cut_sweep.h"
#include "haptics/body/components.h"

namespace app {
namespace {

constexpr double kCounted_mm3 = 5.0;  ///< smaller ones are left to the suction

}  // namespace

std::optional<double> inTheWayAfter_mm3(const UncutSite& site, const assets::PlannedCut& cut,
                                        const assets::PlannedCut& parting, double most_share) {
  const haptics::Components whole(site.piece_grid, site.tooth_solid);
  AroundTooth around = site.around;
  sweep(cut, around.grid, around.solid);
  std::vector<std::uint8_t> tooth_solid(site.tooth_solid.begin(), site.tooth_solid.end());
  sweep(cut, site.piece_grid, tooth_solid);
  sweep(parting, site.piece_grid, tooth_solid);
  const haptics::Components tooth(site.piece_grid, tooth_solid);
  if (whole.pieces().empty() || tooth.pieces().empty() ||
      tooth.pieces()[0].volume_mm3 >= most_share * whole.pieces()[0].volume_mm3)
    return {};
  const auto pieces = static_cast<std::size_t>(std::ranges::count_if(
      tooth.pieces(), [](const haptics::ToothPiece& piece) { return piece.volume_mm3 >= kCounted_mm3; }));
  double sum_mm3 = 0.0;
  for (const PieceWay& piece : waysOut(around, tooth, pieces, site.up))
    sum_mm3 += canCome(piece.way) || piece.way.in_the_way_mm3 > 0.0 ? piece.way.in_the_way_mm3 : kNoWay_mm3;
  return sum_mm3;
}

}  // namespace app
