"use strict";

/** A count as a reader wants it: 0.25, 8.3, 1234. */
function galleryCount(value) {
  return value < 1 ? value.toFixed(2) : value < 100 ? value.toFixed(1) : value.toFixed(0);
}

/**
 * Maps of the work and its numbers, before a step and after it.
 * @param {HTMLElement} place
 * @param {{name: string, map: number, width: number, height: number, surfaces: number, boxes: number}[]} maps
 * @param {string[]} pictures
 */
function showGalleryWork(place, maps, pictures) {
  const figures = maps.map(({ name, map, width, height, surfaces, boxes }) => {
    const figure = document.createElement("figure");
    const image = Object.assign(new Image(width, height), {
      src: pictures[map],
      alt: `Map of the tests with ${name}: the brighter a pixel, the more tests it cost`,
    });
    const caption = document.createElement("figcaption");
    const strong = document.createElement("strong");
    strong.textContent = galleryCount(surfaces);
    const boxWords = boxes > 0 ? `, ${galleryCount(boxes)} of boxes` : "";
    caption.append(`${name}: `, strong, ` tests of surfaces${boxWords} per ray`);
    figure.append(image, caption);
    return figure;
  });
  place.replaceChildren(...figures);
  place.hidden = figures.length === 0;
}
