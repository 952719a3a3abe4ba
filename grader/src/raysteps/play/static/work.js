// The student's work: kept in this browser, and as a zip that `./raysteps grade` takes.

const STORE = "sources";

function asked(request) {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** The sources by step, in IndexedDB. */
export class Work {
  #database;

  static async open(name) {
    const request = indexedDB.open(name, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    const work = new Work();
    work.#database = await asked(request);
    return work;
  }

  #store(mode) {
    return this.#database.transaction(STORE, mode).objectStore(STORE);
  }

  read(step) {
    return asked(this.#store("readonly").get(step));
  }

  write(step, source) {
    return asked(this.#store("readwrite").put(source, step));
  }

  forget(step) {
    return asked(this.#store("readwrite").delete(step));
  }
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
