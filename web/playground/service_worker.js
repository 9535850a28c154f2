// SPDX-License-Identifier: MIT
// Keeps the whole folder, so that the page works without a network. web/playground.sh writes the list of its files and
// VERSION, a hash of their contents. A new version waits until the last window with the old one is closed.
"use strict";
const VERSION = "@VERSION@";
const FILES = "@FILES@";
const NAME = `alembert-playground ${registration.scope} `;

addEventListener("install", (event) => event.waitUntil(caches.open(NAME + VERSION)
    .then((cache) => cache.addAll(FILES.map((file) => new Request(file, { cache: "no-cache" }))))));

addEventListener("activate", (event) => event.waitUntil(caches.keys()
    .then((names) => Promise.all(names.filter((name) => name.startsWith(NAME) && name !== NAME + VERSION).map((name) => caches.delete(name))))
    .then(() => clients.claim())));

addEventListener("fetch", (event) => {
    const { method, url } = event.request;
    if (method !== "GET" || !url.startsWith(registration.scope)) return;
    event.respondWith(caches.open(NAME + VERSION)
        .then((cache) => cache.match(url, { ignoreSearch: true, ignoreVary: true }))
        .then((kept) => kept ?? fetch(event.request)));
});
