// The live figures of a handout on the site: the drawings of the page to work in, moved by the kit's own functions. The
// site is opened as files, too, so that nothing is asked for but scripts; this one is loaded by each handout.

import { Figures } from "./figures.js";
import { Runner } from "./programs.js";

const { script, worker } = globalThis.raystepsLive; // what the site's maker fills in
const NEAR = "600px"; // from what is seen: then the program is loaded

/** The program, packed, in the letters of a script. */
async function program(address) {
  await new Promise((resolve, reject) => {
    const node = make("script", { src: address });
    node.addEventListener("load", resolve);
    node.addEventListener("error", () => reject(new Error("the program of the figures cannot be loaded")));
    document.head.append(node);
  });
  const packed = Uint8Array.from(atob(globalThis.raystepsProgram), (letter) => letter.charCodeAt(0));
  const bytes = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(bytes).arrayBuffer());
}

const source = URL.createObjectURL(new Blob([worker], { type: "text/javascript" }));
const figures = new Figures("It is being made ready.", { ofKit: true, runner: new Runner(() => new Worker(source)) });
const nodes = figures.open(script.dataset.step, document.querySelector("article"));
const watching = new IntersectionObserver(
  (seen) => {
    if (seen.some((one) => one.isIntersecting)) {
      watching.disconnect();
      program(script.dataset.program).then(
        (module) => figures.built(module),
        (error) => figures.tell(`It cannot be shown: ${error.message}.`),
      );
    }
  },
  { rootMargin: NEAR },
);
for (const node of nodes) {
  watching.observe(node);
}
