// The bar below: what each key does now, as buttons too; the next phase; a reminder after silence. And the sheet of keys.

import { contextOf, pressed, takesNotes } from "./evaluator_keys.js";
import { h } from "./h.js";
import { isText, kFreeKeys, kTaskKeys } from "./keys.js";

function button(app, key, name, { on = true, chosen = false, main = false, label = null, title = null } = {}) {
  const press = (event) => pressed(app, key, app.at(event));
  return h(
    "button",
    { key: `${key} ${name}`, class: `key${chosen ? " chosen" : ""}${main ? " main" : ""}`, "aria-label": label, title, "aria-disabled": on ? null : "true", onclick: on ? press : null },
    h("kbd", {}, key === "Escape" ? "Esc" : key),
    name && h("span", {}, name),
  );
}

export function keyBar(app) {
  return h("nav", { key: "keys", class: "keys", "aria-label": "keys" }, buttons(app), h("span", { class: "fill", key: "fill" }, hint(app)), onward(app));
}

function buttons(app) {
  const { line, state } = app;
  if (isText(line)) return [button(app, "Enter", "keep"), button(app, "Escape", "drop")];
  if (line?.open === "task") return [...kTaskKeys.map(([key, name]) => button(app, key, name)), button(app, "Escape", "drop")];
  if (line?.open === "withdraw") {
    const { streams } = contextOf(app);
    return [
      ...streams.map((stream, n) => button(app, String(n + 1), stream, { chosen: line.stream === stream })),
      button(app, "Enter", "withdraw", { on: line.stream !== null }),
      button(app, "Escape", "drop"),
    ];
  }
  if (!takesNotes(state)) return [];
  return kFreeKeys.map(([key, name]) => button(app, key, name, { on: state.writer }));
}

function hint(app) {
  const { line } = app;
  if (isText(line)) return h("span", { class: "quiet" }, h("kbd", {}, "⇧0"), "–", h("kbd", {}, "⇧4"), " severity");
  if (line?.open === "withdraw") return h("span", { class: "amber" }, line.stream ? `“${line.stream}” stops within 1 s: Enter` : "which stream?");
  return null;
}

function onward(app) {
  const { line, state } = app;
  if (line) return null;
  const { phases = [], phase, may_continue, writer, closing } = state;
  const next = phases[phases.indexOf(phase) + 1];
  return [
    button(app, "?", "", { label: "all keys" }),
    next && phase !== "close" && button(app, "9", "go on", { title: `to ${next}`, on: may_continue && writer, main: may_continue && writer }),
    phase === "close" && may_continue && writer && button(app, "9", closing?.done ? "end" : "verify", { main: true }),
  ];
}

export function keySheet(app) {
  const rows = [
    ...kFreeKeys,
    ["9", "go on to the next phase"],
    ["0", "the participant’s page"],
    ["↑ ↓", "mark another prompt"],
    ["⇧0 … ⇧4", "severity, in an open line"],
    ["Enter, Esc", "keep or drop the line"],
    ["← →", "debrief: 1 s back, on"],
    ["space", "debrief: play, stand"],
    [", .", "debrief: mark before, after"],
    ["− +", "debrief: slower, faster"],
  ];
  return h(
    "section",
    { key: "sheet", class: "sheet", role: "dialog", "aria-label": "keys" },
    h("h2", {}, "Keys"),
    h("dl", {}, rows.map(([key, does]) => h("div", { key }, h("dt", {}, h("kbd", {}, key)), h("dd", {}, does)))),
    h("p", { class: "quiet" }, "In a task: 5, then 1 success, 2 partly, 3 failed, 4 pause, 5 next. A note has the time of its first letter."),
    h("button", { onclick: () => ((app.sheet = false), app.show()) }, h("kbd", {}, "Esc"), " close"),
  );
}
