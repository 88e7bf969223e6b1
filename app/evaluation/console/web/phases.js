// Where the session stands: the phases in a row, the present one marked.

import { h } from "./h.js";

export function phases({ phases: all = [], phase }) {
  const now = all.indexOf(phase);
  return h(
    "ol",
    { key: "phases", class: "phases", "aria-label": "phases" },
    all.map((name, n) =>
      h("li", { key: name, class: n < now ? "done" : n === now ? "now" : "", "aria-current": n === now ? "step" : null }, h("i", { "aria-hidden": "true" }, n < now ? "✓" : String(n + 1)), name),
    ),
  );
}

/** What is missing before the next phase, or that nothing is. */
export function hold({ may_continue, hold: words }) {
  const missing = !may_continue && words;
  return h("p", { key: "hold", class: missing ? "hold amber" : "hold green" }, missing ? words : "All is there: 9 goes on.");
}
