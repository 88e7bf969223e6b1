// The real program, `molar evaluate --page`, with a scripted hand and pictures made on the CPU; and what it has written.
// MOLAR_PROGRAM, MOLAR_PAGES_SCRATCH and XDG_CACHE_HOME come from run.sh.

import { spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

export const kConsent = ["log", "audio", "picture", "quotes", "reuse"];

const kTemplate = `title = "A session by keys"
language = "en"
case = "block-plate"
consent = "consent.md"
order = "as-written"
seed = 1
retention_days = 1

[warm_up]
block = "block-plate"
seconds = 1

[may_change]
law = false
layers = false

[[prompt]]
id = "expect"
say = "What do you expect to happen?"
[[prompt]]
id = "why"
say = "Why has it done that?"

[[task]]
id = "open"
say = "Open the plate, as you like"
tool = "round:3.0"
time_box_s = 600
success = "M1.drilling >= 500 s"

[[task]]
id = "again"
say = "Once more, with less force"
time_box_s = 600
success = "M1.drilling >= 500 s"

[[questionnaire]]
use = "debrief-5"
[[questionnaire]]
use = "sus"
[[questionnaire]]
use = "tlx-raw"
`;

const kConsentText = "The system is evaluated, not you.\n\n- log: what you did\n- audio: your voice\n\nEach is allowed or refused by itself.\n";

/** The station's clock, ns: the same kernel clock as the program's, on the same machine. */
export function stationNow() {
  return Number(process.hrtime.bigint());
}

export async function until(what, words, limit_ms = 60_000) {
  const ends = Date.now() + limit_ms;
  for (;;) {
    const found = await what();
    if (found) return found;
    if (Date.now() > ends) throw new Error(`waited ${limit_ms / 1000} s for: ${words}`);
    await new Promise((resolve) => setTimeout(resolve, 25));
  }
}

for (const signal of ["SIGTERM", "SIGINT"]) process.on(signal, () => process.exit(1));

export class Station {
  #process;
  #folder;
  words = "";
  ended = null;

  /** `change(template)`: the template's text as it shall be. */
  static async started({ participant = "P07", change = (text) => text, consent = kConsentText } = {}) {
    const station = new Station();
    const folder = fs.mkdtempSync(path.join(process.env.MOLAR_PAGES_SCRATCH, "station-"));
    station.#folder = folder;
    fs.writeFileSync(path.join(folder, "template.toml"), change(kTemplate));
    fs.writeFileSync(path.join(folder, "consent.md"), consent);
    const options = ["evaluate", path.join(folder, "template.toml"), "--participant", participant, "--out", path.join(folder, "study")];
    options.push("--page", "127.0.0.1:0", "--device", "scripted", "--headless", "--seconds", "900");
    station.#process = spawn(process.env.MOLAR_PROGRAM, options, { stdio: ["ignore", "ignore", "pipe"] });
    // Also where the tests are ended from outside.
    process.on("exit", () => station.#process.kill("SIGKILL"));
    station.#process.stderr.on("data", (bytes) => (station.words += bytes));
    station.ended = new Promise((resolve) => station.#process.on("exit", (code) => resolve(code)));
    let is_over = false;
    station.ended.then(() => (is_over = true));
    await until(() => station.url || is_over, "the page's address");
    if (!station.url) throw new Error(`the program ended: ${station.words}`);
    return station;
  }

  get url() {
    return /http:\/\/127\.0\.0\.1:[0-9]+/.exec(this.words)?.[0] ?? null;
  }
  get port() {
    return Number(this.url.split(":").at(-1));
  }

  recording() {
    const study = path.join(this.#folder, "study");
    const session = fs.readdirSync(study).find((name) => fs.existsSync(path.join(study, name, "session.molar")));
    return path.join(study, session, "session.molar");
  }

  /** The log so far, or [] while the participant has not allowed it. */
  events(type = null) {
    const study = path.join(this.#folder, "study");
    const session = fs.existsSync(study) && fs.readdirSync(study).find((name) => fs.existsSync(path.join(study, name, "events.jsonl")));
    if (!session) return [];
    const lines = fs.readFileSync(path.join(study, session, "events.jsonl"), "utf8").split("\n").slice(0, -1);
    return lines.map((line) => JSON.parse(line)).filter((event) => type === null || event.type === type);
  }

  /** All processes that it has started, and theirs. */
  besides() {
    const all = [];
    const add = (pid) => {
      for (const child of fs.readFileSync(`/proc/${pid}/task/${pid}/children`, "utf8").trim().split(" ").filter(Boolean)) {
        all.push(Number(child));
        add(child);
      }
    };
    add(this.#process.pid);
    return all;
  }

  /** The process that serves the page: by its command line. */
  pageProcess() {
    const children = fs.readFileSync(`/proc/${this.#process.pid}/task/${this.#process.pid}/children`, "utf8").trim().split(" ").filter(Boolean);
    return children.map(Number).filter((pid) => fs.readFileSync(`/proc/${pid}/cmdline`, "utf8").split("\0")[1] === "page");
  }

  /** Its exit status, once it has ended by itself; null: it goes on. */
  async end() {
    await until(() => this.#process.exitCode !== null, "the program's end").catch(() => {});
    return this.#process.exitCode;
  }

  /** Ends it and forgets what it wrote. */
  async stop() {
    if (this.#process.exitCode === null) this.#process.kill("SIGINT");
    const late = setTimeout(() => this.#process.kill("SIGKILL"), 20_000);
    await this.ended;
    clearTimeout(late);
    fs.rmSync(this.#folder, { recursive: true, force: true });
  }
}
