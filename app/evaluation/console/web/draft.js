// The line that is being typed, kept letter by letter: in the tab's storage for a reload, in the database for a browser
// that is killed. A line whose tab lives on elsewhere is left to that tab.

import { forget, keep, kept } from "./database.js";

const kKept = "molar-line";
const kWords = "molar-words";

export class Draft {
  #id = crypto.getRandomValues(new Uint32Array(2)).join("-");
  #role;

  constructor(role) {
    this.#role = role;
    // Held as long as this page lives.
    navigator.locks?.request(`molar-line ${this.#id}`, () => new Promise(() => {}));
  }

  /** `line`: what is open, or null. */
  save(line, session) {
    if (line === null) {
      sessionStorage.removeItem(kKept);
      forget("lines", this.#id);
    } else {
      const record = { id: this.#id, role: this.#role, session, line };
      sessionStorage.setItem(kKept, JSON.stringify(record));
      keep("lines", record);
    }
  }

  /** The line of the page that was here before; null: none. */
  async restored(session) {
    const here = JSON.parse(sessionStorage.getItem(kKept) ?? "null");
    const left = await this.#left();
    const found = here ?? left.find((one) => one.role === this.#role && one.session === session) ?? null;
    if (!found || found.session !== session) return null;
    if (found.id !== this.#id) forget("lines", found.id);
    this.save(found.line, session);
    return found.line;
  }

  async #left() {
    if (!navigator.locks) return [];
    const held = new Set((await navigator.locks.query()).held.map((lock) => lock.name));
    return (await kept("lines")).filter((one) => one.id !== this.#id && !held.has(`molar-line ${one.id}`));
  }
}

/** Answers in words that are being typed, of one session: by questionnaire and item, until they are submitted. */
export const words = {
  all: JSON.parse(sessionStorage.getItem(kWords) ?? "{}"),
  of(session, questionnaire, item) {
    return this.all.session === session ? (this.all[`${questionnaire} ${item}`] ?? null) : null;
  },
  save(session, questionnaire, item, text) {
    if (this.all.session !== session) this.all = { session };
    this.all[`${questionnaire} ${item}`] = text;
    this.store();
  },
  forget(questionnaire) {
    const ours = Object.keys(this.all).filter((key) => key.startsWith(`${questionnaire} `));
    for (const key of ours) delete this.all[key];
    if (ours.length > 0) this.store();
  },
  store() {
    sessionStorage.setItem(kWords, JSON.stringify(this.all));
  },
};
