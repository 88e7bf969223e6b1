// Rules of the page's sources: text is never read as markup, nothing is fetched from elsewhere, files stay short; what is
// vendored is what its licence names.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import fs from "node:fs";
import { test } from "node:test";

const kWeb = new URL("../../app/evaluation/console/web/", import.meta.url);
const kForbidden = [
  [/\b(inner|outer)HTML\b/, "markup from text"],
  [/\binsertAdjacentHTML\b|\bcreateContextualFragment\b|\bparseFromString\b|\bsetHTML/, "markup from text"],
  [/\bdocument\.write/, "markup from text"],
  [/\beval\s*\(|\bnew\s+Function\b|\bFunction\s*\(/, "a program from text"],
  [/\bset(Timeout|Interval)\s*\(\s*["'`]/, "a program from text"],
  [/\bimport\s*\(/, "a module whose name is made"],
  [/\bhttps?:\/\//, "another origin"],
  [/\bsetAttribute\(\s*["'](style|on)/, "what the policy forbids"],
  [/javascript:/, "a program in an address"],
];
const files = fs.readdirSync(kWeb);
const own = files.filter((name) => /\.(js|html|css)$/.test(name) && !name.startsWith("uPlot"));
const textOf = (name) => fs.readFileSync(new URL(name, kWeb), "utf8");

function trespasses(text) {
  return kForbidden.filter(([pattern]) => pattern.test(text)).map(([, why]) => why);
}

test("no text becomes markup or a program", () => {
  assert.ok(own.length > 20);
  for (const name of own) assert.deepEqual(trespasses(textOf(name)), [], name);
});

test("each forbidden thing is found where it is planted", () => {
  const planted = ["node.innerHTML = x", "n.insertAdjacentHTML('a', x)", "document.write(x)", "eval(x)", "new Function(x)", 'setTimeout("x", 1)', "import(x)", '"https://a.b"', 'n.setAttribute("onclick", x)', '"javascript:x"'];
  for (const text of planted) assert.equal(trespasses(text).length, 1, text);
});

test("files are short, say what they are, and every one is used", () => {
  const all = own.map(textOf).join("\n");
  for (const name of own) {
    const text = textOf(name);
    assert.ok(text.split("\n").length <= 200, `${name} is longer than 200 lines`);
    if (name.endsWith(".js")) assert.ok(text.startsWith("// "), `${name} does not say what it is`);
    if (name.endsWith(".js") || name.endsWith(".css")) assert.ok(all.includes(`/${name}"`), `nothing uses ${name}`);
    assert.ok(!/[ \t]$/m.test(text) && !text.includes("\t") && text.endsWith("\n") && !text.includes("\r"), `${name}: spaces at the end of a line, tabs, or no last line`);
  }
});

test("uPlot is 1.6.32, unchanged, with its licence", () => {
  const kSums = {
    "uPlot.iife.min.js": "19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f",
    "uPlot.min.css": "df630c6a8d6f8eeaff264b50f73ce5b114f646ffd9a0bb74f049b0a00135fa04",
  };
  for (const [name, sum] of Object.entries(kSums)) assert.equal(createHash("sha256").update(textOf(name)).digest("hex"), sum, name);
  assert.match(textOf("uPlot.txt"), /uPlot 1\.6\.32[^]*The MIT License/);
});
