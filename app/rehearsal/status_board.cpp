#include "app/rehearsal/status_board.h"

#include "app/options/tool_text.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kShownEvery{500};
constexpr std::chrono::seconds kLatencyNotedEvery{5};

}  // namespace

StatusBoard::StatusBoard(const RehearsalPlan& plan, Equipment& equipment, LivePicture& picture, RunMonitor& monitor,
                         Journal& journal)
    : plan_(plan), equipment_(equipment), picture_(picture), monitor_(monitor), journal_(journal) {
  if (plan.operators_window)
    operator_.emplace(picture.display(), plan.rig, plan.monitor.value_or(0), [&journal](const std::string& line) {
      journal.tell({"display", line});
    });
}

RehearsalStatus StatusBoard::status(const Moment& moment) {
  RehearsalStatus s = statusOf(plan_);
  s.bur = textOf(moment.in_force.tool.head);
  s.tick = moment.newest;
  s.command = moment.in_force;
  s.layers = moment.layers;
  if (plan_.procedure) {
    const ProcedureWords words = plan_.procedure->words();
    s.to_surgeon = words.to_surgeon;
    s.to_instructor = words.to_instructor;
  }
  equipment_.describe(s);
  picture_.describe(s);
  monitor_.describe(s);
  return s;
}

void StatusBoard::show(Time now, const Moment& moment) {
  if (now - shown_ < kShownEvery) return;
  shown_ = now;
  picture_.measureRate(now);
  for (const Notice& notice : monitor_.look(equipment_.health(), moment.newest)) journal_.tell(notice);
  render::Window* const window = picture_.window();
  if (window == nullptr) return;
  if (now - latency_noted_ > kLatencyNotedEvery && picture_.latency().pictures() > 0) {
    latency_noted_ = now;
    journal_.note("latency", photonText(picture_.latency().now()));
  }
  window->setTitle(statusLine(status(moment)));
}

OperatorSeat::Heard StatusBoard::serveOperator(const Moment& moment) {
  if (!operator_) return {};
  operator_->keepOpen();
  return operator_->isDue() ? operator_->serve(status(moment)) : OperatorSeat::Heard{};
}

void StatusBoard::tellEnd(Ending ending) {
  if (ending == Ending::silent)
    journal_.tell({"device", "the device has not ticked for 10 s, so the rehearsal ends; check its cable and driver"});
  if (picture_.latency().pictures() > 0) journal_.note("latency", "median " + photonText(picture_.latency().median()));
  Workstation& station = equipment_.workstation();
  journal_.note("end", textOf(ending));
  journal_.note("servo", punctualityText(station.figures()));
  journal_.note("safety", "trips: " + tripsText(station.trips()));
}

RehearsalFigures StatusBoard::figures(const Moment& moment) {
  RehearsalFigures figures;
  figures.ticking = plan_.ticking;
  figures.last = status(moment);
  figures.last.trips = equipment_.workstation().trips();
  figures.removed_mm3 = equipment_.workstation().bone().removedByTissue_mm3();
  picture_.describe(figures);
  return figures;
}

}  // namespace app
