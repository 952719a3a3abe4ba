"use strict";

/** Unfolds the step that the address names. */
function unfoldTarget() {
  const target = document.getElementById(location.hash.slice(1));
  if (target instanceof HTMLDetailsElement) {
    target.open = true;
    target.scrollIntoView();
  }
}

/** The button that unfolds all steps, and folds them again. */
function listenToUnfold(button, steps) {
  const tell = () => {
    button.textContent = steps.every(({ open }) => open) ? "Fold all" : "Unfold all";
  };
  button.hidden = false;
  button.addEventListener("click", () => {
    const open = !steps.every((step) => step.open);
    steps.forEach((step) => {
      step.open = open;
    });
  });
  for (const step of steps) {
    step.addEventListener("toggle", tell);
  }
  tell();
}

for (const link of document.querySelectorAll('a[href^="#step-"]')) {
  link.addEventListener("click", () => setTimeout(unfoldTarget));
}
addEventListener("hashchange", unfoldTarget);
listenToUnfold(document.getElementById("unfold"), [...document.querySelectorAll("details.step")]);
unfoldTarget();
