#include "haptics/servo/luxation_strokes.h"

#include <cassert>

namespace haptics {

void LuxationStrokes::begin(StrokeHistory& strokes, const Bodies& bodies, PieceSites& sites,
                            std::size_t piece) noexcept {
  assert(!kept_.empty());
  close(bodies, sites);
  strokes.addMarked();
  std::size_t n = strokes.strokes() - 1;
  open_ = strokes.place(n);
  Stroke& stroke = strokes_[*open_];
  stroke = {0, 0, sites.tornTotal_Nmm(), sites.tornTotal_Nmm()};
  // Its pieces are kept after those of the one before.
  while (n > 0 && !strokes.isMarked(n - 1)) --n;
  if (n > 0) stroke.first = strokes_[strokes.place(n - 1)].first + strokes_[strokes.place(n - 1)].pieces;

  sites.stopSettling(piece);
  keep(strokes, bodies, sites, piece);
  for (std::size_t other = 0; other < bodies.pieces(); ++other)
    if (sites.isSettling(other)) keep(strokes, bodies, sites, other);
}

void LuxationStrokes::keep(StrokeHistory& strokes, const Bodies& bodies, const PieceSites& sites,
                           std::size_t piece) noexcept {
  assert(isOpen());
  Stroke& stroke = strokes_[*open_];
  for (std::size_t n = 0; n < stroke.pieces; ++n)
    if (kept(stroke, n).piece == piece) return;

  // Room for one more: the open stroke itself keeps few.
  const auto used = [&] {
    std::size_t oldest = 0;
    while (!strokes.isMarked(oldest)) ++oldest;
    return stroke.first + stroke.pieces - strokes_[strokes.place(oldest)].first;
  };
  while (used() >= kept_.size()) strokes.dropOldest();
  Kept& now = kept(stroke, stroke.pieces++);
  now.piece = piece;
  sites.remember(bodies, piece, now.before);
}

void LuxationStrokes::end(const Bodies& bodies, PieceSites& sites) noexcept {
  sites.stopSettling();
  close(bodies, sites);
}

void LuxationStrokes::close(const Bodies& bodies, const PieceSites& sites) noexcept {
  if (!isOpen()) return;
  Stroke& stroke = strokes_[*open_];
  for (std::size_t n = 0; n < stroke.pieces; ++n) {
    Kept& now = kept(stroke, n);
    sites.remember(bodies, now.piece, now.after);
  }
  stroke.torn_after_Nmm = sites.tornTotal_Nmm();
  open_.reset();
}

void LuxationStrokes::undo(std::size_t place, Bodies& bodies, PieceSites& sites) const noexcept {
  const Stroke& stroke = strokes_[place];
  for (std::size_t n = 0; n < stroke.pieces; ++n) sites.putBack(bodies, kept(stroke, n).piece, kept(stroke, n).before);
  sites.putBackTornTotal(stroke.torn_before_Nmm);
}

void LuxationStrokes::redo(std::size_t place, Bodies& bodies, PieceSites& sites) const noexcept {
  const Stroke& stroke = strokes_[place];
  for (std::size_t n = 0; n < stroke.pieces; ++n) sites.putBack(bodies, kept(stroke, n).piece, kept(stroke, n).after);
  sites.putBackTornTotal(stroke.torn_after_Nmm);
}

const PieceMemory* LuxationStrokes::newestOf(const StrokeHistory& strokes, std::size_t piece) const noexcept {
  for (std::size_t n = isOpen() ? 0 : strokes.strokes(); n > 0; --n) {
    if (!strokes.isMarked(n - 1)) continue;
    const Stroke& stroke = strokes_[strokes.place(n - 1)];
    for (std::size_t at = 0; at < stroke.pieces; ++at)
      if (kept(stroke, at).piece == piece) return &kept(stroke, at).after;
  }
  return nullptr;
}

std::size_t LuxationStrokes::bytes() const { return kept_.size() * sizeof(Kept); }

}  // namespace haptics
