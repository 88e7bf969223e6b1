#include "app/session/rerun.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "haptics/body/bridge_break.h"
#include "haptics/body/piece_split.h"

namespace app {
namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const glm::dvec3& a, const glm::dvec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

bool same(const haptics::SoftTouch& a, const haptics::SoftTouch& b) {
  return a.tissue == b.tissue && a.bur_cuts == b.bur_cuts && a.tissues == b.tissues && same(a.depth_mm, b.depth_mm) &&
         same(a.place_P.mm, b.place_P.mm) && same(a.force_P_N.xyz, b.force_P_N.xyz) &&
         same(a.torque_P_Nmm.xyz, b.torque_P_Nmm.xyz) && same(a.turn_P.w, b.turn_P.w) &&
         same(glm::dvec3(a.turn_P.x, a.turn_P.y, a.turn_P.z), glm::dvec3(b.turn_P.x, b.turn_P.y, b.turn_P.z));
}

}  // namespace

std::optional<std::string> differenceOf(const haptics::Tick& recorded, const haptics::Tick& again) {
  if (recorded.index != again.index) return "the number of the tick differs";
  if (!same(recorded.t_s, again.t_s) || !same(recorded.dt_s, again.dt_s)) return "the time differs";
  if (recorded.command_serial != again.command_serial) return "the command in force differs";
  if (!same(recorded.proxy_P.mm, again.proxy_P.mm)) return "the proxy differs";
  if (!same(recorded.law_force_P_N.xyz, again.law_force_P_N.xyz)) return "the force of the law differs";
  if (!same(recorded.commanded_force_P_N.xyz, again.commanded_force_P_N.xyz)) return "the force served differs";
  if (!same(recorded.law_torque_P_Nmm.xyz, again.law_torque_P_Nmm.xyz)) return "the torque of the law differs";
  if (!same(recorded.commanded_torque_P_Nmm.xyz, again.commanded_torque_P_Nmm.xyz)) return "the torque served differs";
  if (!same(recorded.energy_Nmm, again.energy_Nmm)) return "the energy differs";
  if (!same(recorded.spindle_rad_per_s, again.spindle_rad_per_s)) return "the speed of the spindle differs";
  if (!same(recorded.overlap_mm3, again.overlap_mm3)) return "the overlap differs";
  if (!same(recorded.depth_mm, again.depth_mm)) return "the depth differs";
  if (!same(recorded.removed_mm3, again.removed_mm3)) return "the removed volume differs";
  if (!(recorded.filling == again.filling)) return "the filling differs";
  if (recorded.bone_digest != again.bone_digest) return "the bone differs";
  if (recorded.contact_tissue != again.contact_tissue) return "the tissue in contact differs";
  if (!same(recorded.soft, again.soft)) return "the contact with soft tissue differs";
  if (recorded.drilling != again.drilling || recorded.drill_inhibit != again.drill_inhibit) return "the drill differs";
  if (recorded.strokes != again.strokes || recorded.undone_strokes != again.undone_strokes)
    return "the strokes to undo or redo differ";
  if (recorded.split != again.split) return "the splitting of the tooth differs";
  if (recorded.bridge != again.bridge || !same(recorded.bridge_share, again.bridge_share) ||
      recorded.broken != again.broken)
    return "the breaking of the bridge differs";
  if (recorded.chips != again.chips) return "the chips that came loose differ";
  if (recorded.site != again.site || recorded.gripped != again.gripped || recorded.set_aside != again.set_aside)
    return "the grip of the forceps differs";
  if (!same(recorded.grip_force_P_N.xyz, again.grip_force_P_N.xyz) ||
      !same(recorded.grip_torque_P_Nmm.xyz, again.grip_torque_P_Nmm.xyz))
    return "the force of the forceps differs";
  if (!(recorded.lever == again.lever)) return "the work of the elevator differs";
  if (!same(recorded.torn_share, again.torn_share) || !same(recorded.torn_total_Nmm, again.torn_total_Nmm))
    return "the tearing of the ligament differs";
  if (!same(recorded.restored_total_mm3, again.restored_total_mm3)) return "the restored volume differs";
  if (recorded.state != again.state) return "the state of the safety layer differs";
  if (recorded.faults != again.faults) return "the faults differ";
  return std::nullopt;
}

Rerun::Rerun(haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue, std::vector<SessionCommand> commands,
             Keeping keeping)
    : bodies_(bodies), keeping_(keeping), sockets_(bodies), commands_(std::move(commands)) {
  servo_.emplace(bodies, &soft_tissue);
  if (std::ranges::any_of(commands_, [](const SessionCommand& one) { return one.command.chips.serial != 0; }))
    first_.emplace(bodies);
}

void Rerun::expectMore() {
  if (!first_) first_.emplace(bodies_);
}

std::optional<std::string> Rerun::prepare(const haptics::Tick& recorded) {
  const std::uint64_t lost = recorded.index - std::exchange(next_index_, recorded.index + 1);
  // Of several for one tick the servo sees the last.
  const haptics::Command before = command_;
  while (next_ < commands_.size() && commands_[next_].first_tick <= recorded.index)
    command_ = commands_[next_++].command;
  command_.split.plan = command_.split.serial == before.split.serial ? before.split.plan : planFor(command_.split);
  command_.bridge.plan =
      command_.bridge.serial == before.bridge.serial ? before.bridge.plan : breakFor(command_.bridge);
  command_.site.site = command_.site.serial == before.site.serial ? before.site.site : siteFor(command_.site);
  command_.chips.plan = command_.chips.serial == before.chips.serial ? before.chips.plan : chipsFor(command_.chips);
  if (lost > 0) return std::to_string(lost) + " ticks before it were lost";
  if (command_.serial != recorded.command_serial) return "its command was not recorded";
  return std::nullopt;
}

