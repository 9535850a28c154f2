// SPDX-License-Identifier: MIT
// Colours of a derivation: what LaTeX commands, comments and the borders of formulas are.

const PIECE = /((?:^|(?<!\\))%.*)|(\\begin\{[^}]*\}|\\end\{[^}]*\}|\$\$?|\\[[\]()])|(\\[A-Za-z]+)|(^#+ .*)/g;
const CLASSES = ["comment", "table", "key", "table"];

export function derivation_colours(lines) {
    return lines.map((line) => Array.from(line.matchAll(PIECE), (found) =>
        [found.index, found.index + found[0].length, CLASSES[found.slice(1).findIndex((one) => one !== undefined)]]));
}
