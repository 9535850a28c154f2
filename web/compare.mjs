// Runs commands by the program as WebAssembly and by the native one, and compares what they give.
//   node web/compare.mjs NATIVE FOLDER [--chromium] [--scenes PATTERN] [--verbs NAME,NAME]
// FOLDER has alembert.mjs and alembert.wasm. Everything must be the same, byte for byte, apart from
//   - times that a run took ("seconds", "states_per_second"), and what is said of the code that ran ("code", "instructions",
//     "threads", "side_by_side");
//   - bounds of errors ("radii") and fingerprints of emitted code, which follow from the last digits;
//   - how many steps a run took, which may depend on the last digits, plots of rounding, and the points of lines to a
//     tenth of a pixel;
//   - which members of a continuum of equilibria or steady motions are shown, of those between which no way was found; that there is one, its dimension and the
//     coordinates that choose in it must be the same (`without_members`);
//   - numbers: the one program multiplies and adds in one rounding and calculates with 64 bits where the other has two
//     roundings and 113 bits, so that their last digits differ. `loose` says by how much, and why, for each verb.
import { spawn, spawnSync } from "node:child_process";
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync, existsSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [native, folder, ...options] = process.argv.slice(2);
const option = (name) => options.includes(name) ? options[options.indexOf(name) + 1] ?? "" : null;
const root = resolve(import.meta.dirname ?? new URL(".", import.meta.url).pathname, "..");

// A rounding of a double is 1.1e-16. A value without integration passes through sums of up to a thousand terms, which
// may cancel three digits: 1e-10. An error of a step's rounding grows with the motion, and events and the choice of
// steps follow from it: 1e-6 of the largest number of its kind.
// A double eigenvalue with one vector, such as the zero of what nothing holds, moves by the root of a rounding: 1e-9.
// A page prints six digits of some numbers, whose last one may differ.
const loose = { simulate: 1e-6, sweep: 1e-6, report: 2e-6, stability: 1e-7, linearize: 1e-9, bench: 1, default: 1e-10 };

const verbs = {
    derive: [["derive", "S", "--json"], ["derive", "S", "--steps"], ["derive", "S", "--steps", "--format", "latex", "--reactions"]],
    derive_zh: [["derive", "S", "--steps", "--language", "zh"]],
    check: [["check", "S", "--json"], ["check", "S"]],
    agree: [["agree", "S", "--json"]],
    audit: [["audit", "S", "--json"]],
    eval: [["eval", "S", "--json", "--reactions"]],
    inverse: [["inverse", "S", "--json"]],
    impact: [["impact", "S", "--json"]],
    inertia: [["inertia", "S", "--json"]],
    identify: [["identify", "S", "--json"]],
    kinematics: [["kinematics", "S", "--json", "--steps"]],
    equilibrium: [["equilibrium", "S", "--json"]],
    linearize: [["linearize", "S", "--json"]],
    stability: [["stability", "S", "--json"]],
    emit: [["emit", "S", "-o", "out", "--jacobian", "--json"], ["emit", "S", "-o", "out", "--language", "c"]],
    simulate: [["simulate", "S", "--json", "--duration", "0.5", "-o", "motion.csv"]],
    sweep: [["sweep", "S", "--json", "--duration", "0.05", "--vary", "t=0:0.1:3", "-o", "table.csv"]],
    report: [["report", "S", "--duration", "0.2", "-o", "page.html"]],
};

function commands() {
    const pattern = new RegExp(option("--scenes") ?? "."), wanted = option("--verbs")?.split(",") ?? Object.keys(verbs);
    const list = [];
    for (const file of readdirSync(join(root, "scenes/textbook")).sort()) {
        if (!file.endsWith(".toml") || !pattern.test(file)) continue;
        for (const verb of wanted)
            for (const words of verbs[verb])
                list.push({ verb, file, words: words.map((word) => (word === "S" ? file : word)) });
    }
    return list;
}

function written_in(place, before) {
    const files = {};
    for (const name of readdirSync(place, { recursive: true }).sort())
        if (statSync(join(place, name)).isFile() && name !== before) files[name] = readFileSync(join(place, name), "utf8");
    return files;
}

function by_native({ file, words }) {
    const place = mkdtempSync(join(tmpdir(), "alembert-web-"));
    writeFileSync(join(place, file), scene_text(file));
    const begin = performance.now();
    const ended = spawnSync(resolve(native), words, {
        cwd: place, encoding: "utf8", maxBuffer: 1 << 28,
        // Without a cache `auto` goes by counts, as in WebAssembly, and not by what steps were measured to take here.
        env: { ...process.env, LC_ALL: "C.UTF-8", XDG_CACHE_HOME: "/dev/null" },
    });
    const seconds = (performance.now() - begin) / 1000;
    const files = written_in(place, file);
    rmSync(place, { recursive: true });
    return { code: ended.status, stdout: ended.stdout, stderr: ended.stderr, files, seconds };
}

const texts = new Map();
function scene_text(file) {
    if (!texts.has(file)) texts.set(file, readFileSync(join(root, "scenes/textbook", file), "utf8"));
    return texts.get(file);
}

