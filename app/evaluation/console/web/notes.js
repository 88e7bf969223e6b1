// The notes, oldest first, with what is on its way or was refused, and below them the line that is being typed. The one
// thing on the page that scrolls: it follows the newest unless the evaluator has scrolled back.

import { goTo, position, takesNotes } from "./evaluator_keys.js";
import { minutes, minutesExactly, number, severityName } from "./format.js";
import { h } from "./h.js";
import { isText, rated } from "./keys.js";

const kNames = { note: "note", prompt: "prompt", bookmark: "bookmark", help: "help", problem: "problem", task: "task", consent: "consent" };
const kSigns = { error: "▲", bookmark: "⚑", prompt: "▸", help: "?", problem: "!", task: "■" };
const kTaskWords = { "task.start": "begins", "task.pause": "pauses", "task.resume": "goes on" };
const kOpen = {
  behaviour: "behaviour",
  comment: "comment",
  success: "success, because",
  partly: "partly, because",
  failed: "failed, because",
  help: "help given",
  problem: "problem (name: sentence)",
};

/** Shows the page; the list then stands at its newest line if it stood there before. */
export function following(showPage) {
  const near_px = 24;
  const before = document.getElementById("notes");
  const stood = !before || before.scrollTop + before.clientHeight >= before.scrollHeight - near_px;
  showPage();
  const list = document.getElementById("notes");
  if (list && stood && list.scrollTop + list.clientHeight < list.scrollHeight) list.scrollTop = list.scrollHeight;
}

export function notes(app) {
  const { state, outbox } = app;
  const shown = isReplayed(state) ? replayed(app) : (state.notes ?? []).map((note) => kept(app, note));
  const waiting = outbox.told.filter((event) => event.type in kNames).map((event) => going(app, event));
  const refused = outbox.refused.map((event) => going(app, event));
  return h(
    "section",
    { key: "notes", class: "notes", "aria-label": "notes" },
    h("ol", { key: "list", id: "notes", class: "scrolls", tabindex: "0", "aria-label": "notes so far" }, shown, waiting, refused, shown.length + waiting.length + refused.length === 0 && h("li", { key: "none", class: "none quiet" }, none(state))),
    openLine(app),
  );
}

function isReplayed({ phase, debrief }) {
  return phase === "debrief" && debrief !== null && debrief !== undefined && debrief.prepared >= 1;
}

// In the debrief by their place in the recording, with its incidents between them; what has none comes last.
function replayed(app) {
  const { notes: all = [], debrief } = app.state;
  const bySeq = new Map(all.map((note) => [note.seq, note]));
  const t_s = position(app);
  const near = debrief.marks.findLastIndex((mark) => mark.t_s <= t_s + 0.05);
  const placed = new Set();
  const rows = debrief.marks.map((mark, n) => {
    const jump = () => goTo(app, mark.t_s);
    const is_now = n === near;
    const note = bySeq.get(mark.seq);
    if (note) placed.add(mark.seq);
    return note ? kept(app, note, mark.t_s, jump, is_now) : row(`i${n}`, { time: minutes(mark.t_s), kind: "error", text: mark.text, severity: null, sort: "incident", jump, is_now });
  });
  return [...rows, ...all.filter((note) => !placed.has(note.seq)).map((note) => kept(app, note))];
}

function none(state) {
  return takesNotes(state) ? "No notes yet. 1 behaviour, 2 comment." : "Notes belong after the consent.";
}

function row(key, { time, kind, text, severity, sort, after = null, jump = null, is_now = false }) {
  return h(
    "li",
    { key, class: `note ${sort}${is_now ? " at" : ""}`, "aria-current": is_now ? "true" : null },
    jump ? h("button", { class: "time", onclick: jump, title: "show this moment" }, time) : h("span", { class: "time" }, time),
    h("span", { class: `kind ${kind}` }, kSigns[kind] && h("i", { "aria-hidden": "true" }, kSigns[kind]), kind),
    h("span", { class: "text" }, text),
    severity !== null && severity !== undefined && h("span", { class: `severity s${severity}`, title: severityName(severity) }, `s${severity}`),
    after,
  );
}

