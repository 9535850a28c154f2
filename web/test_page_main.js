// SPDX-License-Identifier: MIT
// A page of somebody else, which bundlers put together (test_package.sh); test_page.mjs prints what it says.
import { derive, emit, inWorker, simulate } from "alembert";

const scene = `gravity = [0, "-g"]
[parameters]
m = 1
l = 2
g = 9.81
[coordinates]
theta = 1
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
`;
const said = [];
function expect(what, holds) {
    said.push(`${holds ? "ok    " : "FAILED"} ${what}`);
    if (!holds) throw new Error(what);
}
try {
    expect("an equation", (await derive(scene)).equations[0].text === "l*theta'' + g*sin(theta) = 0");
    expect("a motion in a worker", Number.isFinite((await simulate(scene, { duration: 3, worker: true })).final.coordinates.theta));
    const away = await inWorker(), sources = await away.emit(scene, { language: "js" });
    expect("a worker that stays", (await away.derive(scene)).formalism.length > 0);
    expect("files by the names of what is written", sources.files.every((name) => name in sources.written));
    await away.terminate();
    const problem = await simulate(scene, { duration: 1e7, budget: 1e9, signal: AbortSignal.timeout(1500) }).catch((one) => one);
    expect("a signal ends a motion", problem.name === "TimeoutError");
    expect("the page goes on", Object.keys((await emit(scene, { language: "c", output: "a/b" })).written).includes("a/b/scene.c"));
    said.push("done");
} catch (problem) {
    said.push(problem.stack);
}
await fetch("/said", { method: "POST", body: said.join("\n") });
