"use strict";

/**
 * Copies a text that is also seen on the page. Where a browser forbids it, the text is selected for the reader to copy.
 * @param {HTMLElement} shown the element that shows the text
 * @returns {Promise<boolean>} whether it is in the clipboard
 */
async function copyShown(shown) {
  try {
    await navigator.clipboard.writeText(shown.textContent.trim());
    return true;
  } catch {
    const selection = window.getSelection();
    selection.selectAllChildren(shown);
    return document.execCommand("copy");
  }
}

/**
 * A button that copies what stands in an element, and says so.
 * @param {HTMLButtonElement} button
 * @param {HTMLElement} shown
 */
function makeCopyButton(button, shown) {
  const label = button.textContent;
  let back = 0;
  button.addEventListener("click", async () => {
    button.textContent = (await copyShown(shown)) ? "Copied" : "Selected: Ctrl+C";
    clearTimeout(back);
    back = setTimeout(() => {
      button.textContent = label;
    }, 2500);
  });
}

for (const button of document.querySelectorAll("button[data-copy]")) {
  makeCopyButton(button, document.getElementById(button.dataset.copy));
}
