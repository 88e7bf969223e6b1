#include "app/evaluation/seat/follower.h"

#include <utility>

#include "app/station/session_case.h"

namespace app {

Follower::Follower(StoredStart start, std::vector<std::string> ids)
    : start_(std::move(start)),
      about_(ids.empty() ? SessionCase() : caseOfSession(start_)),
      bodies_(bodiesAtStart(start_)),
      rerun_(bodies_, start_.soft_tissue, {}),
      measures_(start_, about_, bodies_, std::move(ids)) {
  rerun_.expectMore();
}

std::optional<std::string> Follower::step(const haptics::Tick& input) {
  auto why = rerun_.prepare(input);
  tick_ = rerun_.step(input);
  measures_.add(tick_, rerun_.command(), bodies_);
  return why;
}

}  // namespace app
