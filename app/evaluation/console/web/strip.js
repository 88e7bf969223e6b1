// The strip on top: who, which task, its time, what is recorded, how the servo and the link are. Red and amber are words
// too, never a colour alone.

import { minutes, number } from "./format.js";
import { h } from "./h.js";

const kAmber_ms = 30;

export function strip(app) {
  const { state } = app;
  return h(
    "header",
    { key: "strip", class: "strip" },
    h("h1", { class: "who" }, state.participant, h("span", { class: "quiet" }, ` · visit ${state.visit}`)),
    place(state),
    time(state),
    h("ul", { class: "lamps", "aria-label": "state of the station" }, recording(state), servo(state), seat(state), voice(state), link(app)),
  );
}

function place(state) {
  const { task, phase } = state;
  const name = phase === "tasks" && task ? `${task.id} (${task.place}/${task.of})` : phase;
  return h("span", { key: "place", class: "place", title: state.title }, name);
}

function time(state) {
  const { task, warm_up, phase } = state;
  if (phase === "warm-up" && warm_up) return h("span", { key: "time", class: "time" }, `${minutes(warm_up.left_s)} min left`);
  if (phase !== "tasks" || !task) return h("span", { key: "time", class: "time" });
  const box = task.time_box_s > 0 ? ` of ${minutes(task.time_box_s)}` : "";
  return h(
    "span",
    { key: "time", class: `time${task.box_over ? " amber" : ""}` },
    h("b", {}, minutes(task.elapsed_s)),
    `${box} min`,
    task.paused && h("span", { class: "tag amber" }, "paused"),
    task.box_over && h("span", { class: "tag amber" }, "time is over"),
  );
}

function lamp(name, light, ...words) {
  return h("li", { key: name, class: `lamp ${name} ${light}` }, h("i", { "aria-hidden": "true" }, light === "red" ? "▲" : "●"), h("span", {}, ...words));
}

function recording(state) {
  return lamp("recording", state.recording ? "record" : "dim", state.recording ? "REC" : "not recording");
}

function servo({ servo }) {
  if (!servo) return null;
  const missed = servo.missed ?? 0;
  return lamp("servo", missed > 0 ? "amber" : "green", `servo ${number(servo.rate_Hz, 0)} Hz, ${missed} missed`);
}

function seat({ seat }) {
  if (!seat) return null;
  return lamp("seat", seat.lag_ms > 1000 ? "amber" : "green", `bone +${number(seat.lag_ms, 0)} ms`);
}

function voice({ voice }) {
  if (!voice) return null;
  return lamp("voice", voice.speech ? "green" : "dim", `voice ${number(voice.level_dB, 0)} dB`);
}

function link(app) {
  if (!app.link.is_up) return lamp("link", "red", "link lost");
  const round_ms = app.clock.recent_ms;
  if (round_ms === null) return lamp("link", "amber", "link …");
  return lamp("link", round_ms > kAmber_ms ? "amber" : "green", `link ${number(round_ms, round_ms < 9.5 ? 1 : 0)} ms`);
}
