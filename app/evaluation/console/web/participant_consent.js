// Consent, stream by stream in plain words: each has yes or no, none is chosen before, and each may be changed.

import { h } from "./h.js";
import { paragraphs } from "./paragraphs.js";

export function consentForm(app) {
  const { state } = app;
  const { text = "", streams = [] } = state.consent ?? {};
  const open = streams.filter((one) => given(app, one) === null).length;
  return h(
    "section",
    { key: "consent", class: "consent" },
    h("h1", {}, "Before we begin"),
    h("div", { class: "consent-text scrolls", tabindex: "0", role: "region", "aria-label": "what you are asked to allow" }, paragraphs(text)),
    h("div", { class: "streams" }, streams.map((one) => stream(app, one))),
    h("p", { class: open > 0 ? "quiet remains" : "remains green", role: "status" }, open > 0 ? `${open} of ${streams.length} still to decide. Tab goes on, arrows or Y and N choose.` : "Thank you. All is decided; you may change it at any time."),
  );
}

// The newest word, said here or known to the station.
function given(app, one) {
  const said = app.outbox.told.filter((event) => event.type === "consent" && event.data.stream === one.id).at(-1);
  return said ? said.data.given : (one.given ?? null);
}

function stream(app, one) {
  const now = given(app, one);
  const choice = (value, name) =>
    h(
      "label",
      { key: name, class: now === value ? "chosen" : "" },
      h("input", { type: "radio", name: `stream-${one.id}`, value: name, checked: now === value, onchange: (event) => app.say("consent", { stream: one.id, given: value }, app.at(event)) }),
      h("span", {}, name === "yes" ? "Yes" : "No"),
    );
  return h("fieldset", { key: one.id, "data-stream": one.id, class: now === null ? "todo" : "" }, h("legend", {}, one.say), h("div", { class: "choices" }, choice(true, "yes"), choice(false, "no")));
}
