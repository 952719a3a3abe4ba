// What the page was made with, and its parts by their ids.

export const data = JSON.parse(document.getElementById("data").textContent);
export const element = (id) => document.getElementById(id);

// Once a program of a step has hung, the next ones get so much less time.
export const AFTER_A_STOP = 4;
