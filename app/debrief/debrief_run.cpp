#include "app/debrief/debrief_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "app/case/closed_gum.h"
#include "app/case/gutter_plan.h"
#include "app/case/patient_placement.h"
#include "app/case/trough_plan.h"
#include "app/procedure/socket/socket_watch.h"
#include "app/session/flap_event.h"
#include "app/station/session_patient.h"
#include "app/station/session_risks.h"

namespace app {
namespace {

/// Twice only as long as they are few.
void addBricks(std::vector<glm::ivec3>& to, const std::vector<glm::ivec3>& bricks) {
  constexpr std::size_t kFew = 50'000;
  const bool were_few = to.size() <= kFew;
  to.insert(to.end(), bricks.begin(), bricks.end());
  if (!were_few || to.size() <= kFew) return;
  const auto in_order = [](glm::ivec3 a, glm::ivec3 b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); };
  std::ranges::sort(to, in_order);
  to.erase(std::unique(to.begin(), to.end()), to.end());
}

}  // namespace

DebriefRun::DebriefRun(const std::string& session, const std::string& patient_folder)
    : path_(session),
      moments_(session),
      risks_(risksOfSession(moments_.start(), patientWithinSession(moments_.start()))),
      story_(moments_.events(), risks_) {
  const StoredStart& start = moments_.start();
  std::optional<assets::Patient> known = patientOfSession(start, patient_folder);
  has_patient_ = known.has_value();
  patient_ = known ? std::move(*known) : patientWithinSession(start);
  const double bur_mm = start.setup.tray.empty() ? kUsualBurRadius_mm : start.setup.tray.front().head.radius_mm;
  if (has_patient_ && patient_.site)
    if (const auto planned = plannedCut(patient_, bur_mm); planned && planned->kind == CutKind::gutter)
      cut_ = planned->cut;
  for (const SessionEvent& event : moments_.events()) {
    if (event.kind == kFlapEvent) recorded_flap_ = flapFrom(event.text);
    if (event.kind != kSecondHandEvent) continue;
    if (const auto place = secondHandFrom(event.text))
      second_hand_.add(static_cast<double>(event.tick) * start.dt_s, *place);
  }
  site_.emplace(patient_, moments_.bodies(), start.soft_tissue, down_P());
  if (recorded_flap_ && has_patient_ && cut_) beginFlap(start);
}

glm::dvec3 DebriefRun::down_P() const {
  if (const auto& recorded = moments_.start().setup.down_P) return *recorded;
  return glm::conjugate(placePatientAtSite(patient_, patient_.X_PF.value_or(assets::kFaceAxes_PF)).rotation) *
         glm::dvec3(0.0, -1.0, 0.0);
}

void DebriefRun::beginFlap(const StoredStart& start) {
  auto gum = closedGum(patient_);
  if (!gum) return;
  patient_.gingiva = std::move(*gum);
  flap_.emplace(patient_, *cut_, patient_.gingiva, start.soft_tissue, down_P());
}

bool DebriefRun::prepare(double most_s) {
  haptics::Tick newest;
  const bool goes_on = moments_.index(most_s, [&](const haptics::Tick& tick, const haptics::Command& command) {
    story_.follow(tick, command);
    if (flap_) flap_->follow(tick, command);
    site_->follow(tick, command);
    if (site_->looks(tick.t_s)) lookAtSite(tick);
    prepared_s_ = tick.t_s + tick.dt_s;
    newest = tick;
  });
  // What has changed since, before a picture takes it.
  if (newest.dt_s > 0.0) lookAtSite(newest);
  return goes_on;
}

void DebriefRun::lookAtSite(const haptics::Tick& tick) {
  const std::vector<glm::ivec3> bricks = moments_.takeChangedBricks();
  site_->look(tick, bricks);
  addBricks(changed_, bricks);
}

const std::vector<SharpEdge>* DebriefRun::sharpEdges(Look look) {
  constexpr double kBetweenLooks_s = 1.0;
  const haptics::Tick& tick = moments_.tick();
  EdgesSeen now{tick.t_s, tick.bone_digest, {}, {}};
  for (std::size_t piece = 0; piece < tick.pieces; ++piece)
    now.is_out[piece] = haptics::Bodies::isAside(tick.X_PQ[piece]);
  if (std::ranges::none_of(now.is_out, std::identity{}) || !patient_.site || patient_.ct.label.empty()) return nullptr;
  const bool is_same = edges_seen_ && edges_seen_->bone_digest == now.bone_digest && edges_seen_->is_out == now.is_out;
  const bool is_near = edges_seen_ && std::abs(edges_seen_->t_s - now.t_s) < kBetweenLooks_s;
  if (!is_same && (look == Look::now || (look == Look::each_second && !is_near))) {
    SocketWatch watch(patient_, patient_.ct.solid, moments_.bodies());
    if (const auto& found = watch.finish({}, tick)) now.edges = found->edges;
    edges_seen_ = std::move(now);
  } else if (!is_same && !is_near) {
    return nullptr;
  }
  return edges_seen_->edges ? &*edges_seen_->edges : nullptr;
}

Bookmarks& DebriefRun::bookmarks() {
  if (!bookmarks_) bookmarks_.emplace(Bookmarks::fileFor(path_));
  return *bookmarks_;
}

std::vector<glm::ivec3> DebriefRun::takeChangedBricks() {
  std::vector<glm::ivec3> bricks = moments_.takeChangedBricks();
  addBricks(bricks, std::exchange(changed_, {}));
  return bricks;
}

std::string DebriefRun::name() const { return std::filesystem::path(path_).filename().string(); }

std::vector<SessionMark> DebriefRun::marks() const {
  std::vector<SessionMark> marks = story_.marks();
  if (!bookmarks_) return marks;
  constexpr double kSame_s = 0.05;
  for (const Bookmark& one : bookmarks_->all()) {
    const auto words =
        std::ranges::find_if(words_, [&](const Bookmark& other) { return std::abs(other.t_s - one.t_s) < kSame_s; });
    const std::string& note = words != words_.end() ? words->note : one.note;
    marks.push_back({one.t_s, MarkKind::bookmark, note.empty() ? "bookmark" : note});
  }
  std::ranges::stable_sort(marks, {}, &SessionMark::t_s);
  return marks;
}

std::vector<std::string> DebriefRun::remarks() const {
  std::vector<std::string> remarks;
  if (!has_patient_)
    remarks.push_back(moments_.start().setup.built_in
                          ? "of another version of the built-in patient: jaw and teeth alone are shown"
                          : "imported patient: jaw and teeth alone are shown, --patient FOLDER adds face and gum");
  if (recorded_flap_ && !flap_) remarks.push_back("incision and flap are not shown: they need the patient's folder");
  if (flap_ && isPrepared() && flap_->digest() != recorded_flap_->digest)
    remarks.push_back("the flap lies otherwise than it was recorded, as the patient was placed otherwise");
  if (const auto& difference = moments_.difference())
    remarks.push_back(fmt::format("from tick {} on {}: bone and forces are as run again by this version",
                                  difference->tick, difference->what));
  return remarks;
}

}  // namespace app
