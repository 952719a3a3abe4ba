// The student's work: kept in this browser, and as a zip that `./raysteps grade` takes.

const STORE = "sources";

function asked(request) {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** A change that is written, and not only taken: where there is no room for it, that is known at its end. */
function written({ transaction }) {
  return new Promise((resolve, reject) => {
    transaction.oncomplete = resolve;
    transaction.onabort = () => reject(transaction.error ?? new Error("given up"));
  });
}

/** The sources by step, in IndexedDB; what a page leaves when it goes, in local storage until it is asked for. */
export class Work {
  #name;
  #database;

  static async open(name) {
    const request = indexedDB.open(name, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    const work = new Work();
    work.#name = name;
    work.#database = await asked(request);
    return work;
  }

  /** Where a step is left: a database takes nothing more from a page that goes. */
  #place(step) {
    return `${this.#name} ${step}`;
  }

  /** Keeps at once. A browser that has no room for it says so, and then there is what was written before. */
  leave(step, source) {
    try {
      localStorage.setItem(this.#place(step), source);
    } catch {
      // no local storage
    }
  }

  #left(step) {
    try {
      return localStorage.getItem(this.#place(step));
    } catch {
      return null;
    }
  }

  #store(mode) {
    return this.#database.transaction(STORE, mode).objectStore(STORE);
  }

  async read(step) {
    const left = this.#left(step);
    if (left !== null) {
      try {
        await written(this.#store("readwrite").put(left, step));
      } catch {
        return left; // no room: it stays where it is
      }
      this.#dropLeft(step);
    }
    return asked(this.#store("readonly").get(step));
  }

  write(step, source) {
    this.#dropLeft(step);
    return written(this.#store("readwrite").put(source, step));
  }

  forget(step) {
    this.#dropLeft(step);
    return written(this.#store("readwrite").delete(step));
  }

  #dropLeft(step) {
    if (this.#left(step) !== null) {
      localStorage.removeItem(this.#place(step));
    }
  }
}

const PATIENCE = 500; // milliseconds until another tab is thought to have it: one that is closed gives it back at once

/** The right to write something, which one tab has at a time. Where a browser keeps none, as on addresses that are not
 * safe, every tab has it. */
export class Turn {
  #count = 0;
  #end = () => {};
  #ended = Promise.resolve();

  /** Gives back what this tab has, and asks for `name`: true as soon as it may write, false while another tab does.
   * `changed` hears of what becomes of it later. `steal` takes it from the other tab. */
  async take(name, changed, steal = false) {
    const turn = ++this.#count;
    this.#end();
    await this.#ended;
    if (turn !== this.#count || !navigator.locks) {
      return turn === this.#count;
    }
    const stop = new AbortController();
    const waits = { signal: stop.signal };
    return new Promise((resolve) => {
      let tell = (isMine) => {
        tell = (now) => turn === this.#count && changed(now);
        resolve(isMine);
      };
      const waiting = setTimeout(() => tell(false), PATIENCE);
      const hold = () => {
        clearTimeout(waiting);
        tell(true);
        return new Promise((end) => {
          this.#end = end;
        });
      };
      const ask = (options) => {
        this.#end = () => stop.abort();
        return navigator.locks.request(name, options, hold).catch(() => {
          clearTimeout(waiting);
          tell(false);
          return turn === this.#count ? ask(waits) : null; // another tab took it, and may give it back
        });
      };
      this.#ended = ask(steal ? { steal } : waits);
    });
  }

  /** Whether no tab has it, this one neither. */
  static async isFree(name) {
    return !navigator.locks || navigator.locks.request(name, { ifAvailable: true }, (lock) => lock !== null);
  }
}

const MAX_SOURCE_BYTES = 1 << 20; // bytes

/** The files of a zip, not packed or deflated, by their paths; large ones are left out. Throws where it is none. */
export async function textsIn(zip) {
  const bytes = await zip.arrayBuffer();
  const view = new DataView(bytes);
  const decoder = new TextDecoder();
  let end = bytes.byteLength - 22;
  while (view.getUint32(end, true) !== 0x06054b50) {
    end--;
  }
  const texts = {};
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; left--) {
    const [packing, packed, size] = [
      view.getUint16(at + 10, true),
      view.getUint32(at + 20, true),
      view.getUint32(at + 24, true),
    ];
    const lengths = [28, 30, 32].map((place) => view.getUint16(at + place, true));
    const name = decoder.decode(new Uint8Array(bytes, at + 46, lengths[0]));
    const local = view.getUint32(at + 42, true);
    const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    if (size <= MAX_SOURCE_BYTES && packed <= MAX_SOURCE_BYTES) {
      const data = new Blob([new Uint8Array(bytes, start, packed)]);
      const plain = packing ? data.stream().pipeThrough(new DecompressionStream("deflate-raw")) : data.stream();
      texts[name] = await new Response(plain).text();
    }
    at += 46 + lengths.reduce((sum, length) => sum + length, 0);
  }
  return texts;
}

const CRC = Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; bit++) {
    value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  }
  return value >>> 0;
});

function checksum(bytes) {
  let value = 0xffffffff;
  for (const byte of bytes) {
    value = CRC[(value ^ byte) & 255] ^ (value >>> 8);
  }
  return (value ^ 0xffffffff) >>> 0;
}

function record(length, fields) {
  const view = new DataView(new ArrayBuffer(length));
  let at = 0;
  for (const [size, value] of fields) {
    if (size === 4) {
      view.setUint32(at, value, true);
    } else {
      view.setUint16(at, value, true);
    }
    at += size;
  }
  return new Uint8Array(view.buffer);
}

/** A zip of text files that are not packed: `{path: text}`. */
export function zipOf(texts) {
  const encoder = new TextEncoder();
  const [parts, entries] = [[], []];
  const [utf8, date] = [1 << 11, (1 << 5) | 1];
  let offset = 0;
  for (const [path, text] of Object.entries(texts)) {
    const [name, data] = [encoder.encode(path), encoder.encode(text)];
    const shared = [
      [2, utf8],
      [2, 0],
      [2, 0],
      [2, date],
      [4, checksum(data)],
      [4, data.length],
      [4, data.length],
    ];
    const head = record(30, [[4, 0x04034b50], [2, 20], ...shared, [2, name.length], [2, 0]]);
    const rest = [
      [2, name.length],
      [2, 0],
      [2, 0],
      [2, 0],
      [2, 0],
      [4, 0],
      [4, offset],
    ];
    entries.push(record(46, [[4, 0x02014b50], [2, 20], [2, 20], ...shared, ...rest]), name);
    parts.push(head, name, data);
    offset += head.length + name.length + data.length;
  }
  const size = entries.reduce((sum, part) => sum + part.length, 0);
  const count = entries.length / 2;
  const end = record(22, [
    [4, 0x06054b50],
    [2, 0],
    [2, 0],
    [2, count],
    [2, count],
    [4, size],
    [4, offset],
    [2, 0],
  ]);
  return new Blob([...parts, ...entries, end], { type: "application/zip" });
}
