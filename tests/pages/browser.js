// Debian's Chromium, driven by puppeteer-core; a page that tells every request to another origin, every violation of the
// content security policy and every error; looks at layout and at what axe-core finds.

import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";
import fs from "node:fs";

const modules = createRequire(path.join(process.env.MOLAR_NODE_MODULES, "package.json"));
const { default: puppeteer } = await import(pathToFileURL(modules.resolve("puppeteer-core")).href);
const kAxe = fs.readFileSync(modules.resolve("axe-core/axe.min.js"), "utf8");

export const kSizes = [
  { width: 1280, height: 720 },
  { width: 1024, height: 768 },
];

export function opened() {
  const as_root = process.getuid() === 0 ? ["--no-sandbox"] : [];
  return puppeteer.launch({ executablePath: process.env.MOLAR_CHROMIUM ?? "/usr/bin/chromium", headless: true, args: as_root });
}

/** A page of the station's, with `page.faults`: what must not happen. */
export async function pageAt(browser, station, where = "/", size = kSizes[0]) {
  const page = await browser.newPage();
  page.faults = [];
  await page.setViewport(size);
  await page.evaluateOnNewDocument(() => {
    window.violations = [];
    // The newest socket, to say by it what no page says.
    const Real = window.WebSocket;
    window.WebSocket = class extends Real {
      constructor(...all) {
        super(...all);
        window.molarSocket = this;
      }
    };
    document.addEventListener("securitypolicyviolation", (event) => window.violations.push(`${event.violatedDirective} ${event.blockedURI} ${event.sourceFile}`));
  });
  page.on("pageerror", (error) => page.faults.push(`error: ${error.message}`));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(`${station.url}/`) && !url.startsWith("blob:")) page.faults.push(`request: ${url}`);
  });
  page.on("response", (response) => {
    if (response.status() >= 400) page.faults.push(`answer ${response.status()}: ${response.url()}`);
  });
  page.on("dialog", (dialog) => {
    page.faults.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.goto(station.url + where);
  await page.waitForSelector(".strip .who, .waiting h1");
  return page;
}

export async function faultsOf(page) {
  return [...page.faults, ...(await page.evaluate(() => window.violations))];
}

/** What is outside the window, cut off, or too small to be read. */
export function misfits(page) {
  return page.evaluate(() => {
    const found = [];
    const name = (node) => `${node.localName}.${node.className} “${node.textContent.slice(0, 30)}”`;
    if (document.documentElement.scrollHeight > innerHeight || document.documentElement.scrollWidth > innerWidth) found.push("the page scrolls");
    for (const node of document.querySelectorAll("#page *")) {
      if (node.closest(".uplot, .unseen")) continue;
      const style = getComputedStyle(node);
      const box = node.getBoundingClientRect();
      if (box.width === 0 || box.height === 0) continue;
      const has_text = [...node.childNodes].some((child) => child.nodeType === Node.TEXT_NODE && child.nodeValue.trim() !== "");
      if (has_text && parseFloat(style.fontSize) < 14) found.push(`${style.fontSize}: ${name(node)}`);
      if (!node.closest(".scrolls") && (box.right > innerWidth + 1 || box.bottom > innerHeight + 1 || box.left < -1 || box.top < -1)) found.push(`outside: ${name(node)}`);
      const cuts = style.overflow !== "visible" && !node.classList.contains("scrolls") && !["input", "canvas"].includes(node.localName);
      if (cuts && node.textContent.trim() !== "" && (node.scrollWidth > node.clientWidth + 2 || node.scrollHeight > node.clientHeight + 2)) found.push(`cut off: ${name(node)}`);
    }
    return found;
  });
}

/** What axe-core calls serious or critical. It is run by the browser's own tools, past the policy of the page. */
export async function findings(page) {
  const tools = await page.createCDPSession();
  const run = `${kAxe}; axe.run({ resultTypes: ["violations"] }).then((all) => JSON.stringify(all.violations))`;
  const { result } = await tools.send("Runtime.evaluate", { expression: run, awaitPromise: true });
  await tools.detach();
  return JSON.parse(result.value)
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`);
}

/** Waits until one of those nodes has these words; else says what the page shows. */
export async function shows(page, selector, words, limit_ms = 60_000) {
  const has = (where, what) => [...document.querySelectorAll(where)].some((node) => node.textContent.includes(what));
  try {
    await page.waitForFunction(has, { timeout: limit_ms, polling: 50 }, selector, words);
  } catch {
    throw new Error(`“${words}” is not in ${selector}; the page says:\n${await page.evaluate(() => document.body.innerText)}`);
  }
}

/** Many seconds are left to whatever the station needs; the phase is what its page says. */
export function inPhase(page, phase) {
  return page.waitForFunction((name) => document.title.includes(` · ${name} · `), { timeout: 90_000, polling: 50 }, phase);
}
