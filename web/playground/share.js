// SPDX-License-Identifier: MIT
// A scene and a derivation as the fragment of an address, which browsers do not send: `#1.` and then JSON, packed by
// "deflate-raw" and written in base64url.

const MOST = 1 << 20; // characters of a scene and a derivation together

export const can_pack = () => typeof CompressionStream === "function";

async function through(stream, bytes, most = Infinity) {
    const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
    const parts = [];
    let size = 0;
    for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        size += value.length;
        if (size > most) throw new Error("it is too long");
        parts.push(value);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

function as_base64url(bytes) {
    let text = "";
    for (let k = 0; k < bytes.length; k += 4096) text += String.fromCharCode(...bytes.subarray(k, k + 4096));
    return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function from_base64url(text) {
    return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
}

/// The fragment for these texts: `{scene, derivation, tab}`.
export async function fragment_of(texts) {
    const json = new TextEncoder().encode(JSON.stringify(texts));
    return "#1." + as_base64url(await through(new CompressionStream("deflate-raw"), json));
}

/// The texts of a fragment, or null where it is none of ours.
export async function texts_of(fragment) {
    if (!fragment.startsWith("#1.")) return null;
    const bytes = await through(new DecompressionStream("deflate-raw"), from_base64url(fragment.slice(3)), MOST);
    const { scene, derivation = "", tab = "scene" } = JSON.parse(new TextDecoder().decode(bytes));
    if (typeof scene !== "string" || typeof derivation !== "string") throw new Error("it has no scene");
    return { scene, derivation, tab: tab === "derivation" ? "derivation" : "scene" };
}
