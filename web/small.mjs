// What the function `run` promises, in Node: exit codes, streams, files, languages, and the words for what is not there.
//   node web/small.mjs FOLDER      FOLDER has alembert.mjs and alembert.wasm
import { strict as assert } from "node:assert";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const before = performance.now();
const { load, prepare, run } = await import(pathToFileURL(resolve(process.argv[2], "alembert.mjs")));
await load();
const loaded = performance.now();
const scene = `title = "A pendulum"
gravity = [0, "-g"]

[parameters]
m = { value = 1.0, unit = "kg" }
l = { value = 1.0, unit = "m" }
g = { value = 9.81, unit = "m/s^2" }

[coordinates]
theta = { initial = 0.5, rate = 0, unit = "rad" }

[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]

[[claim]]
equation = "theta'' + g/l*sin(theta) = 0"
`;
const files = { "scene.toml": scene };
const first = await run(["derive", "scene.toml", "--json"], files);
const answered = performance.now();
assert.equal(first.code, 0, first.stderr);
assert.equal(JSON.parse(first.stdout).formalism.length > 0, true);
assert.deepEqual(first.files, {});
console.log(`loading ${(loaded - before).toFixed(0)} ms, first answer ${(answered - loaded).toFixed(0)} ms after it`);

// What is made before it is needed runs as any other does, once.
await Promise.all([prepare(), prepare()]);
const prepared = await run(["check", "scene.toml", "-", "--json"], files, { stdin: "$l \\ddot\\theta + g \\sin\\theta = 0$\n" });
assert.equal(prepared.code, 0, prepared.stderr);
assert.equal(JSON.parse(prepared.stdout).lines[0].status, "right");
assert.equal((await run(["derive", "scene.toml", "--json"], files)).stdout, first.stdout);

const version = await run(["--version"]);
assert.match(version.stdout, /^alembert \d/);
const missing = await run(["derive", "nothing.toml"]);
assert.equal(missing.code, 3);
assert.match(missing.stderr, /nothing\.toml/);
const wrong = await run(["derive", "scene.toml"], { "scene.toml": 'coordinates = ["x"\n' });
assert.equal(wrong.code, 3);
const chinese = await run(["derive", "scene.toml", "--language", "zh", "--steps"], files);
assert.match(chinese.stdout, /[\u4e00-\u9fff]/);
const compiled = await run(["simulate", "scene.toml", "--code", "compiled"], files);
assert.equal(compiled.code, 5);
assert.match(compiled.stderr, /no C\+\+ compiler/);
const motion = await run(["simulate", "scene.toml", "-o", "motions/first.csv"], { ...files, "motions/.keep": "" });
assert.equal(motion.code, 0, motion.stderr);
assert.match(motion.files["motions/first.csv"], /^t,theta/);
// Where the engine refuses to compile beside a running program, the same lines are interpreted: every digit is the same.
for (const method of ["taylor", "dop853"]) {
    const words = ["simulate", "scene.toml", "--method", method, "-o", "motion.csv"];
    const by_code = await run(words, files);
    const { Module } = WebAssembly;
    let refused = 0;
    WebAssembly.Module = function () {
        ++refused;
        throw new RangeError("refused");
    };
    const interpreted = await run(words, files);
    WebAssembly.Module = Module;
    assert.ok(refused > 0);
    assert.equal(interpreted.code, 0, interpreted.stderr);
    assert.equal(interpreted.files["motion.csv"], by_code.files["motion.csv"]);
}
// Eight systems side by side, two in a vector: where each of them is alone, to ten times the tolerance.
const swept = await run(["sweep", "scene.toml", "--vary", "theta=0.1:1.5:15", "--duration", "2", "--method", "dop853", "--tolerance", "1e-11",
    "--json", "-o", "table.csv"], files);
assert.equal(swept.code, 0, swept.stderr);
assert.equal(JSON.parse(swept.stdout).side_by_side, 8);
const rows = swept.files["table.csv"].trim().split("\n").map((row) => row.split(","));
for (const k of [1, 15]) {
    const start = rows[k][rows[0].indexOf("theta")];
    const alone = await run(["simulate", "scene.toml", "--duration", "2", "--method", "dop853", "--tolerance", "1e-11", "--json"],
        { "scene.toml": scene.replace("initial = 0.5", `initial = ${start}`) });
    assert.equal(alone.code, 0, alone.stderr);
    const { theta } = JSON.parse(alone.stdout).final.coordinates;
    assert.ok(Math.abs(theta - Number(rows[k][rows[0].indexOf("final_theta")])) < 1e-10);
}
const table = await run(["simulate", "scene.toml", "-o", "motion.npz"], files);
assert.equal(table.code, 0, table.stderr);
assert.ok(table.files["motion.npz"] instanceof Uint8Array);
const sent = await run(["emit", "scene.toml", "-o", "code"], files);
assert.equal(sent.code, 0, sent.stderr);
assert.ok(Object.keys(sent.files).some((name) => name.startsWith("code/") && name.endsWith(".cpp")));
// Runs do not see each other.
const both = await Promise.all([run(["check", "scene.toml", "--language", "zh"], files), run(["derive", "scene.toml", "--json"], files)]);
assert.equal(both[1].stdout, first.stdout);
console.log("the function run: as promised");