function textOf(note, state) {
  if (note.type === "prompt") return state.prompts?.find((one) => one.id === note.prompt)?.say ?? note.text ?? note.prompt ?? "";
  if (note.type.startsWith("task.")) return taskText(note);
  if (note.type === "problem" && note.problem) return `${note.problem}: ${note.text ?? ""}`;
  if (note.text) return note.text;
  return note.kind === "comment" ? "(words not kept)" : "";
}

function taskText({ type, task, result, by, text }) {
  if (type in kTaskWords) return `${task ?? ""} ${kTaskWords[type]}`;
  return `${task ?? ""}: ${result ?? ""}${by ? `, by ${by}` : ""}${text ? `, ${text}` : ""}`;
}

// `t_s`: its place in the recording.
function kept(app, note, t_s = note.at_s, jump = null, is_now = false) {
  const kind = note.type === "note" ? note.kind : note.type.split(".")[0];
  return row(`n${note.seq}`, { time: minutes(t_s), kind, text: textOf(note, app.state), severity: note.severity, sort: "kept", jump, is_now });
}

// Not yet on the station's disk, or refused by it: nothing typed goes without a word.
function going(app, event) {
  const { data, type } = event;
  const kind = type === "note" ? data.kind : (kNames[type] ?? type);
  const text = data.text ?? data.reason ?? data.title ?? data.prompt ?? data.stream ?? data.result ?? data.words ?? "";
  const at_s = event.t_ns === null ? NaN : (event.t_ns - app.state.began_ns) / 1e9;
  const is_refused = event.why !== undefined;
  const after = is_refused
    ? h(
        "span",
        { class: "why" },
        `not taken: ${event.why} `,
        h("button", { onclick: () => app.outbox.again(event) }, "again"),
        h("button", { onclick: () => (app.outbox.drop(event), app.show()) }, "drop"),
      )
    : !event.is_kept && h("span", { class: "tag quiet" }, "on its way");
  return row(`${event.page} ${event.seq}`, { time: minutes(at_s), kind, text, severity: data.severity, sort: is_refused ? "refused" : event.is_kept ? "kept" : "going", after });
}

// While no line is open: a reminder after silence, or how a line opens.
function foot({ voice, prompts, ...state }, marked) {
  const prompt = prompts?.[marked % Math.max(prompts.length, 1)]?.say ?? "What are you doing now?";
  if (voice?.reminder) return h("div", { key: "no line", class: "typing none reminder", role: "status" }, `${number(voice.quiet_s, 0)} s quiet: “${prompt}”`);
  return h("div", { key: "no line", class: "typing none quiet" }, takesNotes(state) ? "A line opens with 1, 2, 6 or 7." : "");
}

function openLine(app) {
  const { line, state } = app;
  if (!isText(line)) return foot(state, app.marked);
  const at_s = line.at?.t_ns ? (line.at.t_ns - state.began_ns) / 1e9 : NaN;
  const steps = [0, 1, 2, 3, 4].map((severity) =>
    h(
      "button",
      { key: severity, class: `severity s${severity}`, "aria-pressed": String(line.severity === severity), title: severityName(severity), onclick: () => app.setLine(rated(app.line, severity)) },
      `s${severity}`,
    ),
  );
  return h(
    "div",
    { key: "line", class: `typing ${line.open}` },
    h("label", { for: "line", class: `kind ${line.open}` }, kOpen[line.open]),
    h("span", { class: "time" }, line.at ? minutesExactly(at_s) : "time: first letter"),
    h("input", { key: "field", id: "line", type: "text", autocomplete: "off", spellcheck: "false", maxlength: "1000", value: line.text }),
    h("span", { class: "severities", role: "group", "aria-label": "severity" }, steps),
  );
}
