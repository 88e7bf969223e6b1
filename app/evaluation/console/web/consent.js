// Consent as the evaluator sees it: the text, and what the participant has said to each stream. The participant answers
// on the page turned to them.

import { h } from "./h.js";
import { paragraphs } from "./paragraphs.js";
import { hold, phases } from "./phases.js";

export function consentScreen(app) {
  const { state } = app;
  const { text = "", streams = [] } = state.consent ?? {};
  return h(
    "div",
    { class: "plain", key: "consent" },
    phases(state),
    h("h2", { class: "title" }, "Consent"),
    h("p", { class: "quiet" }, "Turn the participant’s page to the participant: ", h("a", { href: "/participant" }, h("kbd", {}, "0"), ` ${location.host}/participant`)),
    h(
      "div",
      { class: "pair" },
      h("div", { class: "consent-text scrolls", tabindex: "0", role: "region", "aria-label": "consent text", lang: state.language }, paragraphs(text)),
      h("ul", { class: "checks streams", "aria-label": "streams" }, streams.map(stream)),
    ),
    hold(state),
  );
}

function stream({ id, say, given }) {
  const [light, sign, words] = given === true ? ["green", "✓", "yes"] : given === false ? ["no", "–", "no"] : ["todo", "?", "not asked yet"];
  return h("li", { key: id, class: light }, h("i", { "aria-hidden": "true" }, sign), h("b", {}, id), h("span", {}, say, h("em", {}, ` ${words}`)));
}
