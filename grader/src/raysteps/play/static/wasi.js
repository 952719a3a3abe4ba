// A system for programs of WebAssembly: files in memory, a clock, and what is printed. What a program asks for
// beside that is refused, which is enough for a compiler, a linker and the kit's own programs.

const OK = 0;
const BAD_DESCRIPTOR = 8;
const EXISTS = 20;
const INVALID = 28;
const IS_FOLDER = 31;
const NOT_THERE = 44;
const NOT_SUPPORTED = 52;
const NOT_A_FOLDER = 54;

const DEVICE = 2;
const FOLDER = 3;
const FILE = 4;

const CREATE = 1;
const WANTS_FOLDER = 2;
const EXCLUSIVE = 4;
const TRUNCATE = 8;
const APPEND = 1;

const ROOT = 3; // the descriptor of the one folder that programs find open
const MAX_PRINTED = 1 << 20; // bytes

let lastInode = 0;

/** A file grows by doubling; `size` is how much of `bytes` counts. */
class FileNode {
  inode = ++lastInode;

  constructor(bytes = new Uint8Array()) {
    this.bytes = bytes;
    this.size = bytes.length;
  }

  resize(size) {
    if (size > this.bytes.length) {
      const larger = new Uint8Array(Math.max(size, 2 * this.bytes.length, 1024));
      larger.set(this.bytes.subarray(0, this.size));
      this.bytes = larger;
    }
    this.size = size;
  }

  content() {
    return this.bytes.subarray(0, this.size);
  }
}

class FolderNode {
  inode = ++lastInode;
  nodes = new Map();
}

/** All files of a system. Paths are absolute. */
export class Files {
  root = new FolderNode();

  /** The node, or an error's number. */
  find(path, from = this.root) {
    const parts = [];
    for (const part of path.split("/")) {
      if (part === "..") {
        parts.pop();
      } else if (part !== "" && part !== ".") {
        parts.push(part);
      }
    }
    let node = from;
    for (const part of parts) {
      if (!(node instanceof FolderNode)) {
        return NOT_A_FOLDER;
      }
      node = node.nodes.get(part);
      if (!node) {
        return NOT_THERE;
      }
    }
    return node;
  }

  /** The folder that holds a path, and the name in it. */
  place(path, from = this.root) {
    const at = path.replace(/\/+$/, "").lastIndexOf("/");
    const folder = at < 0 ? from : this.find(path.slice(0, at), from);
    return { folder, name: path.replace(/\/+$/, "").slice(at + 1) };
  }

  write(path, bytes) {
    let node = this.root;
    const parts = path.split("/").filter(Boolean);
    const name = parts.pop();
    for (const part of parts) {
      if (!node.nodes.has(part)) {
        node.nodes.set(part, new FolderNode());
      }
      node = node.nodes.get(part);
    }
    node.nodes.set(name, new FileNode(bytes));
  }

  /** The content of a file, or nothing. */
  read(path) {
    const node = this.find(path);
    return node instanceof FileNode ? node.content() : null;
  }

  remove(path) {
    const { folder, name } = this.place(path);
    if (folder instanceof FolderNode) {
      folder.nodes.delete(name);
    }
  }

  /** Puts the files of a tar where `prefix` says. */
  unpack(tar, prefix = "") {
    const text = new TextDecoder();
    const word = (from, length) => text.decode(tar.subarray(from, from + length)).replace(/\0.*$/s, "");
    let longName = "";
    for (let at = 0; at + 512 <= tar.length && tar[at] !== 0; ) {
      const size = Number.parseInt(word(at + 124, 12), 8);
      const kind = word(at + 156, 1);
      const content = tar.subarray(at + 512, at + 512 + size);
      const folder = word(at + 345, 155);
      const name = longName || (folder ? `${folder}/${word(at, 100)}` : word(at, 100));
      longName = kind === "L" ? text.decode(content).replace(/\0.*$/s, "") : "";
      if (kind === "0" || kind === "") {
        this.write(`${prefix}/${name}`, content);
      }
      at += 512 + 512 * Math.ceil(size / 512);
    }
  }
}

/** Thrown through a program to end it. */
class Exit extends Error {
  constructor(code) {
    super(`exit ${code}`);
    this.code = code;
  }
}