// Numbers as they stand in texts, JSON, tables and pages.
const number = /(?<![\w.])-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])/g;

// A plot whose axis has ticks of 10⁻¹² or less, or which shows nothing but zeros, shows rounding alone.
const is_rounding = /·10<tspan[^>]*>-1[2-9]<|data-y="-1,1"/;

/// A table without the columns that tell how many steps a motion took.
function without_counts(table) {
    const rows = table.split("\n").map((line) => line.split(",")), head = rows[0];
    return rows.map((row) => row.filter((_, k) => !/^(steps|rejected|evaluations)$/.test(head[k] ?? "")).join(",")).join("\n");
}

/// A continuum that the program tells as such has no members that are better than others: of a list of equilibria, by verb and file,
/// what is told of continua is left, behind those that are alone.
function without_members(verb, name, text) {
    if (verb === "equilibrium" && name === "stdout" && text.startsWith("{")) {
        const all = JSON.parse(text), families = all.equilibria?.filter(({ isolated }) => !isolated) ?? [];
        if (!families.length) return text;
        all.equilibria = all.equilibria.filter(({ isolated }) => isolated);
        return JSON.stringify({ ...all, families: [...new Set(families.map(({ family }) => JSON.stringify(family)))].sort() }, null, 2);
    }
    const marked = /beside it there is one for each value of/;
    if (verb !== "report" || !marked.test(text)) return text;
    return text.replace(/<section id="stability"[\s\S]*?<\/section>/, (section) => {
        const rows = section.match(/<tr><th scope="row">[\s\S]*?<\/tr>/g).map((row) => row.replace(/<th.*?<\/th>/, ""));
        const told = rows.map((row) => (marked.test(row) ? row.match(/beside it .*?<\/td>/)[0] : row)).sort();
        return [...new Set(told)].join("\n") + section.replace(/<tbody>[\s\S]*?<\/tbody>/, "").replace(/<figure[\s\S]*?<\/figure>/, "");
    });
}

/// What is the same in both but for numbers, and the numbers. A zero is a number, because the other may have 1e-17.
function taken_apart(text, is_table) {
    const numbers = [];
    const words = (is_table ? without_counts(text) : text)
        .replace(/"seconds": *(\{[^}]*\}|[^,{}\n]*)/g, '"seconds": …')
        .replace(/"radii": *\[[^\]]*\]/g, '"radii": …') // bounds of errors
        .replace(/"(code|instructions|cached|threads|side_by_side|states_per_second|steps|rejected|evaluations)": *[^,{}\n]*/g, '"$1": …')
        .replace(/<svg[\s\S]*?<\/svg>/g, (plot) => (is_rounding.test(plot) ? "<svg>rounding</svg>" : plot))
        .replace(/ class="line[^"]*" d="[^"]*"/g, (path) => path.match(/[MLh]-?[\d.]+( -?[\d.]+)?/g)?.sort().join(" ").replace(/[MLh]/g, "$& ") ?? path)
        .replace(/ +/g, " ") // columns are as wide as their numbers
        .replace(/sha256-[\w+\/=]*/g, "sha256-…") // of scripts and styles that hold the page's numbers
        .replace(/(?<=_|\b0x)[0-9a-f]{8}\b/g, "…") // the fingerprint of emitted code
        .replace(/\d+(\.\d+)? (s|ms|µs)\b/g, "… s")
        .replace(number, (found) => {
            if (!is_table && /^-?\d{1,15}$/.test(found) && Math.abs(Number(found)) < 1000 && Number(found) !== 0) return found;
            numbers.push(Number(found));
            return "#";
        });
    return { words, numbers };
}

function difference(name, mine, other, tolerance) {
    if (mine === other) return { far: 0 };
    const is_table = name.endsWith(".csv"), a = taken_apart(mine, is_table), b = taken_apart(other, is_table);
    if (a.words !== b.words || a.numbers.length !== b.numbers.length) {
        const lines = a.words.split("\n"), others = b.words.split("\n");
        const k = lines.findIndex((line, i) => line !== others[i]);
        return { far: Infinity, what: `${name}:${k + 1}: ${lines[k]?.slice(0, 200)} | ${others[k]?.slice(0, 200)}` };
    }
    let far = 0, what = "";
    const largest = Math.max(1, ...a.numbers.filter(Number.isFinite).map(Math.abs).filter((x) => x < 1e6));
    for (let k = 0; k < a.numbers.length; ++k) {
        const x = a.numbers[k], y = b.numbers[k];
        if (Object.is(x, y) || x === y) continue;
        const d = Math.abs(x - y) / Math.max(largest, Math.abs(x));
        if (!(d <= far)) far = d, what = `${name}: ${x} | ${y}`;
    }
    return { far, what: far > tolerance ? what : undefined };
}

