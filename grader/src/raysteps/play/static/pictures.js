// Pictures: what raytrace writes, what is shown of it while it grows, and how it compares with the reference's. The
// words and the gate are those of images/compare.py.

const TOLERANCE = 2; // of 255

/** A binary PPM as raytrace writes it. */
export function readPpm(bytes) {
  const head = new TextDecoder("latin1").decode(bytes.subarray(0, 64));
  const found = /^P6\s+(\d+)\s+(\d+)\s+255\s/.exec(head);
  if (!found) {
    return null;
  }
  const [width, height] = [Number(found[1]), Number(found[2])];
  const pixels = bytes.subarray(found[0].length);
  return pixels.length === 3 * width * height ? { width, height, pixels } : null;
}

/** The pixels of an image of the page. */
export async function readImage(src) {
  const image = new Image();
  image.src = src;
  await image.decode();
  const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
  const context = canvas.getContext("2d", { colorSpace: "srgb" });
  context.drawImage(image, 0, 0);
  const { data, width, height } = context.getImageData(0, 0, canvas.width, canvas.height);
  const pixels = new Uint8Array(3 * width * height);
  for (let at = 0, from = 0; at < pixels.length; at += 3, from += 4) {
    pixels.set(data.subarray(from, from + 3), at);
  }
  return { width, height, pixels };
}

/** Puts rows of red, green and blue on a canvas. */
export function draw(canvas, { x = 0, y = 0, width, height, pixels }) {
  const image = new ImageData(width, height);
  for (let at = 0, to = 0; at < pixels.length; at += 3, to += 4) {
    image.data.set([pixels[at], pixels[at + 1], pixels[at + 2], 255], to);
  }
  canvas.getContext("2d").putImageData(image, x, y);
}

function isFlat({ pixels }) {
  return pixels.every((channel, at) => channel === pixels[at % 3]);
}

export const percent = (share) => `${(100 * share).toFixed(2)}%`;

/** Whether enough pixels are right, and what to say where they are not. */
export function compare(mine, reference, maxWrong) {
  if (mine.width !== reference.width || mine.height !== reference.height) {
    const size = (picture) => `${picture.width}x${picture.height}`;
    return { passed: false, message: `The picture is ${size(mine)} pixels, expected ${size(reference)}.` };
  }
  if (isFlat(mine) && !isFlat(reference)) {
    return { passed: false, message: "The whole picture has one colour." };
  }
  const count = mine.width * mine.height;
  let wrong = 0;
  let first = -1;
  for (let pixel = 0; pixel < count; pixel++) {
    const gaps = [0, 1, 2].map((channel) =>
      Math.abs(mine.pixels[3 * pixel + channel] - reference.pixels[3 * pixel + channel]),
    );
    if (Math.max(...gaps) > TOLERANCE) {
      wrong++;
      first = first < 0 ? pixel : first;
    }
  }
  if (wrong / count <= maxWrong) {
    return { passed: true, message: "" };
  }
  const color = ({ pixels }) => `(${pixels.subarray(3 * first, 3 * first + 3).join(", ")})`;
  const message =
    `${percent(wrong / count)} of the pixels are wrong (at most ${percent(maxWrong)} may be); ` +
    `the first is x=${first % mine.width}, y=${Math.floor(first / mine.width)}: ` +
    `its colour is ${color(mine)}, expected ${color(reference)}.`;
  return { passed: false, message };
}