/** One run of a program. */
class Process {
  #files;
  #words;
  #print;
  #printed = 0;
  #memory = null;
  #open = new Map();

  constructor(files, words, print) {
    this.#files = files;
    this.#words = words.map((word) => new TextEncoder().encode(`${word}\0`));
    this.#print = print;
    this.#open.set(0, { kind: DEVICE });
    this.#open.set(1, { kind: DEVICE, name: "stdout" });
    this.#open.set(2, { kind: DEVICE, name: "stderr" });
    this.#open.set(ROOT, { kind: FOLDER, node: files.root });
  }

  /** Runs it and returns its exit code. */
  run(module, more) {
    const calls = this.#calls();
    const imports = { wasi_snapshot_preview1: calls, ...more(() => this.#memory) };
    for (const { module: room, name } of WebAssembly.Module.imports(module)) {
      imports[room] ??= {};
      imports[room][name] ??= () => NOT_SUPPORTED;
    }
    const instance = new WebAssembly.Instance(module, imports);
    this.#memory = instance.exports.memory;
    try {
      instance.exports._start();
    } catch (error) {
      if (error instanceof Exit) {
        return error.code;
      }
      throw error;
    }
    return 0;
  }

  get #view() {
    return new DataView(this.#memory.buffer);
  }

  #bytes(at, length) {
    return new Uint8Array(this.#memory.buffer, at, length);
  }

  #text(at, length) {
    return new TextDecoder().decode(this.#bytes(at, length));
  }

  #list(words, addresses, at) {
    const view = this.#view;
    let to = at;
    words.forEach((word, index) => {
      view.setUint32(addresses + 4 * index, to, true);
      this.#bytes(to, word.length).set(word);
      to += word.length;
    });
    return OK;
  }

  /** Calls `use` with each of the buffers of a list, until it returns less than there is room for. */
  #each(list, count, total, use) {
    let done = 0;
    for (let index = 0; index < count; index++) {
      const view = this.#view;
      const length = view.getUint32(list + 8 * index + 4, true);
      const moved = use(this.#bytes(view.getUint32(list + 8 * index, true), length));
      done += moved;
      if (moved < length) {
        break;
      }
    }
    this.#view.setUint32(total, done, true);
    return OK;
  }

  #stat(node, at) {
    const view = this.#view;
    this.#bytes(at, 64).fill(0);
    view.setBigUint64(at, 1n, true);
    view.setBigUint64(at + 8, BigInt(node?.inode ?? 0), true);
    view.setUint8(at + 16, node instanceof FolderNode ? FOLDER : node instanceof FileNode ? FILE : DEVICE);
    view.setBigUint64(at + 24, 1n, true);
    view.setBigUint64(at + 32, BigInt(node?.size ?? 0), true);
    return OK;
  }

  #relative(descriptor, at, length) {
    const open = this.#open.get(descriptor);
    return open?.kind === FOLDER ? { path: this.#text(at, length), from: open.node } : null;
  }

