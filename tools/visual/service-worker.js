// SPDX-License-Identifier: MIT
// Keeps the page in the browser, so that it works without a network from the second visit on. The build fills in the
// version (a hash of all files) and their names. A new version is fetched whole before it takes the place of the old one.

const VERSION = '__VERSION__';
const FILES = ['__FILES__'];
const CACHE = `motion512-${VERSION}`;

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(FILES)).then(() => self.skipWaiting()));
});

self.addEventListener('activate', (event) => {
  const isOld = (name) => name.startsWith('motion512-') && name !== CACHE;
  event.waitUntil(caches.keys().then((names) => Promise.all(names.filter(isOld).map((name) => caches.delete(name)))).then(() => self.clients.claim()));
});

self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || !event.request.url.startsWith(self.registration.scope)) return;
  const kept = caches.open(CACHE).then((cache) => cache.match(event.request, { ignoreVary: true, ignoreSearch: true }));
  event.respondWith(kept.then((response) => response ?? fetch(event.request)));
});
