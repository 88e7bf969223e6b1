// Debrief: the session's moments on one bar, which the keys and the marks move along; the fixed questions, whose answers
// may be typed here or on the participant's page.

import { steered } from "./evaluator_keys.js";
import { minutes } from "./format.js";
import { h } from "./h.js";
import { wordsQuestions } from "./words.js";

const kSigns = { note: "•", error: "▲", bookmark: "⚑", task: "■" };

export function debriefPanel(app) {
  return h("section", { class: "panel debrief", key: "debrief", "aria-label": "debrief" }, questions(app));
}

/** Below the picture, in place of the curves; none where nothing is replayed. */
export function moments(app) {
  const { debrief } = app.state;
  return debrief ? bar(app, debrief) : null;
}

function bar(app, { duration_s, t_s, playing, speed, marks = [] }) {
  const place = (s) => `${(100 * Math.min(1, Math.max(0, s / Math.max(duration_s, 1e-9)))).toFixed(2)}%`;
  const key = (name, label, title) => h("button", { key: name, title, onclick: () => steered(app, name) }, label);
  return h(
    "div",
    { key: "bar", class: "moments" },
    h("h2", {}, h("b", {}, minutes(t_s)), h("span", { class: "quiet" }, ` of ${minutes(duration_s)} min, ${speed}×${playing ? ", playing" : ""}`)),
    h(
      "div",
      { class: "line", "aria-hidden": "true", onclick: (event) => app.steer("seek", (duration_s * event.offsetX) / event.currentTarget.clientWidth) },
      h("span", { class: "passed", style: { width: place(t_s) } }),
      marks.map((mark, n) => h("i", { key: `${n} ${mark.type}`, class: `mark ${mark.type}`, title: `${minutes(mark.t_s)} ${mark.text ?? ""}`, style: { left: place(mark.t_s) } }, kSigns[mark.type] ?? "•")),
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

function questions(app) {
  const asked = (app.state.questionnaires ?? []).filter((one) => one.words);
  return asked.map((one) => h("div", { key: one.id, class: "words" }, h("h2", {}, one.title, " ", h("a", { href: "/participant" }, h("kbd", {}, "0"), " on the participant’s page"), one.locked && h("span", { class: "tag green" }, "submitted")), wordsQuestions(app, one)));
}