  #readFrom(open, list, count, total, position) {
    if (open?.kind === DEVICE) {
      return this.#each(list, count, total, () => 0);
    }
    if (open?.kind !== FILE) {
      return open ? IS_FOLDER : BAD_DESCRIPTOR;
    }
    let at = position ?? open.position;
    this.#each(list, count, total, (buffer) => {
      const piece = open.node.content().subarray(at, at + buffer.length);
      buffer.set(piece);
      at += piece.length;
      return piece.length;
    });
    if (position === undefined) {
      open.position = at;
    }
    return OK;
  }

  #writeTo(open, list, count, total) {
    if (open?.kind === DEVICE) {
      return this.#each(list, count, total, (buffer) => {
        if (this.#printed < MAX_PRINTED) {
          this.#printed += buffer.length;
          this.#print(open.name, buffer.slice());
        }
        return buffer.length;
      });
    }
    if (open?.kind !== FILE) {
      return BAD_DESCRIPTOR;
    }
    return this.#each(list, count, total, (buffer) => {
      const { node } = open;
      const at = open.append ? node.size : open.position;
      node.resize(Math.max(node.size, at + buffer.length));
      node.bytes.set(buffer, at);
      open.position = at + buffer.length;
      return buffer.length;
    });
  }

  #openPath({ path, from }, wanted, flags, result) {
    let node = this.#files.find(path, from);
    if (node === NOT_THERE && wanted & CREATE) {
      const { folder, name } = this.#files.place(path, from);
      if (!(folder instanceof FolderNode)) {
        return NOT_THERE;
      }
      node = new FileNode();
      folder.nodes.set(name, node);
    } else if (typeof node === "number") {
      return node;
    } else if (wanted & EXCLUSIVE) {
      return EXISTS;
    }
    if (wanted & WANTS_FOLDER && !(node instanceof FolderNode)) {
      return NOT_A_FOLDER;
    }
    if (wanted & TRUNCATE && node instanceof FileNode) {
      node.bytes = new Uint8Array();
      node.size = 0;
    }
    const kind = node instanceof FolderNode ? FOLDER : FILE;
    let descriptor = ROOT + 1;
    while (this.#open.has(descriptor)) {
      descriptor++;
    }
    this.#open.set(descriptor, { kind, node, position: 0, append: Boolean(flags & APPEND) });
    this.#view.setUint32(result, descriptor, true);
    return OK;
  }

  #listFolder(node, at, room, first, used) {
    const encoder = new TextEncoder();
    let to = 0;
    [...node.nodes].forEach(([name, one], index) => {
      if (index < first || to >= room) {
        return;
      }
      const bytes = encoder.encode(name);
      const entry = new Uint8Array(24 + bytes.length);
      const view = new DataView(entry.buffer);
      view.setBigUint64(0, BigInt(index + 1), true);
      view.setBigUint64(8, BigInt(one.inode), true);
      view.setUint32(16, bytes.length, true);
      view.setUint8(20, one instanceof FolderNode ? FOLDER : FILE);
      entry.set(bytes, 24);
      const piece = entry.subarray(0, room - to);
      this.#bytes(at + to, piece.length).set(piece);
      to += piece.length;
    });
    this.#view.setUint32(used, to, true);
    return OK;
  }

  #rename(from, to) {
    const old = this.#files.place(from.path, from.from);
    const fresh = this.#files.place(to.path, to.from);
    const node = old.folder instanceof FolderNode ? old.folder.nodes.get(old.name) : null;
    if (!node || !(fresh.folder instanceof FolderNode)) {
      return NOT_THERE;
    }
    old.folder.nodes.delete(old.name);
    fresh.folder.nodes.set(fresh.name, node);
    return OK;
  }

  #unlink({ path, from }) {
    const { folder, name } = this.#files.place(path, from);
    return folder instanceof FolderNode && folder.nodes.delete(name) ? OK : NOT_THERE;
  }

  #calls() {
    const inFolder =
      (call) =>
      (descriptor, at, length, ...rest) => {
        const place = this.#relative(descriptor, at, length);
        return place ? call(place, ...rest) : BAD_DESCRIPTOR;
      };
    return {
      args_sizes_get: (count, size) => {
        this.#view.setUint32(count, this.#words.length, true);
        this.#view.setUint32(
          size,
          this.#words.reduce((sum, word) => sum + word.length, 0),
          true,
        );
        return OK;
      },
      args_get: (addresses, at) => this.#list(this.#words, addresses, at),
      environ_sizes_get: (count, size) => {
        this.#view.setUint32(count, 0, true);
        this.#view.setUint32(size, 0, true);
        return OK;
      },
      environ_get: () => OK,
      clock_time_get: (clock, _precision, result) => {
        const milliseconds = clock === 0 ? Date.now() : performance.now();
        this.#view.setBigUint64(result, BigInt(Math.round(milliseconds * 1e6)), true);
        return OK;
      },
      random_get: (at, length) => {
        for (let done = 0; done < length; done += 65536) {
          crypto.getRandomValues(this.#bytes(at + done, Math.min(65536, length - done)));
        }
        return OK;
      },
      proc_exit: (code) => {
        throw new Exit(code);
      },
      fd_prestat_get: (descriptor, at) => {
        if (descriptor !== ROOT) {
          return BAD_DESCRIPTOR;
        }
        this.#view.setUint32(at, 0, true);
        this.#view.setUint32(at + 4, 1, true);
        return OK;
      },
      fd_prestat_dir_name: (_descriptor, at) => {
        this.#bytes(at, 1)[0] = "/".charCodeAt(0);
        return OK;
      },
      fd_fdstat_get: (descriptor, at) => {
        const open = this.#open.get(descriptor);
        if (!open) {
          return BAD_DESCRIPTOR;
        }
        this.#bytes(at, 24).fill(0);
        this.#view.setUint8(at, open.kind);
        this.#view.setBigUint64(at + 8, 0x1fffffffn, true);
        this.#view.setBigUint64(at + 16, 0x1fffffffn, true);
        return OK;
      },
      fd_fdstat_set_flags: () => OK,
      fd_filestat_get: (descriptor, at) => {
        const open = this.#open.get(descriptor);
        return open ? this.#stat(open.node, at) : BAD_DESCRIPTOR;
      },
      fd_filestat_set_size: (descriptor, size) => {
        const open = this.#open.get(descriptor);
        if (open?.kind !== FILE) {
          return BAD_DESCRIPTOR;
        }
        open.node.resize(Number(size));
        return OK;
      },
      fd_filestat_set_times: () => OK,
      fd_close: (descriptor) => (this.#open.delete(descriptor) ? OK : BAD_DESCRIPTOR),
      fd_read: (descriptor, list, count, total) => this.#readFrom(this.#open.get(descriptor), list, count, total),
      fd_pread: (descriptor, list, count, position, total) =>
        this.#readFrom(this.#open.get(descriptor), list, count, total, Number(position)),
      fd_write: (descriptor, list, count, total) => this.#writeTo(this.#open.get(descriptor), list, count, total),
      fd_seek: (descriptor, offset, from, result) => {
        const open = this.#open.get(descriptor);
        if (open?.kind !== FILE) {
          return open ? INVALID : BAD_DESCRIPTOR;
        }
        open.position = Number(offset) + [0, open.position, open.node.size][from];
        this.#view.setBigUint64(result, BigInt(open.position), true);
        return OK;
      },
      fd_readdir: (descriptor, at, room, cookie, used) => {
        const open = this.#open.get(descriptor);
        return open?.kind === FOLDER ? this.#listFolder(open.node, at, room, Number(cookie), used) : NOT_A_FOLDER;
      },
      path_open: (descriptor, _follow, at, length, wanted, _rights, _inherited, flags, result) => {
        const place = this.#relative(descriptor, at, length);
        return place ? this.#openPath(place, wanted, flags, result) : BAD_DESCRIPTOR;
      },
      path_filestat_get: (descriptor, _follow, at, length, result) => {
        const place = this.#relative(descriptor, at, length);
        const node = place ? this.#files.find(place.path, place.from) : BAD_DESCRIPTOR;
        return typeof node === "number" ? node : this.#stat(node, result);
      },
      path_create_directory: inFolder(({ path, from }) => {
        const { folder, name } = this.#files.place(path, from);
        if (!(folder instanceof FolderNode)) {
          return NOT_THERE;
        }
        if (folder.nodes.has(name)) {
          return EXISTS;
        }
        folder.nodes.set(name, new FolderNode());
        return OK;
      }),
      path_unlink_file: inFolder((place) => this.#unlink(place)),
      path_remove_directory: inFolder((place) => this.#unlink(place)),
      path_readlink: () => INVALID,
      path_rename: (oldFolder, oldAt, oldLength, newFolder, newAt, newLength) => {
        const from = this.#relative(oldFolder, oldAt, oldLength);
        const to = this.#relative(newFolder, newAt, newLength);
        return from && to ? this.#rename(from, to) : BAD_DESCRIPTOR;
      },
    };
  }
}

/**
 * Runs a program among files, and returns its exit code and what it printed.
 * @param {WebAssembly.Module} module
 * @param {string[]} words the first is the program's own name
 * @param {Files} files
 * @param {(memory: () => WebAssembly.Memory) => object} more functions of the page that it may call
 */
export function runProgram(module, words, files, more = () => ({})) {
  const said = { stdout: [], stderr: [] };
  const code = new Process(files, words, (name, bytes) => said[name].push(bytes)).run(module, more);
  const text = (pieces) => {
    const decoder = new TextDecoder();
    return pieces.map((piece) => decoder.decode(piece, { stream: true })).join("");
  };
  return { code, stdout: text(said.stdout), stderr: text(said.stderr) };
}
