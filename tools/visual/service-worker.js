// SPDX-License-Identifier: MIT
// Keeps the page in the browser, so that it works without a network from the second visit on. The build fills in the
// version (a hash of all files) and their names.
//
//   a release --> installed beside the old version --waiting--> active, when no page of the old version is open any more,
//                                                               or when a person presses "New version: reload"
//
// A page that is open goes on with the files that it began with: they are kept as long as another page may want them, and
// whatever the new version does not have is looked for in the old ones.

const VERSION = '__VERSION__';
const FILES = ['__FILES__'];
const PREFIX = 'motion512-';
const CACHE = `${PREFIX}${VERSION}`;

/** The browser may still have the old release's file under a name without a hash: the page, whose scripts the host has no more. */
const newest = (file) => new Request(file, { cache: file.startsWith('assets/') ? 'default' : 'no-cache' });

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(FILES.map(newest))));
});

self.addEventListener('message', (event) => {
  if (event.data === 'take-over') self.skipWaiting();
});

async function ours() {
  return (await caches.keys()).filter((name) => name.startsWith(PREFIX));
}

/** One page may be open: the one that asked for the new version, and is about to reload. */
async function activate() {
  const pages = await self.clients.matchAll({ type: 'window', includeUncontrolled: true });
  const old = pages.length > 1 ? [] : (await ours()).filter((name) => name !== CACHE);
  await Promise.all(old.map((name) => caches.delete(name)));
  await self.clients.claim();
}

self.addEventListener('activate', (event) => event.waitUntil(activate()));

/** What is kept for a request: the page has two names. A host may redirect from one to the other, so only one is asked for. */
const nameOf = (request) => (request.url.split(/[?#]/, 1)[0] === `${self.registration.scope}index.html` ? self.registration.scope : request);

async function answer(request) {
  const others = (await ours()).filter((name) => name !== CACHE).reverse();
  for (const name of [CACHE, ...others]) {
    const kept = await (await caches.open(name)).match(nameOf(request), { ignoreVary: true, ignoreSearch: true });
    if (kept) return kept;
  }
  return fetch(request);
}

self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || !event.request.url.startsWith(self.registration.scope)) return;
  event.respondWith(answer(event.request));
});