function compared(command, mine, other) {
    const tolerance = loose[command.verb] ?? loose.default;
    let far = 0, what;
    if (mine.code !== other.code) return { far: Infinity, what: `exit code ${mine.code} | ${other.code}: ${mine.stderr.slice(0, 300)}` };
    const pieces = [["stdout", mine.stdout, other.stdout], ["stderr", mine.stderr, other.stderr]];
    const names = new Set([...Object.keys(mine.files), ...Object.keys(other.files)]);
    for (const name of names) pieces.push([name, mine.files[name] ?? "", other.files[name] ?? ""]);
    for (const [name, a, b] of pieces) {
        const [own, given] = [a, b].map((text) => without_members(command.verb, name, String(text)));
        const found = difference(name, own, given, tolerance);
        far = Math.max(far, found.far);
        what ??= found.what;
    }
    return { far, what };
}

async function in_node(list, tell) {
    const { run } = await import(pathToFileURL(resolve(folder, "alembert.mjs")));
    for (const command of list) {
        const begin = performance.now();
        const result = await run(command.words, { [command.file]: scene_text(command.file) });
        tell(command, { ...result, seconds: (performance.now() - begin) / 1000 });
    }
}

/// The page runs the commands in a worker and sends each result.
const page = `<!doctype html><meta charset="utf-8"><script type="module">
const worker = new Worker("/worker.mjs", { type: "module" });
worker.onerror = (event) => fetch("/failed", { method: "POST", body: String(event.message) });
</script>`;
const worker = `import { run } from "/alembert.mjs";
const list = await (await fetch("/commands")).json();
for (const [k, { words, file, text }] of list.entries()) {
    const begin = performance.now();
    const result = await run(words, { [file]: text });
    for (const [name, value] of Object.entries(result.files)) result.files[name] = String(value);
    await fetch("/result/" + k, { method: "POST", body: JSON.stringify({ ...result, seconds: (performance.now() - begin) / 1000 }) });
}
await fetch("/done", { method: "POST" });`;

function in_chromium(list, tell) {
    return new Promise((done, fail) => {
        const kinds = { ".mjs": "text/javascript", ".wasm": "application/wasm" };
        let browser = null;
        const profile = mkdtempSync(join(tmpdir(), "alembert-chromium-"));
        const finish = (problem) => {
            server.close();
            server.closeAllConnections?.();
            browser.once("exit", () => {
                rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
                problem ? fail(new Error(problem)) : done();
            });
            browser.kill();
        };
        const server = createServer(async (request, answer) => {
            const body = [];
            for await (const part of request) body.push(part);
            const text = Buffer.concat(body).toString();
            const sent = (type, content) => answer.writeHead(200, { "content-type": type }).end(content);
            if (request.url === "/") return sent("text/html", page);
            if (request.url === "/worker.mjs") return sent("text/javascript", worker);
            if (request.url === "/commands")
                return sent("application/json", JSON.stringify(list.map((c) => ({ ...c, text: scene_text(c.file) }))));
            if (request.url.startsWith("/result/")) {
                tell(list[Number(request.url.slice(8))], JSON.parse(text));
                return sent("text/plain", "");
            }
            if (request.url === "/done" || request.url === "/failed") {
                sent("text/plain", "");
                return finish(request.url === "/failed" ? text : null);
            }
            const ending = request.url.slice(request.url.lastIndexOf(".")), file = join(folder, request.url);
            if (kinds[ending] && existsSync(file)) return sent(kinds[ending], readFileSync(file));
            answer.writeHead(404).end();
        }).listen(0, "127.0.0.1", () => {
            browser = spawn("chromium", ["--headless", "--no-sandbox", "--disable-gpu", `--user-data-dir=${profile}`,
                `http://127.0.0.1:${server.address().port}/`], { stdio: "ignore" });
            browser.once("error", (problem) => fail(problem));
        });
    });
}

const list = commands(), rows = new Map(), problems = [], expected = new Map();
const tell = (command, result) => {
    if (!expected.has(command)) expected.set(command, by_native(command));
    const other = expected.get(command), { far, what } = compared(command, result, other);
    const row = rows.get(command.verb) ?? { runs: 0, same: 0, close: 0, different: 0, far: 0, native: 0, web: 0 };
    ++row.runs;
    ++row[what ? "different" : far === 0 ? "same" : "close"];
    if (!what) row.far = Math.max(row.far, far);
    row.native += other.seconds;
    row.web += result.seconds;
    rows.set(command.verb, row);
    if (what) {
        problems.push(command);
        console.log(`DIFFERENT: alembert ${command.words.join(" ")}\n    ${what}`);
    }
};
for (const where of options.includes("--chromium") ? ["Node", "Chromium"] : options.includes("--chromium-only") ? ["Chromium"] : ["Node"]) {
    rows.clear();
    await (where === "Node" ? in_node : in_chromium)(list, tell);
    console.log(`\n${where.padEnd(12)}  runs  same  close  different  largest difference  native s   web s`);
    for (const [verb, r] of rows)
        console.log(`${verb.padEnd(12)} ${String(r.runs).padStart(5)} ${String(r.same).padStart(5)} ${String(r.close).padStart(6)} ` +
            `${String(r.different).padStart(10)} ${r.far.toExponential(1).padStart(19)} ${r.native.toFixed(1).padStart(9)} ${r.web.toFixed(1).padStart(7)}`);
}
process.exitCode = problems.length ? 1 : 0;
