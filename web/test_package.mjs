// SPDX-License-Identifier: MIT
// The module `alembert` as its user has it: node test_package.mjs ROOT, in a folder where it is installed.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import alembert, { AlembertError, check, derive, emit, equilibrium, eval as evaluate, inWorker, inverse, load, mark, new as first_scene, report, run,
    simulate, stability, sweep, version } from "alembert";

const root = process.argv[2];
const scene = readFileSync(`${root}/scenes/textbook/double_pendulum.toml`, "utf-8");
const pendulum = readFileSync(`${root}/web/package/README.md`, "utf-8").match(/const pendulum = `([^`]*)`/)[1];
const derivation = readFileSync(`${root}/tests/derivations/double_pendulum_sign.tex`, "utf-8");

const began = performance.now();
await load();
console.log(`       compiled in ${Math.round(performance.now() - began)} ms`);

const tests = {
    async "a pendulum's equation"() {
        assert.equal((await derive(pendulum)).equations[0].text, "l*theta'' + g*sin(theta) = 0");
    },
    async "claims of the scene, and others"() {
        const own = await check(scene);
        assert.deepEqual(own.claims.map(({ verdict }) => verdict), ["proved", "proved"]);
        assert.equal(own.exitCode, 0);
        const wrong = await check(pendulum, { claims: ["l*theta'' + g*cos(theta) = 0"] });
        assert.equal(wrong.claims[0].verdict, "refuted");
        assert.equal(wrong.claims[0].likely.repair, "l*theta'' + g*sin(theta) = 0");
        assert.equal(wrong.exitCode, 1);
    },
    async "a derivation"() {
        const marked = await mark(scene, derivation, { html: "marked.html" });
        assert.equal(marked.lines[marked.first_mistake].line, 5);
        assert.match(marked.written["marked.html"], /^<!DOCTYPE html>/);
    },
    async "the state that is asked for"() {
        const { accelerations, energy } = await evaluate(pendulum, { at: { theta: "pi/2", "theta'": 0 } });
        assert.ok(Math.abs(accelerations.theta + 9.81 / 2) < 1e-14);
        assert.ok(Math.abs(energy) < 1e-14);
        const inert = await inverse(pendulum, { at: { theta: "pi/2", "theta'": 0, "theta''": 0 } });
        assert.ok(Math.abs(inert.loads.theta - 2 * 9.81) < 1e-12);
    },
    async "a motion, with its table, keeps its energy"() {
        const motion = await simulate(pendulum, { duration: 2, output: "motion.csv", sample: 0.5 });
        assert.ok(motion.energy_drift < 1e-8, `${motion.energy_drift}`);
        assert.equal(motion.written["motion.csv"].trim().split("\n").length, 6);
        assert.equal(motion.final.time, 2);
    },
    async "a sweep over a parameter"() {
        const { written } = await sweep(pendulum, { vary: { l: [1, 2, 3] }, duration: 0.1, output: "table.csv" });
        assert.equal(written["table.csv"].trim().split("\n").length, 4);
    },
    async "equilibria and stability"() {
        assert.ok((await equilibrium(pendulum)).equilibria.length >= 1);
        assert.equal((await stability(pendulum, { at: { theta: "pi" } })).exitCode, 1);
    },
    async "sources, a page, a first scene"() {
        const sources = await emit(pendulum, { language: "js" });
        assert.match(Object.values(sources.written)[0], /export/);
        const page = await report(pendulum, { noMotion: true, derivation: "T = m*l^2*theta'^2/2\n" });
        assert.match(page.written[page.file], /Equations of motion/);
        assert.match(page.written[page.file], /class="marked/);
        const begun = await first_scene();
        assert.match(begun.written[begun.file], /\[\[particle\]\]/);
    },
    async "several files"() {
        assert.equal((await derive({ files: { "a.toml": pendulum, "b.toml": "no scene" }, scene: "a.toml" })).equations.length, 1);
    },
    async "files have the names of what is written"() {
        for (const options of [{ language: "js" }, { language: "c", output: "solver/deep" }]) {
            const sources = await emit(pendulum, options);
            assert.ok(sources.files.length > 0 && sources.files.every((name) => name in sources.written), `${sources.files}`);
        }
        assert.deepEqual(Object.keys((await simulate(pendulum, { duration: 1, output: "there/motion.csv" })).written), ["there/motion.csv"]);
    },
    async "a mistake in a file with a blank in its name"() {
        await assert.rejects(derive({ files: { "a b.toml": "x =" } }), (problem) => problem.diagnostics.length > 0 && problem.diagnostics[0].file === "a b.toml");
    },
    async "workers share the program that is compiled"() {
        const all = await Promise.all(Array.from({ length: 6 }, () => inWorker()));
        const found = await Promise.all(all.map((one) => one.derive(pendulum)));
        for (const { equations } of found) assert.equal(equations.length, 1);
        await Promise.all(all.map((one) => one.terminate()));
    },
    async "a mistake in the scene"() {
        const wrong = pendulum.replace("cos(theta)", "cos(thetta)");
        await assert.rejects(derive(wrong), (problem) => problem instanceof AlembertError && problem.code === 3 && problem.diagnostics[0].line === 15
            && problem.diagnostics[0].column > 1 && /thetta/.test(problem.message));
    },
    async "numbers that fail keep what was calculated"() {
        await assert.rejects(simulate(pendulum, { duration: 1000, budget: 50, output: "part.csv" }), (problem) => problem.code === 4 && problem.written["part.csv"].length > 0);
    },
    async "options that are none"() {
        await assert.rejects(derive(pendulum, { colour: true }), /derive has no option 'colour'; there are /);
        await assert.rejects(derive(pendulum, { steps: 3 }), /'steps' is true or false/);
        await assert.rejects(simulate(pendulum, { duration: true }), /needs a value/);
        await assert.rejects(simulate(pendulum, { duration: NaN }), TypeError);
        await assert.rejects(simulate(pendulum, { budget: 1e12 }), /--budget 1000000000000: expected a whole number from 1 to 2147483647/);
    },
    async "names with an underscore or a capital are the same"() {
        const a = await simulate(pendulum, { duration: 1, max_step: 0.01 }), b = await simulate(pendulum, { duration: 1, maxStep: 0.01 });
        assert.equal(a.steps, b.steps);
        assert.ok(a.steps >= 100);
    },
    async "work in a worker leaves the thread free"() {
        let ticks = 0;
        const clock = setInterval(() => { ++ticks; }, 5);
        const away = await inWorker();
        const [a, b] = await Promise.all([away.derive(pendulum), away.simulate(scene, { duration: 5 })]);
        clearInterval(clock);
        assert.equal(a.equations.length, 1);
        assert.equal(b.final.time, 5);
        assert.ok(ticks > 5, `${ticks}`);
        await away.terminate();
        await assert.rejects(away.derive(pendulum), /terminated/);
    },
    async "a signal ends work"() {
        const start = performance.now();
        await assert.rejects(simulate(scene, { duration: 1e7, budget: 1e9, signal: AbortSignal.timeout(1500) }), { name: "TimeoutError" });
        assert.ok(performance.now() - start < 20_000);
        assert.equal((await derive(pendulum, { worker: true })).equations.length, 1);
    },
    async "the command line, and all verbs in one object"() {
        const { code, stdout } = await run(["--version"]);
        assert.equal(code, 0);
        assert.equal(stdout.trim(), `alembert ${version}`);
        for (const verb of ["derive", "check", "audit", "eval", "equilibrium", "stability", "simulate", "sweep", "bench", "emit", "import", "report", "new", "agree", "impact"])
            assert.equal(typeof alembert[verb], "function", verb);
    },
};
let failures = 0;
for (const [name, test] of Object.entries(tests)) {
    try {
        await test();
        console.log(`ok     ${name}`);
    } catch (problem) {
        ++failures;
        console.log(`FAILED ${name}\n${problem.stack}`);
    }
}
process.exitCode = failures ? 1 : 0;
