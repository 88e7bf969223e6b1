// Questionnaires as the evaluator sees them: how far the participant is, never what they answer.

import { h } from "./h.js";
import { hold, phases } from "./phases.js";

export function questionnairesScreen({ state }) {
  const asked = (state.questionnaires ?? []).filter((one) => !one.words);
  return h(
    "div",
    { class: "plain", key: "questionnaires" },
    phases(state),
    h("h2", { class: "title" }, "Questionnaires"),
    h("p", { class: "quiet" }, "The participant answers alone: look away. ", h("a", { href: "/participant" }, h("kbd", {}, "0"), ` ${location.host}/participant`)),
    h("ul", { class: "checks", "aria-label": "questionnaires" }, asked.map(progress)),
    hold(state),
  );
}

function progress({ id, title, items, answers, locked }) {
  const answered = Object.keys(answers ?? {}).length;
  return h(
    "li",
    { key: id, class: locked ? "green" : "todo" },
    h("i", { "aria-hidden": "true" }, locked ? "✓" : "…"),
    h("b", {}, title),
    h("span", {}, locked ? `submitted, ${answered} of ${items.length} answered` : `${answered} of ${items.length} answered`),
  );
}
