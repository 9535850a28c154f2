// SPDX-License-Identifier: MIT
// Becomes the page that it is given. That page's own policy, by hashes, decides which scripts run.
"use strict";
addEventListener("message", ({ source, origin, data }) => {
    if (source !== parent || origin !== location.origin) return;
    const { html, scroll, open } = data;
    document.open();
    document.write(html);
    document.close();
    const folds = document.querySelectorAll("details");
    if (open?.length === folds.length) folds.forEach((fold, k) => { fold.open = open[k]; });
    scrollTo(0, scroll ?? 0);
    parent.postMessage({ shown: data.number }, origin);
});
parent.postMessage({ ready: true }, location.origin);
