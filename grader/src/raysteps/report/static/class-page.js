"use strict";

const classNamesHidden = "#names-hidden";

function startClassPage() {
  const data = JSON.parse(document.getElementById("data").textContent);
  const table = document.querySelector(".class-table");
  const form = document.getElementById("filters");
  const rows = new ClassRows(table, data.rows);
  const names = new ClassNames(rows);
  const sortAgain = makeSortable(table, rows);
  const filter = new ClassFilter(form, rows, data.mistakes, data.letters);

  for (const button of document.querySelectorAll("button[data-mistake]")) {
    button.addEventListener("click", () => {
      const mistake = Number(button.dataset.mistake);
      filter.choose(filter.mistake === mistake ? null : mistake);
      if (filter.mistake !== null) {
        document.getElementById("table").scrollIntoView();
        document.querySelector(".table-box").focus({ preventScroll: true });
      }
    });
  }

  const hide = document.getElementById("hide-names");
  function hideOrShow() {
    form.elements.namedItem("search").value = "";
    names.set(hide.checked);
    sortAgain();
    filter.apply();
    history.replaceState(null, "", hide.checked ? classNamesHidden : location.pathname);
  }
  hide.addEventListener("change", hideOrShow);
  document.getElementById("switches").hidden = false;
  form.hidden = false;
  hide.checked = location.hash === classNamesHidden;
  if (hide.checked) {
    hideOrShow();
  } else {
    filter.apply();
  }
}

startClassPage();
