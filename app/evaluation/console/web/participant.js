// The participant's page: consent, then questions, else a calm word on what comes next. It shows nothing that the
// participant is not asked for, and no figures.

import { consentForm } from "./participant_consent.js";
import { pressedInQuestions, questionForm } from "./participant_questions.js";
import { h } from "./h.js";
import { isSubmitted, wordsQuestions } from "./words.js";

const kWaits = {
  prepare: ["Welcome", "The session is being prepared. You will be asked here in a moment."],
  "warm-up": ["Get used to it", "Drill a little, as you like, and say aloud what you think. Nothing is asked here now."],
  tasks: ["The instrument is yours", "Do the task in your own way and say aloud what you think. You may ask at any time, and stop at any time."],
  questionnaires: ["That was all", "Thank you. The evaluator goes on."],
  debrief: ["Let us look back", "The evaluator shows you moments of the session."],
  close: ["Thank you", "You have helped. Nothing more is asked of you."],
};

export function participantPage(app) {
  const { state } = app;
  const body = state ? bodyOf(app) : quiet("Welcome", app.link.silent_s < 2 ? "One moment…" : "The station does not answer yet. The page goes on trying.");
  return h(
    "div",
    { class: "participant", key: "participant" },
    h("header", { class: "strip calm" }, h("span", { class: "who" }, state?.title ?? "Molar"), app.link.is_up || !state ? null : h("span", { class: "amber", role: "status" }, "No link: what you say is kept and follows.")),
    h("main", { class: "paper", lang: state?.language ?? "en" }, refused(app), body),
    h("footer", {}, state && mayWithdraw(app) && ownConsent(app), h("a", { href: "/" }, "Evaluator’s page")),
  );
}

function bodyOf(app) {
  const { state } = app;
  const asked = (state.questionnaires ?? []).filter((one) => !isSubmitted(app, one));
  if (state.phase === "consent" || app.asked?.consent) return consentForm(app);
  const words = asked.filter((one) => one.words);
  if (state.phase === "debrief" && words.length > 0)
    return words.map((one) => h("section", { key: one.id, class: "words large" }, h("h1", {}, one.title), wordsQuestions(app, one)));
  const scales = asked.filter((one) => !one.words);
  if (state.phase === "questionnaires" && scales.length > 0) return questionForm(app, scales[0]);
  return quiet(...(kWaits[state.phase] ?? kWaits.close));
}

function quiet(title, text) {
  return h("section", { key: title, class: "quiet-page" }, h("h1", {}, title), h("p", {}, text));
}

function refused(app) {
  const newest = app.outbox.refused.at(-1);
  if (!newest) return null;
  return h("p", { key: "refused", class: "banner amber", role: "alert" }, `That was not taken: ${newest.why}. `, h("button", { onclick: () => (app.outbox.drop(newest), app.show()) }, "Understood"));
}

function mayWithdraw({ state }) {
  return ["warm-up", "tasks", "debrief", "questionnaires"].includes(state.phase);
}

function ownConsent(app) {
  const is_open = app.asked?.consent === true;
  return h("button", { key: "consent", onclick: () => ((app.asked = is_open ? null : { consent: true }), app.show()) }, is_open ? "Back" : "See or change what I allow");
}

export function listenAsParticipant(app) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing) return;
    const { target } = event;
    if (target instanceof HTMLInputElement && target.type === "text") {
      // Enter goes on to the next field, as in a form of paper.
      if (event.key === "Enter") {
        event.preventDefault();
        nextField(target);
      }
      return;
    }
    if (app.state?.phase === "questionnaires" && !app.asked?.consent) pressedInQuestions(app, event);
    else if (/^[yn]$/i.test(event.key)) choose(target, event.key.toLowerCase() === "y" ? "yes" : "no");
  });
}

// The choice that is made has the focus, so that Tab goes on to the next stream.
function choose(target, value) {
  const input = target.closest("[data-stream]")?.querySelector(`input[value="${value}"]`);
  input?.focus();
  input?.click();
}

function nextField(field) {
  const all = [...document.querySelectorAll("main input[type=text], main button")];
  all[all.indexOf(field) + 1]?.focus();
}
