// Prepare: the checks, each with its light and words; a red one says why the session cannot begin.

import { h } from "./h.js";
import { hold, phases } from "./phases.js";

const kSigns = { green: "✓", amber: "!", red: "✕" };

export function prepareScreen({ state }) {
  return h(
    "div",
    { class: "plain", key: "prepare" },
    phases(state),
    h("h2", { class: "title" }, state.title),
    h("p", { class: "quiet" }, `Participant ${state.participant}, visit ${state.visit}, evaluator ${state.evaluator || "–"}`),
    h(
      "ul",
      { class: "checks", "aria-label": "checks" },
      (state.checks ?? []).map((check) =>
        h("li", { key: check.name, class: check.light }, h("i", { role: "img", "aria-label": check.light }, kSigns[check.light] ?? "?"), h("b", {}, check.name), h("span", {}, check.words)),
      ),
    ),
    (state.checks ?? []).length === 0 && h("p", { class: "quiet" }, "The station is being looked at…"),
    hold(state),
  );
}
