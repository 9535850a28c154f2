"use strict";
// A motion in the page, integrated as far as somebody looks: y' = f(t, y) by the pair of Dormand and Prince, orders 5 and 4, with
// its dense output and a PI controller (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.4-II.6). After each
// step Newton's method brings the state back to the constraints, as `alembert simulate` does.
//
//   const motion = alembertMotion(model, { par, t, state, tolerance, longest, latestEnd });
//   motion.reach(2, deadline)      // the time that has been reached; it ends early at the deadline of performance.now()
//   motion.state(2)                // coordinates, then speeds
//   motion.work(2)                 // of loads and prescribed motions since the start
//
// latestEnd(t): where a step from t ends at the latest, so that none passes over a pulse in time.
// model: the functions of an emitted module, with `size` (of the state), `constraints` and `conserved`.
const alembertMotion = (() => {
const C = [0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1];
const A = [[], [1 / 5], [3 / 40, 9 / 40], [44 / 45, -56 / 15, 32 / 9],
  [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729], [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656]];
const B = [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84];
const ERROR = [71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40];
const DENSE = [-12715105075 / 11282082432, 0, 87487479700 / 32700410799, -10690763975 / 1880347072,
  701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423];
const MOST_NUMBERS = 6e6;  // that are kept, 48 MB

// Holds a state to the constraints: Newton's method with the step that the module gives. Where what it divides by becomes small
// against the largest so far, the constraints nearly depend on each other.
function constraintKeeper(model) {
  const { size, constraints } = model;
  const next = new Float64Array(size), position = new Float64Array(constraints + 1);
  const pivots = new Float64Array(2 * constraints + 1), largest = new Float64Array(2 * constraints + 1);
  return (t, y, par) => {
    let former = Infinity;
    for (let round = 0; round < 8; ++round) {
      let worst = 0, moves = false, isLarge = false;
      model.project(t, y, par, next, position, pivots);
      for (let k = 0; k < constraints; ++k) worst = Math.max(worst, Math.abs(position[k]));
      for (let k = 0; k < pivots.length; ++k) {
        const of = Math.abs(pivots[k]);
        if (of > largest[k]) largest[k] = of;
        if (of !== 0 && !(of > 1e-5 * largest[k])) return "dependent";
      }
      for (let i = 0; i < size; ++i) {
        if (!Number.isFinite(next[i])) return "dependent";
        const change = Math.abs(next[i] - y[i]), scale = Math.max(1, Math.abs(y[i]));
        if (change > 1.1e-16 * scale) moves = true;
        if (change >= 1e-8 * scale) isLarge = true;
      }
      if (!moves || (!(worst < former / 2) && worst > 0)) break;
      former = worst;
      for (let i = 0; i < size; ++i) y[i] = next[i];
      if (!isLarge) break;
    }
    return "";
  };
}

return function alembertMotion(model, { par, t: start, state, tolerance, longest, latestEnd }) {
  const size = model.size, all = size + 1;  // the last is the work
  const keep = model.project && model.constraints ? constraintKeeper(model) : null;
  const energy = new Float64Array(4), jacobi = new Float64Array(1);
  const k = [0, 1, 2, 3, 4, 5, 6].map(() => new Float64Array(all));
  const y = new Float64Array(all), stage = new Float64Array(all), after = new Float64Array(all);
  const times = [start], steps = [];  // steps[i]: the five coefficients of each component between times[i] and times[i + 1]
  const follows = !model.conserved && model.energy;
  let t = start, h = 0, errorBefore = 1e-4, failure = "", evaluations = 0;

  function rates(at, from, to) {
    ++evaluations;
    model.rhs(at, from, par, to);
    to[size] = 0;
    if (!follows) return;
    model.energy(at, from, to, par, energy, jacobi);
    to[size] = energy[3];
  }
  const isFinite = (list) => { for (let i = 0; i < all; ++i) if (!Number.isFinite(list[i])) return false; return true; };
  const scaleOf = (a, b) => tolerance * (1e-3 + Math.max(Math.abs(a), Math.abs(b)));

  y.set(state);
  if (keep) failure = keep(t, y, par);
  const first = y.slice(0, size);
  rates(t, y, k[0]);
  if (!failure && !isFinite(k[0])) failure = "infinite";
  {  // the first step, from the sizes of state and rates
    let d0 = 0, d1 = 0;
    for (let i = 0; i < size; ++i) {
      const scale = scaleOf(y[i], y[i]);
      d0 += (y[i] / scale) ** 2;
      d1 += (k[0][i] / scale) ** 2;
    }
    h = Math.min(0.05 * longest, Math.max(1e-6 * longest, d1 > 0 ? 0.01 * Math.sqrt(d0 / d1) : 0));
  }

  // One step, perhaps rejected.
  function step() {
    if (steps.length * 5 * all > MOST_NUMBERS) { failure = "long"; return; }
    if (!(h > Math.max(1e-10 * longest, 1e-14 * Math.abs(t)))) { failure = "small"; return; }
    const latest = latestEnd(t), isHeld = t + h > latest, wish = h;
    if (isHeld) h = latest - t;
    for (let s = 1; s < 6; ++s) {
      for (let i = 0; i < all; ++i) {
        let sum = 0;
        for (let j = 0; j < s; ++j) sum += A[s][j] * k[j][i];
        stage[i] = y[i] + h * sum;
      }
      rates(t + C[s] * h, stage, k[s]);
    }
    for (let i = 0; i < all; ++i) {
      let sum = 0;
      for (let j = 0; j < 6; ++j) sum += B[j] * k[j][i];
      after[i] = y[i] + h * sum;
    }
    rates(t + h, after, k[6]);
    let error = 0;
    for (let i = 0; i < size; ++i) {
      let sum = 0;
      for (let j = 0; j < 7; ++j) sum += ERROR[j] * k[j][i];
      error += (h * sum / scaleOf(y[i], after[i])) ** 2;
    }
    error = Math.sqrt(error / size);
    if (!(error <= 1)) {  // also where it is no number
      h *= Number.isFinite(error) ? Math.max(0.2, 0.9 * error ** -0.17) : 0.1;
      return;
    }
    const kept = new Float64Array(5 * all);
    for (let i = 0; i < all; ++i) {
      const difference = after[i] - y[i], bow = h * k[0][i] - difference;
      let sum = 0;
      for (let j = 0; j < 7; ++j) sum += DENSE[j] * k[j][i];
      kept[5 * i] = y[i];
      kept[5 * i + 1] = difference;
      kept[5 * i + 2] = bow;
      kept[5 * i + 3] = difference - h * k[6][i] - bow;
      kept[5 * i + 4] = h * sum;
    }
    if (keep) {
      failure = keep(t + h, after, par);
      if (failure) return;
      rates(t + h, after, k[6]);
      if (!isFinite(k[6])) { failure = "infinite"; return; }
    }
    t = isHeld ? latest : t + h;
    times.push(t);
    steps.push(kept);
    y.set(after);
    k[0].set(k[6]);
    error = Math.max(error, 1e-10);
    h = isHeld ? wish : Math.min(longest, h * Math.min(5, Math.max(0.2, 0.9 * error ** -0.17 * errorBefore ** 0.04)));
    errorBefore = Math.max(error, 1e-4);
  }

  function reach(until, deadline) {
    for (let n = 0; t < until && !failure; ++n) {
      if (n % 8 === 7 && performance.now() > deadline) break;
      step();
    }
    return Math.min(t, until);
  }

  function component(at, i) {
    if (!steps.length) return i === size ? 0 : first[i];
    let low = 0, high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= at) low = middle; else high = middle;
    }
    const c = steps[low], part = (Math.min(at, t) - times[low]) / (times[high] - times[low]), rest = 1 - part, j = 5 * i;
    return c[j] + part * (c[j + 1] + rest * (c[j + 2] + part * (c[j + 3] + rest * c[j + 4])));
  }

  return {
    reach,
    start,
    par,
    state: (at) => { const list = new Float64Array(size); for (let i = 0; i < size; ++i) list[i] = component(at, i); return list; },
    work: (at) => component(at, size),
    get reached() { return t; },
    get failure() { return failure; },
    get evaluations() { return evaluations; },
    get steps() { return steps.length; },
  };
};
})();
