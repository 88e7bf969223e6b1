// The one connection to the station. Comes back by itself; a station that says nothing for 1.5 s counts as lost, though
// the socket is open. Eight pings at once every 5 s for the clock, one every half second for the link.

import { now_ms } from "./clock.js";

const kSilent_ms = 1500;
const kBeat_ms = 500;
const kBurst = 8;
const kBurstEvery_ms = 5000;
const kBurstGap_ms = 20;
const kLongestWait_ms = 2000;

export class Link {
  #address;
  #take;
  #socket = null;
  #heard_ms = -Infinity;
  #began_ms = now_ms();
  #burst_ms = -Infinity;
  #wait_ms = 250;
  #beat_ms = now_ms();

  /** `take` = { text(message, arrived_ms), picture(buffer), opened() }. */
  constructor(role, take) {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.#address = `${scheme}://${location.host}/ws?role=${role}`;
    this.#take = take;
    this.#connect();
    setInterval(() => this.#beat(), kBeat_ms);
    // A page that comes back from sleep looks at once.
    document.addEventListener("visibilitychange", () => this.#beat());
    document.addEventListener("resume", () => this.#beat());
  }

  get is_up() {
    return this.#socket?.readyState === WebSocket.OPEN && now_ms() - this.#heard_ms < kSilent_ms;
  }

  /** How long nothing was heard, s. */
  get silent_s() {
    return (now_ms() - Math.max(this.#heard_ms, this.#began_ms)) / 1000;
  }

  /** False: not sent. */
  send(message) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  #connect() {
    const socket = new WebSocket(this.#address);
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    const opens_ms = now_ms();
    socket.onopen = () => {
      if (socket !== this.#socket) return socket.close();
      this.#heard_ms = now_ms();
      this.#wait_ms = 250;
      this.#burst_ms = -Infinity;
      this.#beat();
      this.#take.opened();
    };
    socket.onmessage = (event) => {
      if (socket !== this.#socket) return;
      const arrived_ms = now_ms();
      this.#heard_ms = arrived_ms;
      if (typeof event.data === "string") this.#take.text(JSON.parse(event.data), arrived_ms);
      else this.#take.picture(event.data);
    };
    socket.onclose = () => this.#again(socket);
    socket.began_ms = opens_ms;
  }

  #again(socket) {
    if (socket !== this.#socket) return;
    this.#socket = null;
    setTimeout(() => this.#connect(), this.#wait_ms);
    this.#wait_ms = Math.min(2 * this.#wait_ms, kLongestWait_ms);
  }

  #beat() {
    const socket = this.#socket;
    if (!socket) return;
    const t_ms = now_ms();
    const patience_ms = 2 * kSilent_ms;
    // A page that stood still itself hears what has come meanwhile before it judges.
    const stood = t_ms - this.#beat_ms > 3 * kBeat_ms;
    this.#beat_ms = t_ms;
    // A cut cable closes nothing: what is silent for long is given up and tried anew.
    if (!stood && t_ms - Math.max(this.#heard_ms, socket.began_ms) > patience_ms) {
      socket.close();
      return this.#again(socket);
    }
    if (socket.readyState !== WebSocket.OPEN) return;
    if (t_ms - this.#burst_ms > kBurstEvery_ms) {
      this.#burst_ms = t_ms;
      for (let n = 0; n < kBurst; ++n) setTimeout(() => this.#ping(), n * kBurstGap_ms);
    } else {
      this.#ping();
    }
  }

  #ping() {
    this.send({ kind: "ping", t0: now_ms() });
  }
}
