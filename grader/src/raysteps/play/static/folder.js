// A folder on this machine's disk, where the browser can write there: the native kit goes on where the page stopped. Of
// each step that is there the text is remembered that both had last, so that it is known who has changed it.

const MODE = { mode: "readwrite" };
const HANDLE = "folder"; // in the work
const common = (step) => `${step.id} on disk`;

/** The folder that somebody chose; it is remembered, and the browser may ask again before it gives it. */
export class DiskFolder {
  #work;
  #remembered = null;
  #handle = null; // where it may be read and written now

  static isThere() {
    return "showDirectoryPicker" in window;
  }

  constructor(work) {
    this.#work = work;
  }

  get name() {
    return this.#remembered?.name ?? "";
  }

  get isLinked() {
    return this.#handle !== null;
  }

  /** Asks for another one. Throws where nobody chooses. */
  async choose(steps) {
    const handle = await window.showDirectoryPicker({ id: "raysteps", ...MODE });
    await this.forget(steps);
    await this.#work.write(HANDLE, handle);
    this.#remembered = this.#handle = handle;
  }

  /** Goes on with the one of the last visit, if the browser allows it; `asks` the reader, too. */
  async reopen(asks = false) {
    this.#remembered = (await this.#work.read(HANDLE)) ?? null;
    const question = asks ? "requestPermission" : "queryPermission";
    if (this.#remembered && (await this.#remembered[question](MODE)) === "granted") {
      this.#handle = this.#remembered;
    }
  }

  /** Until it is opened again. */
  close() {
    this.#handle = null;
  }

  async forget(steps) {
    this.#remembered = this.#handle = null;
    for (const step of steps) {
      await this.#work.forget(common(step));
    }
    await this.#work.forget(HANDLE);
  }

  /** The file of a step; null where it is not there. */
  async #file(path, create) {
    const names = path.split("/");
    const last = names.pop();
    let folder = this.#handle;
    try {
      for (const name of names) {
        folder = await folder.getDirectoryHandle(name, { create });
      }
      return await folder.getFileHandle(last, { create });
    } catch (error) {
      if (error.name === "NotFoundError" && !create) {
        return null;
      }
      throw error;
    }
  }

  /** Who has changed a step since both had the same: `{by: "nobody" | "page" | "disk" | "both", text}` with what is on
   * disk. A file that is not there, and a stub, count as not changed. */
  async changes(step, mine) {
    const file = await this.#file(step.path, false);
    const text = file && (await (await file.getFile()).text()).replaceAll("\r\n", "\n");
    const before = (await this.#work.read(common(step))) ?? step.stub;
    if (text === mine) {
      await this.accept(step, text);
      return { by: "nobody", text };
    }
    if (text === null || text === before || text === step.stub) {
      return { by: "page", text };
    }
    return { by: mine === before ? "disk" : "both", text };
  }

  /** From now on both have this text. */
  accept(step, text) {
    return this.#work.write(common(step), text);
  }

  async write(step, text) {
    const file = await this.#file(step.path, true);
    const stream = await file.createWritable();
    await stream.write(text);
    await stream.close();
    await this.accept(step, text);
  }
}
