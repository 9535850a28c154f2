// SPDX-License-Identifier: MIT
// What of a scene is a table, a key, a text, a number or a comment: for colours, and for completion.

const PIECE = /(#.*)|("""|''')|("(?:[^"\\]|\\.)*"?|'[^']*'?)|(^\s*\[\[?[^\]#]*\]?\]?)|([A-Za-z_][\w.-]*|"[^"]*")(?=\s*=)|([+-]?\d[\w.+-]*|\btrue\b|\bfalse\b)/gu;
const CLASSES = ["comment", "text", "text", "table", "key", "number"];

/// The coloured spans [from, to, class] of each line.
export function colours(lines) {
    let until = null; // what ends a text of several lines
    return lines.map((line) => {
        const spans = [];
        let from = 0;
        if (until) {
            const end = line.indexOf(until);
            from = end < 0 ? line.length : end + 3;
            spans.push([0, from, "text"]);
            if (end >= 0) until = null;
        }
        PIECE.lastIndex = from;
        for (let found = PIECE.exec(line); found && found[0]; found = PIECE.exec(line)) {
            const kind = CLASSES[found.slice(1).findIndex((one) => one !== undefined)];
            let to = found.index + found[0].length;
            if (found[2]) {
                const end = line.indexOf(found[2], to);
                if (end < 0) until = found[2];
                to = end < 0 ? line.length : end + 3;
                PIECE.lastIndex = to;
            }
            spans.push([found.index, to, kind]);
            if (until) break;
        }
        return spans;
    });
}

/// What stands around a place of the text: `table` (its path, or [] before the first), `keys` (of inline tables that are open
/// there), and of what kind the place is: "table", "key", "value", "text" or "comment".
export function around(text, offset) {
    const lines = text.slice(0, offset).split("\n"), line = lines.at(-1);
    let table = [];
    for (let k = lines.length - 2; k >= 0; --k) {
        const header = /^\s*\[\[?\s*([^\]#]+?)\s*\]/.exec(lines[k]);
        if (header) {
            table = header[1].split(".").map((one) => one.trim().replace(/^"|"$/g, ""));
            break;
        }
    }
    if (/^\s*\[\[?[\w.]*$/.test(line)) return { kind: "table", table, keys: [] };
    return { table, ...inside(line) };
}

function inside(line) {
    const open = []; // keys of the inline tables and lists that are open
    let key = "", word = "", quote = "", after = false;
    for (const c of line) {
        if (quote) {
            if (c === quote) quote = "";
            continue;
        }
        if (c === "#") return { kind: "comment", keys: [] };
        if (c === '"' || c === "'") quote = c;
        else if (c === "=") [key, word, after] = [word.trim(), "", true];
        else if (c === "{" || c === "[") {
            open.push({ key, list: c === "[" });
            [key, word, after] = [c === "[" ? key : "", "", c === "["];
        } else if (c === "}" || c === "]") {
            const shut = open.pop();
            [key, word, after] = [shut?.key ?? "", "", true];
        } else if (c === ",") {
            const list = open.at(-1)?.list;
            [key, word, after] = [list ? key : "", "", Boolean(list)];
        } else word += c;
    }
    const keys = open.filter((one) => !one.list).map((one) => one.key);
    return { kind: quote ? "text" : after ? "value" : "key", key, keys };
}

/// Names that a scene gives: of quantities, and of what has a `name`.
export function names_of(text) {
    const quantities = new Set(), things = new Set();
    let table = "";
    for (const line of text.split("\n")) {
        const header = /^\s*\[\[?\s*([^\]#]+?)\s*\]/.exec(line);
        if (header) {
            table = header[1];
            const [of, name] = table.split(".");
            if (name && /^(parameters|inputs|coordinates|speeds|definitions|functions)$/.test(of)) quantities.add(name);
            continue;
        }
        const pair = /^\s*("?)([^\s"=]+)\1\s*=\s*(.*)$/u.exec(line);
        if (!pair) continue;
        if (/^(parameters|inputs|coordinates|speeds|definitions|functions)$/.test(table)) quantities.add(pair[2]);
        else if (pair[2] === "name") things.add(/"([^"]*)"/.exec(pair[3])?.[1] ?? "");
        if (table === "coordinates" || table === "speeds") quantities.add(pair[2] + "'");
    }
    things.delete("");
    return { quantities: [...quantities], things: [...things] };
}
