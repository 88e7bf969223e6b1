// A task: what is asked, its rules with the newest values, the prompts, and how the other tasks went.

import { minutes, number, withUnit } from "./format.js";
import { h } from "./h.js";

const kOperators = { ">=": "≥", "<=": "≤", "==": "=" };
const kResults = { success: "✓", partly: "◐", failed: "✕" };

export function tasksPanel(app) {
  const { state } = app;
  return h("section", { class: "panel", key: "tasks", "aria-label": "task" }, state.task ? task(state.task) : between(state), done(state), prompts(app));
}

function task(one) {
  const part = one.time_box_s > 0 ? Math.min(1, one.elapsed_s / one.time_box_s) : 0;
  return h(
    "div",
    { key: one.id, class: "task" },
    h("h2", {}, `Task ${one.place} of ${one.of}`, one.helps > 0 && h("span", { class: "tag" }, `${one.helps} ${one.helps === 1 ? "help" : "helps"}`), one.paused && h("span", { class: "tag amber" }, "paused")),
    h("p", { class: "say" }, one.say),
    h("span", { class: "bar thin", "aria-hidden": "true" }, h("span", { class: `part ${one.box_over ? "amber" : "calm"}`, style: { width: `${(100 * part).toFixed(1)}%` } })),
    one.box_over && h("p", { class: "amber ask" }, "The time is over. Decide: 5, then 1, 2 or 3 with a reason."),
    h("ul", { class: "rules", "aria-label": "rules" }, (one.success ?? []).map((rule) => ruleRow(rule, "success")), (one.fail ?? []).map((rule) => ruleRow(rule, "fail"))),
  );
}

function ruleRow(rule, kind) {
  const [sign, light, words] = holds(rule.holds, kind);
  const measured = rule.value !== null && rule.value !== undefined;
  const grows = kind === "success" && (rule.op === ">=" || rule.op === ">") && rule.limit > 0 && measured;
  const part = grows ? Math.min(1, Math.max(0, rule.value / rule.limit)) : null;
  return h(
    "li",
    { key: `${kind} ${rule.text}`, class: kind },
    h("i", { class: light, role: "img", "aria-label": words }, sign),
    h("span", { class: "measure" }, rule.measure ?? rule.text),
    h("b", {}, withUnit(rule.value, rule.unit)),
    part === null ? h("span", { key: "no bar" }) : h("span", { key: "bar", class: "bar", "aria-hidden": "true" }, h("span", { class: "part calm", style: { width: `${(100 * part).toFixed(0)}%` } })),
    h("span", { class: "quiet limit" }, rule.op ? `${kind === "fail" ? "fails " : ""}${kOperators[rule.op] ?? rule.op} ${withUnit(rule.limit, rule.unit)}` : rule.text),
  );
}

function holds(is_so, kind) {
  if (is_so === null || is_so === undefined) return ["○", "quiet", "no value yet"];
  if (kind === "success") return is_so ? ["✓", "green", "holds"] : ["…", "quiet", "not yet"];
  return is_so ? ["✕", "red", "failed"] : ["✓", "green", "kept"];
}

function between({ tasks = [] }) {
  const left = tasks.filter((one) => !one.result).length;
  return h("div", { key: "between", class: "task" }, h("h2", {}, "Between tasks"), h("p", { class: "say" }, left > 0 ? `${left} to go: 5, then 5 begins the next.` : "All tasks are done: 9 goes on."));
}

function done({ tasks = [], task: running }) {
  return h(
    "ol",
    { key: "done", class: "results", "aria-label": "tasks" },
    tasks.map((one) =>
      h(
        "li",
        { key: one.id, class: one.result ?? (running?.id === one.id ? "now" : ""), title: [one.reason, one.by && `by ${one.by}`].filter(Boolean).join(", ") },
        h("i", { "aria-hidden": "true" }, kResults[one.result] ?? (running?.id === one.id ? "▶" : "○")),
        one.id,
        one.result && h("span", { class: "quiet" }, ` ${one.result}${Number.isFinite(one.time_s) ? `, ${minutes(one.time_s)} min` : ""}`),
      ),
    ),
  );
}

function prompts(app) {
  const list = app.state.prompts ?? [];
  if (list.length === 0) return null;
  const marked = app.marked % list.length;
  return h(
    "ul",
    { key: "prompts", class: "prompts", "aria-label": "prompts" },
    list.map((one, n) =>
      h(
        "li",
        { key: one.id, class: n === marked ? "marked" : "", "aria-current": n === marked ? "true" : null },
        h("button", { onclick: () => ((app.marked = n), app.show()) }, h("i", { "aria-hidden": "true" }, n === marked ? "▸" : ""), one.say),
        one.said > 0 && h("span", { class: "quiet" }, `${number(one.said, 0)}×`),
      ),
    ),
  );
}
