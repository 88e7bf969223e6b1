// A wire to the station that can be slow, cut, or silent: what passes it is not looked into.

import net from "node:net";

export class Delay {
  #server;
  #wires = new Set();
  /** Added to each round trip, half each way. */
  round_trip_ms = () => 0;
  is_silent = false;

  static async before(station) {
    const delay = new Delay();
    delay.#server = net.createServer((near) => delay.#join(near, station.port));
    await new Promise((resolve) => delay.#server.listen(0, "127.0.0.1", resolve));
    delay.url = `http://127.0.0.1:${delay.#server.address().port}`;
    return delay;
  }

  get port() {
    return this.#server.address().port;
  }

  #join(near, port) {
    const far = net.connect(port, "127.0.0.1");
    const wire = [near, far];
    this.#wires.add(wire);
    const end = () => {
      near.destroy();
      far.destroy();
      this.#wires.delete(wire);
    };
    for (const side of wire) {
      side.setNoDelay(true);
      side.on("error", end);
      side.on("close", end);
    }
    this.#carry(near, far, (bytes) => this.#named(bytes, this.port, port));
    this.#carry(far, near, (bytes) => bytes);
  }

  // In order, each piece later by its own delay.
  #carry(from, to, through) {
    let free_ms = 0;
    from.on("data", (bytes) => {
      if (this.is_silent) return;
      const arrives_ms = Math.max(free_ms, performance.now() + this.round_trip_ms() / 2);
      free_ms = arrives_ms;
      const put = () => to.writable && to.write(through(bytes));
      const wait_ms = arrives_ms - performance.now();
      if (wait_ms > 0.5) setTimeout(put, wait_ms);
      else put();
    });
  }

  // Host and Origin name this port; the station knows its own.
  #named(bytes, here, there) {
    if (!/^(GET|HEAD|POST) /.test(bytes.subarray(0, 5).toString("latin1"))) return bytes;
    return Buffer.from(bytes.toString("latin1").replaceAll(`127.0.0.1:${here}`, `127.0.0.1:${there}`), "latin1");
  }

  cut() {
    for (const wire of this.#wires) for (const side of wire) side.destroy();
    this.#wires.clear();
  }

  /** Nobody answers there any more, until it is mended. */
  close() {
    const { port } = this;
    this.cut();
    return new Promise((resolve) => this.#server.close(() => resolve(port)));
  }

  mend(port) {
    return new Promise((resolve) => this.#server.listen(port, "127.0.0.1", resolve));
  }

  stop() {
    this.cut();
    this.#server.close();
  }
}
