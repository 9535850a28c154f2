// SPDX-License-Identifier: MIT
// Compiled by tsc, not run: what the types promise.
import verbs, { AlembertError, check, derive, eval as evaluate, inWorker, mark, new as first_scene, run, simulate } from "alembert";

const text: string = (await derive("", { by: "lagrange", steps: true })).equations[0]!.text;
const verdict: "proved" | "refuted" | "undecided" | "vacuous" = (await check(text, { claims: ["a = b"] })).claims![0]!.verdict;
const theta: number = (await simulate(text, { duration: 1, maxStep: 0.1, worker: true })).final.coordinates["theta"]!;
const energy: number = (await evaluate({ files: { "a.toml": text } }, { at: { theta, "theta'": "pi/2" } })).energy;
const [begun]: (string | undefined)[] = Object.keys((await first_scene()).written).concat((await verbs.new()).told);
const away = await inWorker();
await away.sweep(text, { vary: { l: [1, 2, 3] } });
await away.terminate();
try {
    await mark(text, verdict);
} catch (problem) {
    if (problem instanceof AlembertError) console.log(problem.code, problem.diagnostics[0]?.line, energy, begun);
}
const { stdout }: { stdout: string } = await run(["--version"]);
// @ts-expect-error: there is no such formalism
await verbs.derive(stdout, { by: "newton" });
// @ts-expect-error: there is no such option
await verbs.derive(stdout, { colour: true });
