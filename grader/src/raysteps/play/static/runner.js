// The worker that runs what was linked: a picture, whose tiles it tells of, or tests. It ends with its page's patience.

import { Files, runProgram } from "./wasi.js";

function run({ module, words, files: given, wanted }) {
  const files = new Files();
  for (const [path, bytes] of Object.entries(given)) {
    files.write(path, bytes);
  }
  files.write("/out/.keep", new Uint8Array());
  const start = performance.now();
  const said = runProgram(module, words, files, (memory) => ({
    page: {
      show_tile: (x, y, width, height, at) => {
        const pixels = new Uint8Array(memory().buffer, at, 3 * width * height).slice();
        postMessage({ tile: { x, y, width, height, pixels } }, [pixels.buffer]);
      },
    },
  }));
  const made = Object.fromEntries(wanted.map((path) => [path, files.read(path)?.slice() ?? null]));
  return { ...said, made, seconds: (performance.now() - start) / 1000 };
}

addEventListener("message", ({ data }) => {
  try {
    postMessage({ ended: run(data) });
  } catch (error) {
    postMessage({ crashed: String(error?.message ?? error) });
  }
});
