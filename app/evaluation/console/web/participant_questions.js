// A questionnaire item by item: a digit or the arrows choose, Enter goes on, Backspace goes back; at the end one look at
// what is missing, then submitting locks it. Each answer goes to the station when it is given.

import { digitOf } from "./keys.js";
import { h } from "./h.js";
import { isSubmitted } from "./words.js";

const kMostButtons = 11;
const kSteps = 20;

function answerOf(app, one, item) {
  const said = app.outbox.told.filter(({ type, data }) => type === "answer" && data.questionnaire === one.id && data.item === item.id).at(-1);
  return (said ? said.data.value : one.answers?.[item.id]) ?? null;
}

function firstOpen(app, one) {
  const open = one.items.findIndex((item) => answerOf(app, one, item) === null);
  return open < 0 ? one.items.length : open;
}

/** Where the participant is: the item's number, or that of the items for the last look. */
function place(app, one) {
  if (app.asked?.id !== one.id) app.asked = { id: one.id, n: firstOpen(app, one) };
  return app.asked.n;
}

function go(app, one, n) {
  app.asked = { id: one.id, n: Math.min(Math.max(0, n), one.items.length) };
  app.show();
  // The question is read aloud where somebody listens; at the end the button waits.
  setTimeout(() => (document.getElementById("submit") ?? document.getElementById("asked"))?.focus(), 40);
}

function answer(app, one, item, value, when) {
  const data = { questionnaire: one.id, item: item.id };
  app.say("answer", value === null ? data : { ...data, value }, when);
}

// Of two things that are compared the first is 1, the second 2.
function rangeOf({ choices, from = 1, to = choices?.length ?? 1 }) {
  const is_buttons = to - from < kMostButtons;
  return { from, to, is_buttons, step: is_buttons ? 1 : Math.max(1, Math.round((to - from) / kSteps)) };
}

// The word of the step that is chosen, where each step has one.
function wordOf(item, value) {
  const { from, to } = rangeOf(item);
  return value !== null && item.scale?.length === to - from + 1 && value > from && value < to ? item.scale[value - from] : "";
}

export function questionForm(app, one) {
  const n = place(app, one);
  const done = one.items.filter((item) => answerOf(app, one, item) !== null).length;
  const item = one.items[n];
  return h(
    "section",
    { key: one.id, class: "questions" },
    h("p", { class: "quiet" }, one.title),
    h("div", { class: "bar thin", "aria-hidden": "true" }, h("span", { class: "part calm", style: { width: `${((100 * n) / one.items.length).toFixed(1)}%` } })),
    item ? asked(app, one, item, n) : lastLook(app, one, done),
  );
}

function asked(app, one, item, n) {
  const value = answerOf(app, one, item);
  const { is_buttons, from, to } = rangeOf(item);
  return h(
    "div",
    { key: item.id, class: "asked" },
    h("p", { class: "quiet" }, `${n + 1} of ${one.items.length}`),
    h("h1", { id: "asked", tabindex: "-1" }, item.say),
    is_buttons ? steps(app, one, item, value) : slider(app, one, item, value),
    !item.choices && h("div", { class: "ends" }, h("span", {}, item.low), h("b", {}, wordOf(item, value)), h("span", {}, item.high)),
    h(
      "div",
      { class: "onward" },
      h("button", { onclick: () => go(app, one, n - 1), "aria-disabled": n === 0 ? "true" : null }, "Back"),
      h("button", { class: value === null ? "" : "main", onclick: () => go(app, one, n + 1) }, value === null ? "Leave it out" : "Next"),
    ),
    h("p", { class: "quiet keys-hint" }, is_buttons ? `Keys ${from} to ${Math.min(to, 9)} choose, Enter goes on, Backspace goes back.` : "Arrows move, Enter goes on, Backspace goes back."),
  );
}

function steps(app, one, item, value) {
  const { from, to } = rangeOf(item);
  const all = Array.from({ length: to - from + 1 }, (_, n) => from + n);
  return h(
    "div",
    { class: "steps", role: "radiogroup", "aria-labelledby": "asked" },
    all.map((step) =>
      h(
        "label",
        { key: step, class: value === step ? "chosen" : "" },
        h("input", { type: "radio", name: `q-${one.id}-${item.id}`, value: step, checked: value === step, onchange: (event) => answer(app, one, item, step, app.at(event)) }),
        h("span", {}, item.choices?.[step - from] ?? String(step)),
      ),
    ),
  );
}

function slider(app, one, item, value) {
  const { from, to, step } = rangeOf(item);
  const shown = value ?? Math.round((from + to) / 2);
  return h(
    "div",
    { class: `slider${value === null ? " todo" : ""}` },
    h("output", {}, value === null ? "not chosen" : `${value} of ${to}`),
    h("input", { type: "range", min: from, max: to, step, value: shown, "aria-labelledby": "asked", onchange: (event) => answer(app, one, item, Number(event.target.value), app.at(event)) }),
  );
}

function lastLook(app, one, done) {
  const submit = (event) => app.say("submit", { questionnaire: one.id }, app.at(event));
  const missing = one.items.length - done;
  return h(
    "div",
    { key: "last look", class: "asked" },
    h("h1", { id: "asked", tabindex: "-1" }, missing === 0 ? "All answered. Thank you." : `${done} of ${one.items.length} answered.`),
    h("p", {}, "Once submitted, the answers stay as they are."),
    h("div", { class: "onward" }, h("button", { onclick: () => go(app, one, missing > 0 ? firstOpen(app, one) : one.items.length - 1) }, missing > 0 ? "Back to the first open one" : "Back"), h("button", { id: "submit", class: "main", onclick: submit }, "Submit")),
  );
}

/** A key on the participant's page while a questionnaire is asked. */
export function pressedInQuestions(app, event) {
  const one = (app.state.questionnaires ?? []).find((each) => !each.words && !isSubmitted(app, each));
  if (!one) return;
  const n = place(app, one);
  const item = one.items[n];
  const take = (what) => (event.preventDefault(), what());
  if (event.key === "Backspace") return take(() => go(app, one, n - 1));
  if (!item) return;
  const on_button = event.target.closest("button, a");
  if (event.key === "Enter" && !on_button) return event.repeat ? event.preventDefault() : take(() => go(app, one, n + 1));
  const { from, to, is_buttons, step } = rangeOf(item);
  const digit = Number(digitOf(event));
  if (is_buttons && digitOf(event).length === 1 && digit >= from && digit <= to) return take(() => answer(app, one, item, digit, app.at(event)));
  const moves = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step };
  if (!(event.key in moves)) return;
  const value = answerOf(app, one, item);
  const before = value ?? Math.round((from + to) / 2) - moves[event.key];
  take(() => answer(app, one, item, Math.min(to, Math.max(from, before + moves[event.key])), app.at(event)));
}
