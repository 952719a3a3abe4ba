"use strict";

/** Hides who is who: names, addresses of links and everything that may tell a name, until it is switched off. */
class ClassNames {
  /**
   * @param {ClassRows} rows
   */
  constructor(rows) {
    this.rows = rows;
    this.named = rows.rows.map(({ element, facts }) => ({ element: element.cells[0].firstElementChild, facts }));
    for (const element of document.querySelectorAll("[data-row]")) {
      this.named.push({ element, facts: rows.rows[Number(element.dataset.row)].facts });
    }
    for (const one of this.named) {
      one.address = one.element.getAttribute("href");
    }
  }

  /** @param {boolean} hide */
  set(hide) {
    this.rows.namesHidden = hide;
    document.documentElement.classList.toggle("names-hidden", hide);
    for (const { element, facts, address } of this.named) {
      element.textContent = hide ? facts.alias : facts.who;
      if (address !== null && hide) {
        element.removeAttribute("href");
      } else if (address !== null) {
        element.setAttribute("href", address);
      }
    }
  }
}
