// The keyboard of the evaluator's page: what a key does while no line is open, while one is, and in the debrief. A key
// that goes into a field for words is that field's.

import { digitOf, isText, press, rated, typed } from "./keys.js";

const kNotes = ["warm-up", "tasks", "debrief", "questionnaires", "close"];
const kSpeeds = [0.25, 0.5, 1, 2, 4];
const kOnItsWay_ms = 700;

/** Whether notes belong into this phase. */
export function takesNotes(state) {
  return kNotes.includes(state?.phase);
}

export function contextOf(app) {
  const prompts = app.state?.prompts ?? [];
  const streams = (app.state?.consent?.streams ?? []).filter((one) => one.given).map((one) => one.id);
  return { prompt: prompts[app.marked % Math.max(prompts.length, 1)]?.id ?? null, streams };
}

/** A key, or a button that stands for it. */
export function pressed(app, key, when) {
  const line_before = app.line;
  const { line, said, does } = press(app.line, key, when, contextOf(app));
  // Lines and events need their phase, and a page that may write.
  if ((said || line) && !line_before && !(app.state?.writer && takesNotes(app.state))) return;
  if (said) app.say(said.type, said.data, said.at ?? when);
  if (line !== line_before) app.setLine(line);
  if (line && line !== line_before && isText(line)) focusLine(app);
  if (does) act(app, does, when);
}

export function focusLine(app) {
  const field = document.getElementById("line");
  if (field) {
    field.focus();
    field.setSelectionRange(field.value.length, field.value.length);
  }
}

function act(app, does, when) {
  const { state } = app;
  const count = Math.max(state?.prompts?.length ?? 0, 1);
  if (does === "mark-next") app.marked = (app.marked + 1) % count;
  if (does === "mark-former") app.marked = (app.marked + count - 1) % count;
  if (does === "sheet") app.sheet = !app.sheet;
  if (does === "continue" && state?.may_continue && state.writer) app.say("continue", {}, when);
  if (does === "participant") location.assign("/participant");
  app.show();
}

/** Where the bar stands: where it was sent to just now, else where the station is. */
export function position(app) {
  const { debrief } = app.state;
  const wanted = app.wanted;
  return wanted && performance.now() - wanted.at_ms < kOnItsWay_ms ? wanted.t_s : debrief.t_s;
}

/** `what`: "scrub" while a hand moves, else the moment itself. */
export function goTo(app, t_s, what = "seek") {
  const { debrief } = app.state;
  if (!debrief || debrief.prepared < 1) return;
  const to_s = Math.min(debrief.duration_s, Math.max(0, t_s));
  app.wanted = { t_s: to_s, at_ms: performance.now() };
  app.steer(what, to_s);
  app.show();
}

/** The bar of the debrief; true: the key was one of its own. */
export function steered(app, key, is_held = false) {
  const debrief = app.state?.debrief;
  if (app.state?.phase !== "debrief" || !debrief || debrief.prepared < 1) return false;
  const marks = (debrief.marks ?? []).map((mark) => mark.t_s).sort((a, b) => a - b);
  const near = 0.05;
  const t_s = position(app);
  const how = is_held ? "scrub" : "seek";
  const plays = () => {
    app.wanted = null;
    app.steer(debrief.playing ? "pause" : "play", null);
  };
  const moves = {
    " ": plays,
    ArrowLeft: () => goTo(app, t_s - 1, how),
    ArrowRight: () => goTo(app, t_s + 1, how),
    ",": () => goTo(app, marks.filter((mark_s) => mark_s < t_s - near).at(-1) ?? 0),
    ".": () => goTo(app, marks.find((mark_s) => mark_s > t_s + near) ?? debrief.duration_s),
    "-": () => app.steer("speed", kSpeeds.filter((speed) => speed < debrief.speed).at(-1) ?? kSpeeds[0]),
    "+": () => app.steer("speed", kSpeeds.find((speed) => speed > debrief.speed) ?? kSpeeds.at(-1)),
  };
  moves["="] = moves["+"];
  if (!(key in moves)) return false;
  moves[key]();
  return true;
}

function isField(node) {
  return node instanceof HTMLTextAreaElement || (node instanceof HTMLInputElement && node.type === "text");
}

export function listenAsEvaluator(app) {
  let newest = null;
  let former = null;

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing) return noteTime(event);
    const key = digitOf(event);
    const { target } = event;
    const own_line = target.id === "line";
    if (app.sheet && (key === "Escape" || key === "?")) return take(event, () => ((app.sheet = false), app.show()));
    if (isText(app.line) && (own_line || !isField(target))) return inLine(event, key, own_line);
    if (isField(target)) {
      // Out of the field, to the keys again.
      if (key === "Escape") target.blur();
      return;
    }
    // Enter and space press the button that has the focus.
    if ((key === "Enter" || key === " ") && target.closest("button, a, summary")) return;
    if (event.shiftKey && /^[0-9]$/.test(key)) return;
    if (!app.line && steered(app, key, event.repeat)) return event.preventDefault();
    if (event.repeat && /^[0-9]$/.test(key)) return event.preventDefault();
    if (!app.line) former = document.activeElement;
    if (/^[0-9?]$/.test(key) || ["Escape", "Enter", "ArrowUp", "ArrowDown"].includes(key)) {
      if (["ArrowUp", "ArrowDown"].includes(key) && target.closest(".scrolls")) return;
      take(event, () => pressed(app, key, app.at(event)));
    }
  });

  function take(event, what) {
    event.preventDefault();
    what();
  }

  function noteTime(event) {
    newest = app.at(event);
  }

  function inLine(event, key, own_line) {
    if (event.shiftKey && /^(?:Digit|Numpad)[0-4]$/.test(event.code)) {
      return take(event, () => app.setLine(rated(app.line, Number(key))));
    }
    if (key === "Enter" || key === "Escape") {
      return take(event, () => {
        pressed(app, key, app.at(event));
        // Back to where the evaluator was.
        if (!app.line && former?.isConnected) former.focus();
        else if (!app.line) document.activeElement?.blur();
      });
    }
    noteTime(event);
    if (!own_line && event.key.length === 1) focusLine(app);
  }

  document.addEventListener("input", (event) => {
    if (event.target.id !== "line" || !isText(app.line)) return;
    app.setLine(typed(app.line, event.target.value, newest ?? app.at(event)));
    newest = null;
  });
}
