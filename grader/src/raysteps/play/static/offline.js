// A service worker, on a published page only: keeps its files, so that later visits load nothing, and need no network.
// What is kept belongs together: another edition of the page keeps its own, when no tab has the old one open any more.

const EDITION = "@EDITION@"; // both are filled in where the page is published
const FIRST = ["@FIRST@"]; // files that are loaded before this one is there
const BEGINNING = `raysteps-play ${registration.scope} `;

addEventListener("install", (event) => {
  event.waitUntil(caches.open(BEGINNING + EDITION).then((cache) => cache.addAll(FIRST)));
});

addEventListener("activate", (event) => {
  const forget = async () => {
    const old = (await caches.keys()).filter((name) => name.startsWith(BEGINNING) && name !== BEGINNING + EDITION);
    await Promise.all(old.map((name) => caches.delete(name)));
    await clients.claim();
  };
  event.waitUntil(forget());
});

async function answer(request) {
  const cache = await caches.open(BEGINNING + EDITION);
  const kept = await cache.match(request, { ignoreSearch: true });
  if (kept) {
    return kept;
  }
  const found = await fetch(request);
  if (found.ok) {
    await cache.put(request, found.clone()).catch(() => {}); // there is no room: then it is loaded each time
  }
  return found;
}

addEventListener("fetch", (event) => {
  if (event.request.method === "GET" && event.request.url.startsWith(registration.scope)) {
    event.respondWith(answer(event.request));
  }
});
