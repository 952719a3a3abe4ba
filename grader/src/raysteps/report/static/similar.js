"use strict";

/** Opens the pair that the address names, or that holds it. */
function openPair() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const pair = target?.closest("details");
  if (pair && !pair.open) {
    pair.open = true;
    target.scrollIntoView();
  }
}

function startSimilarPage() {
  const named = [...document.querySelectorAll(".who")].map((element) => ({ element, name: element.textContent }));
  const hide = document.getElementById("hide-names");
  function hideOrShow() {
    for (const { element, name } of named) {
      element.textContent = hide.checked ? element.dataset.alias : name;
    }
  }
  hide.addEventListener("change", hideOrShow);
  document.getElementById("switches").hidden = false;
  hideOrShow(); // a page that is loaded again keeps what was ticked
  window.addEventListener("hashchange", openPair);
  openPair();
}

startSimilarPage();
