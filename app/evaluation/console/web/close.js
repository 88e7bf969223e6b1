// Close: the recording verified, the rules looked at again, the tables written.

import { h } from "./h.js";
import { phases } from "./phases.js";

export function closeScreen({ state }) {
  const { closing, tasks = [] } = state;
  return h(
    "div",
    { class: "plain", key: "close" },
    phases(state),
    h("h2", { class: "title" }, closing?.done ? "Done. Thank you." : closing ? "The recording is looked at again…" : "Add what is still to be noted, then close"),
    h("ul", { class: "checks", "aria-label": "closing" }, results(closing ?? {})),
    h("h3", {}, "Tasks"),
    h(
      "ul",
      { class: "checks", "aria-label": "tasks" },
      tasks.map((one) => row(one.result === "success" ? "green" : "todo", one.result === "success" ? "✓" : "–", one.id, [one.result ?? "not done", one.by && `by ${one.by}`, one.reason].filter(Boolean).join(", "))),
    ),
  );
}

function row(light, sign, name, words) {
  return h("li", { key: name, class: light }, h("i", { "aria-hidden": "true" }, sign), h("b", {}, name), h("span", {}, words));
}

function results({ verified, rules, deviate, folder, done }) {
  return [
    !done ? row("todo", "…", "recording", "will be replayed and verified: 9") : verified ? row("green", "✓", "recording", "verified: the same in every tick") : row("red", "✕", "recording", "does not verify"),
    done && (deviate ? row("red", "✕", "rules", `${deviate} of ${rules} differ from the recording`) : row("green", "✓", "rules", `${rules} looked at again, none differs`)),
    folder && row("green", "✓", "tables", `in ${folder}`),
  ];
}
