// Debrief: the session's moments on one bar, which the keys and the marks move along; the fixed questions, whose answers
// may be typed here or on the participant's page.

import { goTo, position, steered } from "./evaluator_keys.js";
import { minutes, withUnit } from "./format.js";
import { h } from "./h.js";
import { wordsQuestions } from "./words.js";

const kSigns = { note: "•", error: "▲", bookmark: "⚑", task: "■", problem: "!", help: "?", prompt: "▸" };
const kBetweenDrags_ms = 60;

let dragged_ms = -Infinity;
let is_dragged = false;

export function debriefPanel(app) {
  return h("section", { class: "panel debrief", key: "debrief", "aria-label": "debrief" }, questions(app));
}

/** Below the picture, in place of the curves; none where nothing is replayed. */
export function moments(app) {
  const { debrief, debrief_trouble: trouble } = app.state;
  if (trouble) return h("p", { key: "bar", class: "moments amber" }, `The recording is not shown: ${trouble}. The questions can be asked all the same.`);
  if (!debrief) return null;
  if (debrief.prepared < 1) return prepares(debrief);
  return bar(app, debrief);
}

function prepares({ prepared }) {
  const percent = Math.floor(100 * prepared);
  return h(
    "div",
    { key: "bar", class: "moments" },
    h("h2", {}, "The recording is run again for the surgeon’s display: ", h("b", {}, `${percent} %`)),
    h("span", { class: "bar", "aria-hidden": "true" }, h("span", { class: "part calm", style: { width: `${percent}%` } })),
  );
}

// A hand on the bar: roughly while it moves, the moment itself where it lets go.
function drag(app, duration_s, event) {
  const line = event.currentTarget;
  if (event.type === "pointerdown") {
    if (event.button !== 0) return;
    is_dragged = true;
    line.setPointerCapture(event.pointerId);
  }
  if (!is_dragged) return;
  const box = line.getBoundingClientRect();
  const t_s = (duration_s * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)));
  if (event.type === "pointerup" || event.type === "pointercancel") {
    is_dragged = false;
    goTo(app, t_s);
  } else if (event.timeStamp - dragged_ms > kBetweenDrags_ms) {
    dragged_ms = event.timeStamp;
    goTo(app, t_s, "scrub");
  }
}

function bar(app, { duration_s, playing, speed, tick, force_N, removed_mm3, bone_digest, marks = [], ...debrief }) {
  const t_s = position(app);
  const place = (s) => `${(100 * Math.min(1, Math.max(0, s / Math.max(duration_s, 1e-9)))).toFixed(2)}%`;
  const key = (name, label, title) => h("button", { key: name, title, onclick: () => steered(app, name) }, label);
  const hand = (event) => drag(app, duration_s, event);
  return h(
    "div",
    { key: "bar", class: "moments", "data-at": String(debrief.t_s), "data-tick": String(tick), "data-digest": bone_digest },
    h(
      "h2",
      {},
      h("span", {}, h("b", {}, minutes(t_s)), h("span", { class: "quiet" }, ` of ${minutes(duration_s)} min, ${speed}×${playing ? ", playing" : ""}`)),
      // Every digit of them: as `molar replay --to … --json` prints it.
      h("span", { class: "figures" }, figure("force", force_N, "N", tick), figure("removed", removed_mm3, "mm3", tick)),
    ),
    h(
      "div",
      { key: "line", class: "line", "aria-hidden": "true", onpointerdown: hand, onpointermove: hand, onpointerup: hand, onpointercancel: hand },
      h("span", { class: "passed", style: { width: place(t_s) } }),
      marks.map((mark, n) => h("i", { key: `${n} ${mark.type}`, class: `mark of-${mark.type}`, style: { left: place(mark.t_s) } }, kSigns[mark.type] ?? "•")),
      h("span", { class: "hand", style: { left: place(t_s) } }),
    ),
    h(
      "div",
      { class: "steer" },
      key(",", "‹ mark", "mark before (,)"),
      key("ArrowLeft", "−1 s", "one second back (←)"),
      key(" ", playing ? "stand" : "play", playing ? "stand (space)" : "play (space)"),
      key("ArrowRight", "+1 s", "one second on (→)"),
      key(".", "mark ›", "mark after (.)"),
      key("-", "slower", "slower (−)"),
      key("+", "faster", "faster (+)"),
    ),
  );
}

function figure(name, value, unit, tick) {
  return h("span", { key: name, class: "figure", "data-value": String(value), title: `${value} ${unit} at tick ${tick}` }, `${name} `, h("b", { class: name }, withUnit(value, unit, name === "force" ? 2 : 1)));
}

function questions(app) {
  const asked = (app.state.questionnaires ?? []).filter((one) => one.words);
  return asked.map((one) => h("div", { key: one.id, class: "words" }, h("h2", {}, one.title, " ", h("a", { href: "/participant" }, h("kbd", {}, "0"), " on the participant’s page"), one.locked && h("span", { class: "tag green" }, "submitted")), wordsQuestions(app, one)));
}
