// SPDX-License-Identifier: MIT
// A browser refuses workers to a page that was opened from the disk. The search of MkDocs Material then runs in a hidden frame, which
// answers as a worker does; that it is one, it sees by the name IFrameWorker.
"use strict";
if (location.protocol === "file:") {
    class IFrameWorker extends EventTarget {
        constructor(address) {
            super();
            this.frame = document.createElement("iframe");
            this.frame.hidden = true;
            document.body.append(this.frame);
            const inside = this.frame.contentWindow;
            addEventListener("message", ({ source, data }) => {
                if (source === inside) this.dispatchEvent(new MessageEvent("message", { data }));
            });
            inside.postMessage = (data) => window.dispatchEvent(new MessageEvent("message", { source: inside, data }));
            inside.importScripts = async (...addresses) => {
                for (const one of addresses) await this.load(one);
            };
            this.ready = this.load(address);
        }

        load(address) {
            return new Promise((done, failed) => {
                const script = this.frame.contentDocument.createElement("script");
                Object.assign(script, { src: address, onload: done, onerror: failed });
                this.frame.contentDocument.body.append(script);
            });
        }

        postMessage(data) {
            this.ready.then(() => this.frame.contentWindow.dispatchEvent(new MessageEvent("message", { data })));
        }

        terminate() {
            this.frame.remove();
        }
    }
    window.IFrameWorker = window.Worker = IFrameWorker;
}
