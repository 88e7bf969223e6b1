#include "haptics/servo/root_break.h"

#include <utility>

namespace haptics {

void RootBreak::rest() noexcept {
  load_.restart();
  site_ = nullptr;
  over_ = 0;
  share_ = 0.0;
  broken_ = {};
}

void RootBreak::follow(const Bodies& bodies, const PieceSites& sites, std::size_t piece, const RootTool& tool,
                       double dt_s) noexcept {
  broken_ = {};
  const PieceSite* const site = sites.inForce(piece);
  // Of a piece that was cut or broken since, the sections are others.
  if (site == nullptr || !sites.isOf(bodies, piece) || bodies.pieces() >= kMaxPieces) return rest();
  if (std::exchange(site_, site) != site) load_.restart(), over_ = 0;
  const auto loaded = load_.follow(site->roots, site->hold, &site->obstacles, tool, dt_s);
  if (!loaded) return;
  share_ = loaded->share;
  over_ = share_ >= 1.0 ? over_ + 1 : 0;
  if (over_ < kRounds) return;
  const RootSection& root = site->roots.sections[loaded->section];
  if (root.split.blocks.empty()) return;
  plan_ = &root.split;
  broken_ = {
      static_cast<std::uint8_t>(piece + 1), true, root.section.area_mm2, loaded->force_N, loaded->bending_Nmm, true};
  over_ = 0;
}

}  // namespace haptics
