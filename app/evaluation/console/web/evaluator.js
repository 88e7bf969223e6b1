// The evaluator's page: the strip on top, the screen of the phase, the bar of keys below. Nothing scrolls but notes.

import { closeScreen } from "./close.js";
import { consentScreen } from "./consent.js";
import { debriefPanel, moments } from "./debrief.js";
import { h } from "./h.js";
import { keyBar, keySheet } from "./key_bar.js";
import { prepareScreen } from "./prepare.js";
import { questionnairesScreen } from "./questionnaires.js";
import { strip } from "./strip.js";
import { tasksPanel } from "./tasks.js";
import { warmUpPanel } from "./warm_up.js";
import { withNotes, withPicture } from "./work.js";

const kScreens = {
  prepare: (app) => prepareScreen(app),
  consent: (app) => consentScreen(app),
  "warm-up": (app) => withPicture(app, warmUpPanel(app)),
  tasks: (app) => withPicture(app, tasksPanel(app)),
  debrief: (app) => withPicture(app, debriefPanel(app), moments(app)),
  questionnaires: (app) => withNotes(app, questionnairesScreen(app)),
  close: (app) => withNotes(app, closeScreen(app)),
};

export function evaluatorPage(app) {
  const { state } = app;
  if (!state) return h("main", { class: "waiting", key: "waiting" }, h("h1", {}, "Molar"), h("p", {}, waits(app)));
  const screen = kScreens[state.phase] ?? kScreens.close;
  const is_live = app.link.is_up;
  return [
    h("div", { key: "page", class: `desk${is_live ? "" : " lost"}` }, strip(app), banner(app), h("main", { key: "main", class: "screen" }, screen(app)), keyBar(app)),
    app.sheet && keySheet(app),
  ];
}

function waits(app) {
  return app.link.silent_s < 2 ? "Looking for the station…" : "No answer from the station. The page goes on trying.";
}

function banner(app) {
  const { state, link, outbox } = app;
  if (!link.is_up)
    return h(
      "p",
      { key: "banner", class: "banner red", role: "alert" },
      `Link lost: what is shown is ${link.silent_s.toFixed(0)} s old. `,
      "Go on writing: notes are kept here with their times and follow later.",
      outbox.waiting.length > 0 && ` ${outbox.waiting.length} waiting.`,
    );
  if (state.not_kept) return h("p", { key: "banner", class: "banner red", role: "alert" }, `${state.not_kept}. The session goes on.`);
  if (!state.writer)
    return h(
      "p",
      { key: "banner", class: "banner amber" },
      "Another page writes; this one only sees. ",
      h("button", { onclick: () => app.send({ kind: "take-over" }) }, "Take over"),
    );
  const others = outbox.of_other_sessions;
  if (others.length > 0)
    return h(
      "p",
      { key: "banner", class: "banner amber" },
      `${others.length} ${others.length === 1 ? "event" : "events"} of an earlier session never reached the station. `,
      h("button", { onclick: () => others.forEach((event) => outbox.drop(event)) }, "Delete here"),
    );
  return null;
}