haptics::Tick Rerun::step(const haptics::Tick& recorded) {
  const haptics::Tick tick = servo_->step(recorded.hand, command_, recorded.dt_s);
  grips_ = tick.gripped != 0 || tick.lever.piece != 0;
  return tick;
}

Rerun::State Rerun::state() {
  haptics::Servo::Memory memory = servo_->takeMemory();
  State state{*servo_, command_, next_, next_index_, grips_, {}};
  servo_->giveMemory(std::move(memory));
  for (std::size_t piece = 0; piece < haptics::kMaxPieces; ++piece)
    if (const haptics::PieceSite* const site = servo_->sites().inForce(piece)) state.pieces[piece] = site->hold.state();
  return state;
}

void Rerun::restore(const State& state) {
  haptics::Servo::Memory memory = servo_->takeMemory();
  servo_.emplace(state.servo);
  servo_->giveMemory(std::move(memory));
  command_ = state.command;
  next_ = state.next;
  next_index_ = state.next_index;
  grips_ = state.grips;
  for (std::size_t piece = 0; piece < haptics::kMaxPieces; ++piece)
    if (state.pieces[piece]) servo_->sites().inForce(piece)->hold.restore(*state.pieces[piece]);
}

const haptics::SplitPlan* Rerun::planFor(const haptics::SplitOrder& order) {
  const auto [at, is_new] = splits_.try_emplace(next_);
  if (is_new && order.piece < bodies_.pieces() && order.bodies_digest == bodies_.digest()) {
    const haptics::CarvedBone& piece = bodies_.bones()[order.piece + 1];
    at->second = std::make_unique<haptics::SplitPlan>(haptics::partingPlan({piece.grid(), piece.solidInGridOrder()}));
  }
  return at->second.get();
}

const haptics::BreakPlan* Rerun::breakFor(const haptics::BreakOrder& order) {
  const auto [at, is_new] = breaks_.try_emplace(next_);
  if (is_new && order.piece < bodies_.pieces() && order.bodies_digest == bodies_.digest()) {
    const haptics::CarvedBone& piece = bodies_.bones()[order.piece + 1];
    if (auto plan =
            haptics::breakPlan({piece.grid(), piece.solidInGridOrder()}, piece.labelInGridOrder(), order.bridge))
      at->second = std::make_unique<haptics::BreakPlan>(std::move(*plan));
  }
  return at->second.get();
}

/// Found again from what has changed since the last search.
const haptics::ChipPlan* Rerun::chipsFor(const haptics::ChipOrder& order) {
  const auto [at, is_new] = chips_.try_emplace(next_);
  if (!is_new || order.bodies_digest != bodies_.digest()) return at->second.get();
  if (!search_) {
    search_.emplace(*first_);
    first_.reset();
  }
  collectChanged();
  for (const glm::ivec3& brick : std::exchange(unsearched_, {})) haptics::giveBrick(bodies_, brick, *search_);
  at->second = std::make_unique<haptics::ChipPlan>(search_->plan());
  return at->second.get();
}

std::unique_ptr<haptics::PieceSite> Rerun::newSite(const haptics::SiteOrder& order) {
  if (order.piece >= bodies_.pieces() || order.bodies_digest != bodies_.digest() || grips_) return nullptr;
  std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ;
  for (std::size_t n = 0; n < X_PQ.size(); ++n) X_PQ[n] = bodies_.pose(n);
  const haptics::SocketScene scene = sockets_.scene(order.piece, X_PQ);
  // Of a stranger's file: a field has at least a cell.
  if (glm::any(glm::lessThan(scene.around_grid.size, glm::ivec3(2)))) return nullptr;
  if (!first_socket_) first_socket_.emplace(sockets_.firstSocket());
  return haptics::makePieceSite(scene, *first_socket_);
}

haptics::PieceSite* Rerun::siteFor(const haptics::SiteOrder& order) {
  if (keeping_ == Keeping::what_is_in_use) {
    std::unique_ptr<haptics::PieceSite> made = newSite(order);
    if (!made) return nullptr;
    // The servo takes over every order that gets here, and needs the one before until then.
    std::deque<std::unique_ptr<haptics::PieceSite>>& sites = used_sites_[order.piece];
    sites.push_back(std::move(made));
    if (sites.size() > 2) sites.pop_front();
    return sites.back().get();
  }
  const auto [at, is_new] = kept_sites_.try_emplace(next_);
  MadeSite& made = at->second;
  if (is_new) {
    made.site = newSite(order);
    if (made.site) made.first = made.site->hold.state();
  } else if (made.site) {
    made.site->hold.restore(made.first);
  }
  return made.site.get();
}

std::size_t Rerun::siteBytes() const {
  std::size_t all = 0;
  for (const auto& [order, made] : kept_sites_) {
    if (!made.site) continue;
    for (const haptics::DistanceField* const field : {&made.site->obstacles, &made.site->teeth, &made.site->piece})
      all += field->voxels_mm().size_bytes();
    all += 4 * sizeof(float) * made.first.ligament.torn.size();
  }
  return all;
}

void Rerun::collectChanged() {
  std::vector<glm::ivec3> bricks;
  bodies_.takeDirtyBricks(bricks);
  const auto join = [&](std::vector<glm::ivec3>& list) {
    const auto in_order = [](glm::ivec3 a, glm::ivec3 b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); };
    list.insert(list.end(), bricks.begin(), bricks.end());
    std::ranges::sort(list, in_order);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  if (bricks.empty()) return;
  if (first_ || search_) join(unsearched_);
  if (keeping_ == Keeping::all) join(changed_);
}

std::vector<glm::ivec3> Rerun::takeChanged() {
  collectChanged();
  return std::exchange(changed_, {});
}

}  // namespace app
