"use strict";

/**
 * @typedef {object} Facts what is known of a row
 * @property {string} who
 * @property {string} alias what it is called while names are hidden
 * @property {string} words it is found by, in lower case
 * @property {(number|null)[]} keys the numbers of its columns after the name
 * @property {string[]} statuses of its steps
 * @property {number[]} mistakes
 * @property {boolean} look
 * @property {boolean} late
 * @property {boolean} changed a person changed its points
 */

const classByName = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" });

/** The rows of the table: put in an order, shown or not. All keys are known before; nothing is read from the page. */
class ClassRows {
  /**
   * @param {HTMLTableElement} table
   * @param {Facts[]} facts in the order of the rows
   */
  constructor(table, facts) {
    this.body = table.tBodies[0];
    this.rows = Array.from(this.body.rows, (element, index) => ({ element, index, facts: facts[index] }));
    this.namesHidden = false;
  }

  /** The name to sort and find a row by. */
  name(row) {
    return this.namesHidden ? row.facts.alias : row.facts.who;
  }

  /**
   * @param {number} column 0 is the name
   * @param {number} direction 1 upwards, -1 downwards; rows without a value stay at the end
   */
  sort(column, direction) {
    const inOrder = [...this.rows].sort((a, b) => {
      if (column === 0) {
        return direction * classByName.compare(this.name(a), this.name(b)) || a.index - b.index;
      }
      const [left, right] = [a.facts.keys[column - 1], b.facts.keys[column - 1]];
      if (left === null || right === null) {
        return (left === null) - (right === null) || a.index - b.index;
      }
      return direction * (left - right) || a.index - b.index;
    });
    const fragment = document.createDocumentFragment();
    fragment.append(...inOrder.map((row) => row.element));
    this.body.append(fragment);
  }

  /**
   * @param {(row: {facts: Facts}) => boolean} wanted
   * @returns {number} how many are shown
   */
  filter(wanted) {
    let shown = 0;
    for (const row of this.rows) {
      const show = wanted(row);
      shown += show;
      if (row.element.hidden === show) {
        row.element.hidden = !show;
      }
    }
    return shown;
  }
}

/**
 * Makes the headings of the columns into buttons that sort.
 * @param {HTMLTableElement} table
 * @param {ClassRows} rows
 * @returns {() => void} sorts once more, by what was chosen last
 */
function makeSortable(table, rows) {
  const headings = [...table.tHead.querySelectorAll("th[data-column]")];
  let chosen = null;
  let direction = 1;

  function choose(heading) {
    const column = Number(heading.dataset.column);
    direction = heading === chosen ? -direction : column === 0 ? 1 : -1;
    chosen = heading;
    rows.sort(column, direction);
    for (const other of headings) {
      other.removeAttribute("aria-sort");
    }
    heading.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
  }

  for (const heading of headings) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => choose(heading));
  }
  return () => chosen && rows.sort(Number(chosen.dataset.column), direction);
}
