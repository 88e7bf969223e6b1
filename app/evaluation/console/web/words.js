// Questions that are answered in words, on either page. Each answer goes to the station when its field is left; what is
// being typed is kept letter by letter; submitting locks them.

import { words } from "./draft.js";
import { h } from "./h.js";

/** Also where the station has not told yet. */
export function isSubmitted(app, { id, locked }) {
  return locked || app.outbox.told.some(({ type, data }) => type === "submit" && data.questionnaire === id);
}

export function wordsQuestions(app, questionnaire) {
  if (questionnaire.locked) words.forget(questionnaire.id);
  const may = app.role === "participant" || app.state.writer;
  const submit = (event) => {
    if (may) app.say("submit", { questionnaire: questionnaire.id }, app.at(event));
  };
  return [
    questionnaire.items.map((item) => question(app, questionnaire, item, may)),
    !isSubmitted(app, questionnaire) && h("button", { key: "submit", class: "submit", onclick: submit, "aria-disabled": may ? null : "true" }, "Submit the answers"),
  ];
}

function question(app, questionnaire, item, may) {
  const id = `w-${questionnaire.id}-${item.id}`;
  const answer = questionnaire.answers?.[item.id];
  const kept = typeof answer === "string" ? answer : "";
  const say = (event) => {
    const text = event.target.value.trim();
    if (text !== kept) app.say("answer", { questionnaire: questionnaire.id, item: item.id, words: text }, app.at(event));
  };
  return h(
    "div",
    { key: item.id, class: "question" },
    h("label", { for: id }, item.say),
    h("input", {
      id,
      type: "text",
      autocomplete: "off",
      maxlength: "1000",
      readonly: isSubmitted(app, questionnaire) || !may,
      value: words.of(app.session, questionnaire.id, item.id) ?? kept,
      oninput: (event) => words.save(app.session, questionnaire.id, item.id, event.target.value),
      onchange: say,
    }),
  );
}
