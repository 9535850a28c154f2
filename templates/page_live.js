"use strict";
// The part of the page that lives: sliders for parameters and initial values, bodies that can be dragged to a new start, and the
// motion that follows, by the equations that alembert derived and the integrator beside this. alembertModules holds them.
//
//   const live = alembertLive(data, draw, { start, end, restart });
//   live.motion         // null while the page plays what alembert calculated; else what the figure draws: poses, paths, a ghost
//   live.until(t)       // as far as the motion is known by then, at most t
const alembertLive = (() => {
const SVG = "http://www.w3.org/2000/svg";
const TOLERANCE = 1e-9;
const PATIENCE = 12;  // ms of a picture for the integrator
const PATH = 300;  // points of a path over the whole time

// The positions of all points of the figure, as page_script.js takes them.
function poser(model, figure, data) {
  const { spots, zeroed, shifts } = data, n = data.coordinates, out = new Float64Array(3 * spots);
  const kinds = Array.from(new Set(zeroed)), there = new Float64Array(2 * n), acceleration = new Float64Array(2 * n);
  const dot = (p, v) => p[0] * v[0] + p[1] * v[1] + p[2] * v[2];
  return (t, q, rates, par) => {
    const points = new Array(figure.count);
    for (const kind of kinds) {
      for (let i = 0; i < n; ++i) {
        there[i] = i === kind ? 0 : q[i];
        there[n + i] = rates[i];
      }
      model.outputs_at(t, there, acceleration, par, out);
      for (let k = 0; k < spots; ++k) {
        if (zeroed[k] !== kind) continue;
        const p = [out[3 * k] + shifts[k][0], out[3 * k + 1] + shifts[k][1], out[3 * k + 2] + shifts[k][2]];
        points[k] = figure.plane ? [dot(p, figure.right), dot(p, figure.up)] : p;
      }
    }
    for (let k = spots; k < figure.count; ++k) points[k] = figure.plane ? [0, 0] : [0, 0, 0];
    return points;
  };
}

// x of the least size with B x = r, rows of the second kind only in the least squares; x is measured in `scale`.
function leastChange(rows, right, soft, scale) {
  const m = rows.length, n = scale.length, g = rows.map(() => new Float64Array(m + 1));
  const scaled = rows.map((row) => row.map((x, i) => x * scale[i]));
  for (let a = 0; a < m; ++a)
    for (let b = 0; b < m; ++b)
      for (let i = 0; i < n; ++i) g[a][b] += scaled[a][i] * scaled[b][i];
  let largest = 0;
  for (let a = 0; a < m; ++a) largest = Math.max(largest, g[a][a]);
  for (let a = 0; a < m; ++a) {
    g[a][a] += (a < m - soft ? 1e-12 : 1e-3) * (largest || 1);
    g[a][m] = right[a];
  }
  for (let c = 0; c < m; ++c) {  // g is positive definite
    for (let a = c + 1; a < m; ++a) {
      const factor = g[a][c] / g[c][c];
      for (let b = c; b <= m; ++b) g[a][b] -= factor * g[c][b];
    }
  }
  const y = new Float64Array(m);
  for (let a = m - 1; a >= 0; --a) {
    let sum = g[a][m];
    for (let b = a + 1; b < m; ++b) sum -= g[a][b] * y[b];
    y[a] = sum / g[a][a];
  }
  const x = new Float64Array(n);
  for (let i = 0; i < n; ++i) for (let a = 0; a < m; ++a) x[i] += scale[i] * scaled[a][i] * y[a];
  return x;
}

// States that obey the constraints, near those that are wished: what the scene gives as a guess moves first, number `held` not at
// all; null if there are none.
function assembler(scene, live) {
  const n = live.coordinates, s = live.speeds, c = live.holonomic.length, all = c + live.redundant, isOwn = live.own_speeds;
  const position = new Float64Array(all + 1), velocity = new Float64Array(all + 1), rows = new Float64Array(all * (n + s) + 1);
  const state = new Float64Array(n + s), holonomic = [];
  live.holonomic.forEach((is, k) => { if (is) holonomic.push(k); });
  const row = (k, begin, length) => Array.from(rows.subarray(begin + k * length, begin + (k + 1) * length));
  const weight = (i, held) => i === held ? 0 : live.guessed[i] ? 1 : 1e-4;

  function look(t, q, par) {
    if (!holonomic.length) return [];
    state.set(q.subarray(0, n));
    scene.constraints_at(t, state, par, position, velocity, rows);
    return holonomic.map((k) => ({ residual: position[k], row: row(k, 0, n) }));
  }

  function toVelocities(t, y, par, held) {
    const scale = Array.from({ length: s }, (_, i) => weight(n + i, held));
    for (let round = 0; c && round < 3; ++round) {
      scene.constraints_at(t, y, par, position, velocity, rows);
      const list = Array.from({ length: c }, (_, k) => row(k, isOwn ? all * n : 0, isOwn ? s : n));
      const change = leastChange(list, list.map((_, k) => -velocity[k]), 0, scale);
      for (let i = 0; i < s; ++i) y[n + i] += change[i];
    }
    return y.every(Number.isFinite) ? y : null;
  }

  function assemble(t, wished, par, held) {
    let former = Infinity;
    const y = Float64Array.from(wished), scale = live.scales.map((size, i) => size * weight(i, held));
    for (let round = 0; round < 30 && holonomic.length; ++round) {
      const list = look(t, y, par), worst = Math.max(...list.map((one) => Math.abs(one.residual)));
      if (!Number.isFinite(worst)) return null;
      if (worst < 1e-12 * live.length || (worst < 1e-9 * live.length && !(worst < former / 2))) break;
      former = worst;
      const change = leastChange(list.map((one) => one.row), list.map((one) => -one.residual), 0, scale);
      for (let i = 0; i < n; ++i) y[i] += change[i];
    }
    const worst = Math.max(0, ...look(t, y, par).map((one) => Math.abs(one.residual)));
    return worst < 1e-8 * live.length ? toVelocities(t, y, par, held) : null;
  }
  return { look, assemble };
}

return function alembertLive(data, draw, time) {
  const live = data.live, figure = data.figure, scene = alembertModules.scene;
  const n = live.coordinates, size = n + live.speeds, words = live.words;
  const model = { ...scene, size, constraints: live.holonomic.length, conserved: live.conserved };
  const pose = poser(alembertModules.figure, { ...figure, count: live.points }, live);
  const { look, assemble } = assembler(scene, live);
  const box = document.getElementById("live"), told = document.getElementById("live-told");
  const happening = document.getElementById("happening");
  const compare = document.getElementById("live-compare"), back = document.getElementById("live-back");
  const scenes = { par: Array.from(scene.parameter_values), state: live.state.slice() };
  let wish = { par: scenes.par.slice(), state: scenes.state.slice() }, current = null, ghost = null, held = -1;

  function parameters(values) {
    const par = scene.defaults();
    par.set(values);
    scene.prepare(par);
    return par;
  }

  // Where a step ends at the latest: the times at which inputs change fast are known for the scene's parameters until its end;
  // elsewhere every step is as short as there.
  function latestEndFor(par) {
    const { rows, least, follow } = live.quick;
    if (!rows.length) return () => Infinity;
    const isKnown = follow.every(([place, value]) => par[place] === value);
    return (t) => {
      if (!isKnown || t >= time.end) return t + least;
      let end = Math.max(time.end, t + least);
      for (const [from, to, enter, step] of rows) {
        if (from >= end) break;
        if (to > t) end = Math.min(end, t < from ? from + enter : t + step);
      }
      return end;
    };
  }

  // A motion of the state and the parameters that are wished: what is drawn of it, and what is told about it.
  function begun(values) {
    const par = parameters(values.par), latestEnd = latestEndFor(par);
    const options = { par, t: time.start, longest: (time.end - time.start) / 60, latestEnd };
    const state = assemble(time.start, values.state, par, held);
    if (!state) return null;
    const fine = alembertMotion(model, { ...options, state, tolerance: TOLERANCE });
    const rough = alembertMotion(model, { ...options, state, tolerance: 10 * TOLERANCE });
    const rate = new Float64Array(size), energy = new Float64Array(4), jacobi = new Float64Array(1), paths = [];
    const at = (t) => {
      const y = fine.state(t);
      scene.rhs(t, y, par, rate);
      const points = pose(t, y, rate, par), angles = {};
      for (const k of Object.keys(figure.angles)) angles[k] = y[k];
      return { points, angles, y };
    };
    const energyAt = (t) => {
      const y = fine.state(t);
      scene.rhs(t, y, par, rate);
      scene.energy(t, y, rate, par, energy, jacobi);
      return { value: energy[2], kinetic: energy[0], work: fine.work(t) };
    };
    const first = model.energy ? energyAt(time.start) : null;
    return {
      fine, rough, at,
      path(point, until) {
        const step = (time.end - time.start) / PATH;
        for (let k = paths.length; time.start + k * step <= until; ++k) paths.push(at(time.start + k * step).points);
        return paths.slice(0, Math.floor((until - time.start) / step) + 1).map((points) => points[point]);
      },
      error(t) {
        const a = fine.state(t), b = rough.state(Math.min(t, rough.reached));
        return a.reduce((worst, x, i) => Math.max(worst, Math.abs(x - b[i]) / Math.max(1, Math.abs(x))), 0);
      },
      energy(t) {
        if (!first) return null;
        const now = energyAt(t);
        const by = Math.max(Math.abs(first.value), Math.abs(now.value), first.kinetic, now.kinetic) || 1;
        return { value: now.value, drift: Math.abs(now.value - first.value - now.work) / by };
      },
      reach(t, deadline) {
        return Math.min(fine.reach(t, deadline), rough.reach(t, deadline));
      },
    };
  }

  const write = (node, text) => { if (node.textContent !== text) node.textContent = text; };
  const digits = (x, count) => Number.isFinite(x) ? Number(x.toPrecision(count)).toString() : "–";

  let toldAt = 0;
  function tell(t, isPlaying) {
    if (!current) return;
    if (isPlaying && performance.now() - toldAt < 150) return;
    toldAt = performance.now();
    const failure = current.fine.failure || current.rough.failure, parts = [];
    const energy = current.energy(t);
    if (energy) parts.push(`${words.energy} ${digits(energy.value, 5)}${live.unit}`, `${words.drift} ${digits(energy.drift, 2)}`);
    parts.push(`${words.error} ${digits(current.error(t), 2)}`);
    write(told, parts.join(" · "));
    write(happening, failure && t >= Math.min(current.fine.reached, current.rough.reached) - 1e-9 ? words[failure] : "");
  }

  // Sliders -----------------------------------------------------------------------------------------------------------
  const knobs = Array.from(box.querySelectorAll(".knob")).map((row) => {
    const [range, number] = row.querySelectorAll("input"), factor = Number(row.dataset.factor);
    const kind = row.dataset.kind, index = Number(row.dataset.index);
    const show = () => {
      const value = wish[kind][index] / factor;
      if (document.activeElement !== number) number.value = digits(value, 6);
      range.value = value;
    };
    const take = (input) => {
      const value = Number(input.value) * factor;
      if (input.value === "" || !Number.isFinite(value)) return;
      held = kind === "state" ? index : -1;
      change({ ...wish, [kind]: wish[kind].map((x, i) => i === index ? value : x) });
    };
    range.addEventListener("input", () => take(range));
    number.addEventListener("change", () => take(number));
    return { show };
  });

  // Takes these numbers if they give a motion; tells why not otherwise.
  function change(next) {
    const motion = begun(next);
    if (!motion || motion.fine.failure) {
      write(happening, motion ? words[motion.fine.failure] : words.apart);
      return;
    }
    wish = { par: next.par, state: Array.from(motion.fine.state(time.start)) };
    current = motion;
    box.classList.add("changed");
    knobs.forEach((knob) => knob.show());
    box.open = true;
    time.restart();
    tell(time.start);
  }

  back.addEventListener("click", () => {
    wish = { par: scenes.par.slice(), state: scenes.state.slice() };
    current = null;
    held = -1;
    box.classList.remove("changed");
    knobs.forEach((knob) => knob.show());
    write(told, "");
    write(happening, "");
    time.restart();
  });
  compare.addEventListener("change", () => {
    ghost = compare.checked ? current || begun(wish) : null;
    if (compare.checked && !current) change(wish);
    time.again();
  });

  // Dragging ----------------------------------------------------------------------------------------------------------
  // Moves the coordinates so that a point of the figure comes to a place on the screen: some steps of Gauss and Newton.
  function dragged(point, place) {
    const par = parameters(wish.par), t = time.start, none = new Float64Array(n);
    let q = Float64Array.from(wish.state.slice(0, n));
    const onScreen = (x) => draw.toScreen(pose(t, x, none, par), point);
    for (let round = 0; round < 4; ++round) {
      const here = onScreen(q), across = new Array(n), down = new Array(n);
      for (let i = 0; i < n; ++i) {
        const step = 1e-6 * live.scales[i], aside = Float64Array.from(q);
        aside[i] += step;
        const there = onScreen(aside);
        across[i] = (there[0] - here[0]) / step;
        down[i] = (there[1] - here[1]) / step;
      }
      const list = look(t, q, par);
      const away = [place[0] - here[0], place[1] - here[1]];
      if (!Number.isFinite(away[0] + away[1])) return null;
      // All rows in the same measure, so that neither constraints nor the pointer outweigh each other by their units.
      const measure = (row) => Math.hypot(...row.map((x, i) => x * live.scales[i])) || 1;
      const pointer = Math.max(measure(across), measure(down));
      const rows = list.map((one) => { const m = measure(one.row); return one.row.map((x) => x / m); });
      const right = list.map((one) => -one.residual / measure(one.row));
      rows.push(across.map((x) => x / pointer), down.map((x) => x / pointer));
      right.push(away[0] / pointer, away[1] / pointer);
      const change = leastChange(rows, right, 2, live.scales);
      const size = Math.max(...change.map((x, i) => Math.abs(x) / live.scales[i]));
      const part = Math.min(1, 0.5 / size);
      for (let i = 0; i < n; ++i) q[i] += part * change[i];
    }
    return assemble(t, [...q, ...wish.state.slice(n)], par, -1);
  }

  const quiet = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const handles = live.grabs.map((point) => {
    const handle = document.createElementNS(SVG, "circle");
    handle.setAttribute("class", "grab");
    handle.setAttribute("r", "16");
    draw.root.append(handle);
    let isHeld = false, runs = false;
    handle.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      event.stopPropagation();
      runs = time.pause();
      isHeld = true;
      held = -1;
      time.restart();
      draw.hold(pose(time.start, wish.state.slice(0, n), new Float64Array(n), parameters(wish.par)));
      handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener("pointermove", (event) => {
      if (!isHeld) return;
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(draw.root.getScreenCTM().inverse());
      const state = dragged(point, [at.x, at.y]);
      if (state) change({ ...wish, state: Array.from(state) });
    });
    for (const name of ["pointerup", "pointercancel"])
      handle.addEventListener(name, () => {
        if (!isHeld) return;
        isHeld = false;
        draw.hold(null);
        time.again();
        if (current && (runs || !quiet)) time.play();
      });
    return { point, handle };
  });

  window.alembert = {
    state: (t) => current && current.reach(t, Infinity) >= t ? Array.from(current.fine.state(t)) : null,
    error: (t) => current && current.error(t),
    energy: (t) => current && current.energy(t),
    steps: () => current ? current.fine.steps : 0,
  };

  return {
    get motion() {
      return current && { at: current.at, path: current.path, ghost: ghost && ((t) => ghost.at(Math.min(t, ghost.fine.reached))) };
    },
    until(t) {
      if (!current) return t;
      const deadline = performance.now() + PATIENCE;
      const reached = current.reach(t, deadline);
      if (ghost) ghost.reach(reached, deadline + PATIENCE);
      return reached;
    },
    failed: () => Boolean(current && (current.fine.failure || current.rough.failure)),
    tell,
    place(points) {
      for (const { point, handle } of handles) {
        const [x, y] = points(point);
        handle.setAttribute("cx", x.toFixed(1));
        handle.setAttribute("cy", y.toFixed(1));
      }
    },
  };
};
})();
