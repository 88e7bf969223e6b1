// What was said on this page and is not yet on the station's disk. Each event is kept in IndexedDB, and at once in the
// tab's own storage, until the station has it; (page, seq) makes an event that is sent twice one event. `page` is new
// with each load, so two tabs never count on the same seq. Events of another session are kept and not sent.

import { forget, keep, kept } from "./database.js";

const kMirror = "molar-events";

export class Outbox {
  #page = Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => byte.toString(16).padStart(2, "0")).join("");
  #seq = 0;
  #role;
  #session = null;
  #kept = new Map();
  #send;
  #stationNs;
  /** Resolves once what an earlier page left is read. */
  ready;

  /** `send(message)`: false where there is no link; `stationNs(page_ms)`: null where the clock is not known yet. */
  constructor(role, send, stationNs) {
    this.#role = role;
    this.#send = send;
    this.#stationNs = stationNs;
    for (const event of JSON.parse(sessionStorage.getItem(kMirror) ?? "[]")) this.#remember({ ...event, is_sent: false });
    this.ready = this.#readDatabase();
  }

  /** `at` = { t_ns, page_ms, rtt_ms }, of the key. */
  add(type, data, at) {
    const event = { page: this.#page, seq: ++this.#seq, role: this.#role, session: this.#session, type, data, ...at };
    event.made_ms = Date.now();
    this.#remember(event);
    this.#keep(event);
    this.#flush();
    return event;
  }

  /** Of the newest state; sends what is of this session. */
  setSession(session) {
    const is_new = session !== this.#session;
    this.#session = session;
    for (const [key, event] of this.#kept) {
      event.session ??= session;
      if (event.is_kept) this.#kept.delete(key);
    }
    if (is_new) this.resend();
  }

  /** After a new connection: everything again. */
  resend() {
    for (const event of this.#kept.values()) event.is_sent = false;
    this.#flush();
  }

  /** An answer of the station. */
  answered(message) {
    const event = this.#kept.get(`${message.page} ${message.seq}`);
    if (!event) return null;
    if (message.kind === "refused") {
      event.why = String(message.why ?? "");
      this.#keep(event);
    } else {
      // Shown as said until the next state tells it.
      event.is_kept = true;
      this.#mirror();
      forget("events", [event.page, event.seq]);
    }
    return event;
  }

  drop(event) {
    this.#kept.delete(`${event.page} ${event.seq}`);
    this.#mirror();
    return forget("events", [event.page, event.seq]);
  }

  /** A refused one once more, as it was. */
  again(event) {
    delete event.why;
    event.is_sent = false;
    this.#keep(event);
    this.#flush();
  }

  get waiting() {
    return this.told.filter((event) => !event.is_kept);
  }
  /** Said here, and not yet in the state: waiting, or kept since. */
  get told() {
    return this.#here().filter((event) => event.why === undefined);
  }
  get refused() {
    return this.#here().filter((event) => event.why !== undefined);
  }
  get of_other_sessions() {
    return [...this.#kept.values()].filter((event) => this.#session && event.session !== this.#session);
  }

  /** Sends what was not sent on this connection. */
  flush() {
    this.#flush();
  }

  #here() {
    return [...this.#kept.values()].filter((event) => event.role === this.#role && event.session === this.#session);
  }

  #flush() {
    if (!this.#session) return;
    for (const event of this.waiting) {
      if (event.is_sent) continue;
      if (event.t_ns === null) {
        event.t_ns = this.#stationNs(event.page_ms);
        if (event.t_ns === null) return;
        this.#keep(event);
      }
      const { page, session, seq, type, t_ns, rtt_ms, data } = event;
      if (!this.#send({ kind: "event", page, session, seq, type, t_ns, rtt_ms, data })) return;
      event.is_sent = true;
    }
  }

  #remember(event) {
    this.#kept.set(`${event.page} ${event.seq}`, event);
  }

  #mirror() {
    sessionStorage.setItem(kMirror, JSON.stringify([...this.#kept.values()].filter((event) => !event.is_kept)));
  }

  // Puts and deletes reach the database in the order of these calls.
  #keep(event) {
    this.#mirror();
    const { is_sent, is_kept, ...stored } = event;
    return keep("events", stored);
  }

  async #readDatabase() {
    for (const event of await kept("events"))
      if (!this.#kept.has(`${event.page} ${event.seq}`)) this.#remember({ ...event, is_sent: false });
    this.#flush();
  }
}
