#include "app/debrief/site_film.h"

#include <algorithm>
#include <utility>

namespace app {
namespace {

bool areSame(const render::SoftMarks& a, const render::SoftMarks& b) {
  const auto same_cut = [](const render::SoftCut& x, const render::SoftCut& y) {
    return x.from_P.mm == y.from_P.mm && x.to_P.mm == y.to_P.mm && x.radius_mm == y.radius_mm;
  };
  const auto same_red = [](const render::Reddened& x, const render::Reddened& y) {
    return x.place_P.mm == y.place_P.mm && x.share == y.share;
  };
  return std::ranges::equal(a.cuts, b.cuts, same_cut) && std::ranges::equal(a.reddened, b.reddened, same_red);
}

}  // namespace

SiteFilm::SiteFilm(const assets::Patient& patient, const haptics::Bodies& bodies,
                   const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P)
    : loose_(patient, bodies, soft_tissue, down_P) {}

void SiteFilm::follow(const haptics::Tick& tick, const haptics::Command& command) {
  loose_.follow(tick, command);
  soft_marks_.follow(std::span(&tick, 1), command.tool.head);
  // Loose from the tick on that says so.
  if (tick.chips != haptics::ChipAnswer::done || command.chips.serial == loosened_ || command.chips.plan == nullptr)
    return;
  loosened_ = command.chips.serial;
  loose_.loosen(*command.chips.plan, tick);
}

void SiteFilm::look(const haptics::Tick& tick, std::span<const glm::ivec3> bricks) {
  next_look_s_ = tick.t_s + kBetweenLooks_s;
  loose_.followBone(bricks, tick);
  const double now_s = tick.t_s + tick.dt_s;
  if (!film_.isDue(now_s)) return;
  Shown shown{loose_.beads(), soft_marks_.marks()};
  if (const auto* const newest = film_.newest();
      newest != nullptr && newest->content.beads == shown.beads && areSame(newest->content.marks, shown.marks))
    return;
  film_.keep(now_s, std::move(shown));
}

void SiteFilm::show(double t_s, render::Frame& frame) const {
  frame.marks = {};
  const auto* const picture = film_.at(t_s);
  if (picture == nullptr) return;
  frame.marks = picture->content.marks;
  frame.beads.insert(frame.beads.end(), picture->content.beads.begin(), picture->content.beads.end());
}

}  // namespace app
