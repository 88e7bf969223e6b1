#include "app/procedure/site_desk.h"

#include <chrono>
#include <utility>

namespace app {
void SiteDesk::begin(const haptics::Tick& newest) {
  Job job;
  job.digest = newest.bone_digest;
  std::vector<haptics::SocketScene> scenes;
  for (std::size_t n = 0; n < newest.pieces; ++n) {
    if (haptics::Bodies::isAside(newest.X_PQ[n])) continue;
    job.pieces.push_back(n);
    scenes.push_back(sockets_.scene(n, newest.X_PQ));
  }
  job.made = std::async(std::launch::async, [this, first = first_socket_.get(), scenes = std::move(scenes)] {
    Made made;
    if (first == nullptr) made.first_socket = std::make_unique<haptics::DistanceField>(sockets_.firstSocket());
    const haptics::DistanceField& socket = first == nullptr ? *made.first_socket : *first;
    for (const haptics::SocketScene& scene : scenes) made.sites.push_back(haptics::makePieceSite(scene, socket));
    return made;
  });
  job_.emplace(std::move(job));
}

std::optional<haptics::SiteOrder> SiteDesk::follow(const haptics::Tick& newest, bool luxates, bool waits) {
  if (newest.pieces == 0 || newest.dt_s == 0.0) return {};
  const bool is_quiet = std::exchange(last_digest_, newest.bone_digest) == newest.bone_digest;

  // The answer to the last order; what was replaced is no longer used.
  if (asked_) {
    auto& given = given_[*asked_];
    if (newest.site == haptics::SiteAnswer::refused) {
      given.pop_back();
      to_order_.clear();
      made_for_ = 0;
    } else if (given.size() > 1) {
      given.erase(given.begin(), given.end() - 1);
    }
    asked_.reset();
  }
  if (!is_quiet || newest.gripped != 0 || newest.lever.piece != 0) {
    ready_ = false;
    // An undo may bring back the bodies for which not every site was ordered.
    if (!to_order_.empty()) made_for_ = 0;
    to_order_.clear();
    if (job_ && !job_->confirmed) job_->spoiled = true;
    return {};
  }
  if (!luxates) return {};

  if (job_ && !job_->spoiled && job_->digest == newest.bone_digest) job_->confirmed = true;
  if (!job_ && to_order_.empty() && made_for_ != newest.bone_digest) {
    begin(newest);
    if (!waits) return {};
    // Nothing is written while a stepped servo waits.
    job_->confirmed = true;
  }
  if (job_ && (waits || job_->made.wait_for(std::chrono::seconds(0)) == std::future_status::ready)) {
    Job job = std::move(*job_);
    job_.reset();
    Made made = job.made.get();
    if (made.first_socket) first_socket_ = std::move(made.first_socket);
    if (job.digest != newest.bone_digest || !job.confirmed) return {};
    for (std::size_t n = 0; n < made.sites.size(); ++n) to_order_.emplace_back(job.pieces[n], std::move(made.sites[n]));
    made_for_ = job.digest;
  }
  if (to_order_.empty()) {
    ready_ = made_for_ == newest.bone_digest;
    return {};
  }
  auto [piece, site] = std::move(to_order_.back());
  to_order_.pop_back();
  given_[piece].push_back(std::move(site));
  asked_ = piece;
  return haptics::SiteOrder{0, newest.bone_digest, piece, given_[piece].back().get()};
}

}  // namespace app
