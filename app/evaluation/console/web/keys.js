// The evaluator's keys, as at the terminal (app/evaluation/evaluator_keys): 1 behaviour, 2 comment, 3 prompt said,
// 4 bookmark, 5 task, 6 help, 7 problem, 8 withdraw; here also 9 go on, 0 the participant's page. Pure: what is open and
// a key give what is open then and what was said. Digits by their place on the keyboard, so they need no shift anywhere.

/** Lines that take text, and choices that take one digit. */
export const kTextLines = ["behaviour", "comment", "success", "partly", "failed", "help", "problem"];
const kLongest_bytes = 2000;

export const kFreeKeys = [
  ["1", "behaviour"],
  ["2", "comment"],
  ["3", "prompt"],
  ["4", "bookmark"],
  ["5", "task…"],
  ["6", "help"],
  ["7", "problem"],
  ["8", "withdraw…"],
];
export const kTaskKeys = [
  ["1", "success"],
  ["2", "partly"],
  ["3", "failed"],
  ["4", "pause"],
  ["5", "next"],
];

/** "3" of Digit3 and Numpad3, else the key's name. */
export function digitOf(event) {
  const digit = /^(?:Digit|Numpad)([0-9])$/.exec(event.code ?? "");
  return digit ? digit[1] : event.key;
}

export function isText(line) {
  return line !== null && kTextLines.includes(line.open);
}

function fresh(open) {
  return { open, text: "", severity: null, at: null, stream: null };
}

/** `line`: what is open, or null. `at`: { page_ms, t_ns, rtt_ms } of the key. `context`: { prompt, streams }. Returns
 *  { line, said: { type, data, at } | null, does: what the page itself is to do | null }. */
export function press(line, key, at, context) {
  const nothing = { line, said: null, does: null };
  if (line === null) return pressedFree(key, at, context, nothing);
  if (key === "Escape") return { ...nothing, line: null };
  if (line.open === "task") return pressedTask(key, at, nothing);
  if (line.open === "withdraw") return pressedWithdraw(line, key, at, context, nothing);
  if (key !== "Enter") return nothing;
  return { line: null, said: line.text.trim() === "" ? null : said(line), does: null };
}

function pressedFree(key, at, context, nothing) {
  const lines = { 1: "behaviour", 2: "comment", 5: "task", 6: "help", 7: "problem", 8: "withdraw" };
  if (key in lines) return { ...nothing, line: fresh(lines[key]) };
  if (key === "3" && context.prompt) return { ...nothing, said: { type: "prompt", data: { prompt: context.prompt }, at } };
  if (key === "4") return { ...nothing, said: { type: "bookmark", data: { label: "" }, at } };
  const does = { 9: "continue", 0: "participant", "?": "sheet" };
  does.ArrowUp = "mark-former";
  does.ArrowDown = "mark-next";
  return { ...nothing, does: does[key] ?? null };
}

function pressedTask(key, at, nothing) {
  const results = { 1: "success", 2: "partly", 3: "failed" };
  if (key in results) return { ...nothing, line: fresh(results[key]) };
  const now = { 4: "pause", 5: "next" };
  if (key in now) return { line: null, said: { type: "task", data: { result: now[key] }, at }, does: null };
  return nothing;
}

function pressedWithdraw(line, key, at, context, nothing) {
  const chosen = context.streams[Number(key) - 1];
  if (chosen) return { ...nothing, line: { ...line, stream: chosen } };
  if (key === "Enter" && line.stream)
    return { line: null, said: { type: "consent", data: { stream: line.stream, given: false }, at }, does: null };
  return nothing;
}

// As much of it as the station takes, whole letters.
function taken(text) {
  const letters = new TextEncoder().encodeInto(text, new Uint8Array(kLongest_bytes)).read;
  return text.slice(0, letters);
}

/** The line's text has become this; `at` is of the newest key. Its time is that of its first letter. */
export function typed(line, text, at) {
  const cut = taken(text);
  if (cut === "") return { ...line, text: "", at: null };
  return { ...line, text: cut, at: line.at ?? at };
}

/** Again the same severity: none. */
export function rated(line, severity) {
  return { ...line, severity: line.severity === severity ? null : severity };
}

function said(line) {
  const text = line.text.trim();
  const severity = line.severity === null ? {} : { severity: line.severity };
  switch (line.open) {
    case "behaviour":
    case "comment":
      return { type: "note", data: { kind: line.open, text, ...severity }, at: line.at };
    case "help":
      return { type: "help", data: { reason: text }, at: line.at };
    case "problem": {
      const colon = text.indexOf(": ");
      const problem = (colon < 0 ? text : text.slice(0, colon)).slice(0, 60);
      return { type: "problem", data: { problem, title: colon < 0 ? text : text.slice(colon + 2), ...severity }, at: line.at };
    }
    default:
      return { type: "task", data: { result: line.open, reason: text }, at: line.at };
  }
}
