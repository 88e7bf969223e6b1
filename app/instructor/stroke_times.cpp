#include "app/instructor/stroke_times.h"

namespace app {

void StrokeTimes::follow(std::span<const haptics::Tick> ticks) {
  for (const haptics::Tick& tick : ticks) {
    const std::size_t done = tick.strokes, undone = tick.undone_strokes;
    const std::size_t undone_before = begun_s_.size() - done_;
    const double restored_mm3 = tick.restored_total_mm3 - restored_mm3_;
    restored_mm3_ = tick.restored_total_mm3;
    if (done == done_ && undone == undone_before) continue;
    // A new stroke drops what could be redone; a redo takes it back, and nothing works in its tick.
    const bool works = tick.gripped != 0 || tick.lever.piece != 0 || tick.removed_mm3 > 0.0;
    const bool is_redo = done > done_ && undone + (done - done_) == undone_before && (restored_mm3 < 0.0 || !works);
    const bool is_undo = done < done_ && undone > undone_before;
    if (!is_redo && !is_undo) {
      begun_s_.resize(done_);
      for (std::size_t n = done_; n < done; ++n) begun_s_.push_back(tick.t_s);
    }
    // The oldest are dropped.
    while (begun_s_.size() > done + undone) begun_s_.erase(begun_s_.begin());
    while (begun_s_.size() < done + undone) begun_s_.push_back(tick.t_s);
    done_ = done;
  }
}

std::vector<ControlRequest> requestsForStrokes(std::size_t done, std::size_t wanted) {
  const bool undoes = wanted < done;
  return std::vector<ControlRequest>(undoes ? done - wanted : wanted - done,
                                     {undoes ? Control::undo : Control::redo, kNoValue});
}

}  // namespace app
