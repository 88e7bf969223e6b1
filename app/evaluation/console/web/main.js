// The page: the newest state of the station, what is being typed, and the link, shown anew whenever one of them changes.
// The address says whose page it is: /participant is the participant's, all others the evaluator's.

import { StationClock, now_ms } from "./clock.js";
import { Course } from "./course.js";
import { Draft } from "./draft.js";
import { evaluatorPage } from "./evaluator.js";
import { listenAsEvaluator } from "./evaluator_keys.js";
import { show } from "./h.js";
import { following } from "./notes.js";
import { Outbox } from "./outbox.js";
import { listenAsParticipant, participantPage } from "./participant.js";
import { Picture } from "./picture.js";
import { Link } from "./socket.js";

const kState = "molar-state";
const kLook_ms = 250;

const role = location.pathname.startsWith("/participant") ? "participant" : "evaluator";

/** All that the page is made from; what is drawn by itself (picture, course) hangs on it too. */
const app = {
  role,
  state: JSON.parse(sessionStorage.getItem(kState) ?? "null"),
  line: null,
  marked: 0,
  sheet: false,
  asked: null,
  get session() {
    return this.state?.session ?? null;
  },
  clock: new StationClock(),
  course: new Course(),
  show: showSoon,
  say,
  at,
  setLine,
  send: (message) => app.link.send(message),
  steer: (what, value) => app.link.send({ kind: "steer", what, value }),
};
const draft = new Draft(role);
let stored_ms = 0;
let is_restored = false;
let is_due = false;

/** The time of a key or a click, on both clocks. */
function at(event) {
  const page_ms = event ? performance.timeOrigin + event.timeStamp : now_ms();
  return { page_ms, t_ns: app.clock.station_ns(page_ms), rtt_ms: app.clock.round_ms };
}

function say(type, data, when = at()) {
  app.outbox.add(type, data, when);
  showSoon();
}

function setLine(line) {
  app.line = line;
  if (app.state) draft.save(line, app.session);
  showNow();
}

function showSoon() {
  if (is_due) return;
  is_due = true;
  // Also where no frame is drawn, as in a hidden tab.
  setTimeout(showNow, 16);
}

function showNow() {
  is_due = false;
  const page = document.getElementById("page");
  following(() => show(page, role === "participant" ? participantPage(app) : evaluatorPage(app)));
  document.title = app.state ? `${app.state.participant} · ${app.state.phase} · Molar` : "Molar";
  tellRefusal();
}

// For who hears the page: what was refused, once.
function tellRefusal() {
  const told = document.getElementById("told");
  const words = app.outbox.refused.at(-1)?.why ?? "";
  if (told.textContent !== words) told.textContent = words;
}

function takeState(state) {
  if (app.session !== null && state.session !== app.session) app.clock.forget();
  app.state = state;
  app.course.take(state);
  app.outbox.setSession(app.session);
  // Said before the station knew that this page, come back by a new link, is the one that writes.
  if (state.writer) for (const event of app.outbox.refused) if (event.why.startsWith("another page writes")) app.outbox.again(event);
  if (!is_restored) {
    is_restored = true;
    restore();
  }
  const t_ms = now_ms();
  if (t_ms - stored_ms > 1000) {
    stored_ms = t_ms;
    sessionStorage.setItem(kState, JSON.stringify({ ...state, course: [] }));
  }
  showSoon();
}

async function restore() {
  const line = await draft.restored(app.session);
  if (line && !app.line) {
    app.line = line;
    showNow();
  }
}

app.outbox = new Outbox(
  role,
  (message) => app.link?.is_up && app.link.send(message),
  (page_ms) => app.clock.station_ns(page_ms),
);
app.picture = new Picture(app);
app.link = new Link(role, {
  opened() {
    app.outbox.resend();
  },
  text(message, arrived_ms) {
    if (message.kind === "pong") {
      app.clock.take(message, arrived_ms);
      app.outbox.flush();
    } else if (message.kind === "state") {
      takeState(message);
    } else if (message.kind === "ack" || message.kind === "refused") {
      app.outbox.answered(message);
      showSoon();
    }
  },
  picture: (buffer) => app.picture.take(buffer),
});

if (app.state) restore();
(role === "participant" ? listenAsParticipant : listenAsEvaluator)(app);
// Ages go on where nothing arrives.
setInterval(showSoon, kLook_ms);
showNow();
