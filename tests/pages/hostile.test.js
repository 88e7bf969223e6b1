// Whatever a person types or a template says is shown as text: 200 strings that a careless page would run as markup or
// script, as notes, prompt, task, title and consent. No script of theirs runs, no element of theirs comes to be.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { faultsOf, opened, pageAt, shows } from "./browser.js";
import { toFirstTask } from "./session.js";
import { Station, until } from "./station.js";

const kActs = ["window.ran=1", "alert(1)", "top.ran=1", "fetch('//evil.test')", "document.title='ran'"];
const kShapes = [
  (act) => `<script>${act}</script>`,
  (act) => `<img src=x onerror=${act}>`,
  (act) => `<svg onload=${act}>`,
  (act) => `<svg><script>${act}</script></svg>`,
  (act) => `<iframe srcdoc="<script>${act}</script>"></iframe>`,
  (act) => `<a href="javascript:${act}">x</a>`,
  (act) => `"><script>${act}</script>`,
  (act) => `'><img src=x onerror=${act}>`,
  (act) => `</style><script>${act}</script>`,
  (act) => `</textarea><script>${act}</script>`,
  (act) => `--><script>${act}</script><!--`,
  (act) => `]]><script>${act}</script>`,
  (act) => `<details open ontoggle=${act}>`,
  (act) => `<input autofocus onfocus=${act}>`,
  (act) => `<video><source onerror=${act}>`,
  (act) => `<body onload=${act}>`,
  (act) => `<math><mtext></form><form><mglyph><style></math><img src onerror=${act}>`,
  (act) => `<object data="javascript:${act}">`,
  (act) => `<meta http-equiv=refresh content="0;url=javascript:${act}">`,
  (act) => `<base href="//evil.test/">${act}`,
  (act) => `<style>*{background:url(//evil.test)}</style>${act}`,
  (act) => `<link rel=stylesheet href=//evil.test>${act}`,
  (act) => `{{constructor.constructor('${act}')()}}`,
  (act) => `\${${act}}`,
  (act) => `javascript:${act}`,
  (act) => `&lt;script&gt;${act}&lt;/script&gt;`,
  (act) => `&#60;script&#62;${act}&#60;/script&#62;`,
  (act) => `\\u003cscript\\u003e${act}\\u003c/script\\u003e`,
  (act) => `%3Cscript%3E${act}%3C/script%3E`,
  (act) => `<scr\u0000ipt>${act}</scr\u0000ipt>`.replaceAll("\u0000", "\ufffd"),
  (act) => `\u202e<script>${act}</script>\u202c`,
  (act) => `＜script＞${act}＜/script＞`,
  (act) => `<ScRiPt\t>${act}</sCrIpT >`.replaceAll("\t", " "),
  (act) => `"; ${act}; //`,
  (act) => `'); ${act}; ('`,
  (act) => `\`; ${act}; \``,
  (act) => `__proto__[onerror]=${act}`,
  (act) => `{"kind":"state","phase":"close","x":"${act}"}`,
  (act) => `=cmd|' /C calc'!A0 ${act}`,
  (act) => `<template shadowrootmode=open><script>${act}</script></template>`,
];
const kHostile = kShapes.flatMap((shape) => kActs.map(shape));
// What the page itself is made of.
const kOwn = ["a", "b", "button", "canvas", "dd", "div", "dl", "dt", "em", "fieldset", "figcaption", "figure", "footer", "h1", "h2", "h3", "header", "i", "input", "kbd", "label", "legend", "li", "main", "nav", "ol", "output", "p", "section", "span", "ul"];

const quoted = (text) => JSON.stringify(text);

let station, browser, evaluator, participant;
before(async () => {
  const change = (text) =>
    text
      .replace('"A session by keys"', quoted(kHostile[1]))
      .replace('"Open the plate, as you like"', quoted(kHostile[6]))
      .replace('"Why has it done that?"', quoted(kHostile[30]));
  [station, browser] = await Promise.all([Station.started({ change, consent: kHostile.slice(0, 40).join("\n\n") }), opened()]);
  evaluator = await pageAt(browser, station);
  participant = await pageAt(browser, station, "/participant");
});
after(async () => {
  await browser?.close();
  await station?.stop();
});

async function isText(page) {
  const made = await page.$$eval("#page *", (nodes) => [...new Set(nodes.filter((node) => !node.closest(".uplot") || node.matches("script, img")).map((node) => node.localName))]);
  assert.deepEqual(made.filter((name) => !kOwn.includes(name)), []);
  assert.equal(await page.evaluate(() => window.ran), undefined);
  assert.deepEqual(await faultsOf(page), []);
}

test("200 hostile strings are shown as text", { timeout: 300_000 }, async () => {
  assert.equal(kHostile.length, 200);
  const reading = toFirstTask({ evaluator, participant });
  await shows(participant, ".consent-text", kHostile[1]);
  await isText(participant);
  await reading;
  await shows(evaluator, ".say", kHostile[6]);
  await shows(evaluator, ".prompts", kHostile[30]);
  for (const [n, text] of kHostile.entries()) {
    await evaluator.keyboard.press(n % 2 ? "1" : "2");
    await evaluator.keyboard.sendCharacter(text);
    await evaluator.keyboard.press("Enter");
  }
  await until(() => station.events("note").length === kHostile.length, "all notes in the log");
  await evaluator.waitForFunction((count) => document.querySelectorAll(".note.kept .text").length >= count && !document.querySelector(".note.going"), { timeout: 20_000, polling: 50 }, kHostile.length);
  const shown = await evaluator.$$eval(".note.kept .text", (nodes) => nodes.map((node) => node.textContent));
  assert.deepEqual(kHostile.filter((text) => !shown.includes(text)), []);
  assert.deepEqual(station.events("note").map(({ data }) => data.text), kHostile);
  await isText(evaluator);
});
