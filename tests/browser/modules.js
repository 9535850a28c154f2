// SPDX-License-Identifier: MIT
// What a module of JavaScript gives otherwise than it should: `faults(module, calls)` for tests/emit_javascript.cpp.
function faults(scene, calls) {
  const found = [], worst = { ratio: 0, name: "" }, par = scene.defaults();
  const sizes = { rhs: 0, energy: 4, outputs_at: 0, project: 0, multipliers_at: 0 };
  calls.forEach((call, k) => {
    for (const name of Object.keys(sizes)) {
      if (!call[name]) continue;
      const { values, bounds } = call[name], out = new Float64Array(values.length), other = new Float64Array(200);
      const state = new Float64Array(call.state), rate = new Float64Array(call.rate);
      if (name === "rhs") scene.rhs(call.t, state, par, out);
      else if (name === "energy") scene.energy(call.t, state, rate, par, out, other);
      else if (name === "outputs_at") scene.outputs_at(call.t, state, rate, par, out);
      else if (name === "project") scene.project(call.t, state, par, out, other, new Float64Array(200));
      else scene.multipliers_at(call.t, state, par, out);
      values.forEach((value, i) => {
        if (value === null) return;  // not finite
        const off = Math.abs(out[i] - value);
        if (!(off <= bounds[i])) found.push(`state ${k}: ${name}[${i}] is ${out[i]}, not ${value}, off by ${off}`);
      });
    }
  });
  if (calls.length && scene.initial_state.length !== calls[0].state.length) found.push("no initial state");
  return found;
}
