// SPDX-License-Identifier: MIT
// Loads the modules that modules.json of a folder names, and compares: node modules.mjs FOLDER
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const faults = new Function(`${readFileSync(new URL("modules.js", import.meta.url))}; return faults;`)();
const folder = process.argv[2];
let failed = 0;
for (const { module, calls } of JSON.parse(readFileSync(`${folder}/modules.json`))) {
  const found = faults(await import(pathToFileURL(resolve(folder, module))), calls);
  if (found.length) console.log(`FAILED ${module} in Node:\n    ${found.slice(0, 5).join("\n    ")}`);
  failed += found.length;
}
process.exit(failed ? 1 : 0);
