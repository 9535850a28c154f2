"use strict";
// The figure's other poses, the cursor of the plots, and the copy buttons. All positions and values were calculated by
// alembert, or are calculated by page_live.js; what is done here is drawing. The arithmetic of the figure is that of report/figure_screen.cpp.
(() => {
const SVG = "http://www.w3.org/2000/svg";
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

// All folds are open in print.
addEventListener("beforeprint", () => { for (const fold of document.querySelectorAll("details")) fold.open = true; });

// Copy buttons -------------------------------------------------------------------------------------------------------
function copied(text) {
  if (navigator.clipboard && window.isSecureContext) return navigator.clipboard.writeText(text);
  const area = document.createElement("textarea");
  area.value = text;
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  return done ? Promise.resolve() : Promise.reject(new Error("copying is not allowed here"));
}
for (const button of document.querySelectorAll("[data-copy]")) {
  const words = button.textContent;
  button.addEventListener("click", () => {
    copied(data.copies[Number(button.dataset.copy)]).then(() => data.words.copied, () => data.words.refused).then((answer) => {
      button.textContent = answer;
      setTimeout(() => { button.textContent = words; }, 1200);
    });
  });
}

// Where a time lies in a list of times: the row before it, and how far on to the next.
function position(times, t) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  const step = times[high] - times[low];
  return [low, high, step > 0 ? Math.min(1, Math.max(0, (t - times[low]) / step)) : 0];
}

// The figure ---------------------------------------------------------------------------------------------------------
const figure = data.figure;
const svg = document.querySelector(".stage svg.figure");
const draw = figure && svg ? figureDrawer(figure, svg) : null;

function figureDrawer(f, root) {
  const size = f.plane ? 2 : 3, unit = 1 / (16 * f.scale);
  const group = root.querySelector(".shapes");
  const nodes = Array.from(group.children);
  const traces = f.traced.slice(0, 12).map((point, k) => {
    const path = document.createElementNS(SVG, "path");
    path.setAttribute("class", "trace t" + (k % 5));
    group.before(path);
    return { point, path };
  });
  const flash = document.createElementNS(SVG, "circle");
  flash.setAttribute("class", "flash");
  flash.setAttribute("visibility", "hidden");
  group.after(flash);
  let motion = null, ghost = null, ghostNodes = [], held = null, zoom = 1;  // of page_live.js; null while what alembert calculated is played
  let view = { right: f.right, up: f.up, toward: f.toward };
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const direction = (v) => f.plane ? [v[0] * f.scale, -v[1] * f.scale]
                                   : [dot(v, view.right) * f.scale, -dot(v, view.up) * f.scale];
  const norm = (v) => Math.hypot(...v);
  const centre = f.plane ? [dot(f.centre, f.right), dot(f.centre, f.up)] : f.centre;

  function pose(low, high, part) {
    const a = f.frames[low], b = f.frames[high], count = a.length / size, points = new Array(count);
    for (let k = 0; k < count; ++k) {
      const p = [];
      for (let i = 0; i < size; ++i) p.push((a[k * size + i] * (1 - part) + b[k * size + i] * part) * unit);
      points[k] = p;
    }
    return points;
  }

  function camera(points) {
    if (held) return held;
    const origin = centre.slice();
    if (f.follows)
      for (const k of f.followed) for (let i = 0; i < size; ++i) origin[i] += points[k][i] / f.followed.length;
    return origin;
  }

  function screenOf(points, origin = camera(points)) {
    return (k) => {
      if (k < 0) return [f.width - 30, 24];
      const d = direction(points[k].map((x, i) => x - origin[i]));
      return [d[0] + f.width / 2, d[1] + f.height / 2];
    };
  }

  function arrow(shape, points) {
    const v = points[shape.vector], d = direction(v), whole = norm(v) * f.scale;
    if (!(whole > 0)) return [0, 0];
    const length = shape.full ? 14 + 46 * norm(v) / shape.full : 46;
    return [d[0] / whole * length, d[1] / whole * length];
  }

  function vertex(v, shape, place, points) {
    const a = place(v[0]);
    const way = v[1] < 0 ? [0, 0] : shape.vector === v[1] ? arrow(shape, points)
              : [place(v[1])[0] - a[0], place(v[1])[1] - a[1]];
    const length = Math.hypot(way[0], way[1]);
    const e = length > 1e-6 && v[1] >= 0 ? [way[0] / length, way[1] / length] : [1, 0];
    return [a[0] + v[2] * way[0] + v[3] * e[0] - v[4] * e[1], a[1] + v[2] * way[1] + v[3] * e[1] + v[4] * e[0]];
  }

  function arc(shape, place, angles) {
    const c = place(shape.v[0][0]), p = place(shape.v[1][0]), q = place(shape.v[2][0]);
    const from = [p[0] - c[0], p[1] - c[1]], to = [q[0] - c[0], q[1] - c[1]];
    const start = Math.atan2(from[1], from[0]);
    const sweep = shape.coordinate !== undefined ? shape.turn * (angles[shape.coordinate] % (2 * Math.PI))
      : Math.atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
    return [c, start, sweep];
  }

  const text = (p, begins) => (begins ? "M" : "L") + p[0].toFixed(1) + " " + p[1].toFixed(1);

  function path(shape, place, points, angles) {
    let d = "";
    if (shape.kind === "path" || shape.kind === "face") {
      for (const v of shape.v) d += text(vertex(v, shape, place, points), v[5] || d === "");
      return d + (shape.closed ? "Z" : "");
    }
    if (shape.kind === "hull") {
      const c = place(shape.v[0][0]);
      const ends = shape.v.slice(1).map((v) => place(v[0])).map((p) => [p[0] - c[0], p[1] - c[1]]);
      const sum = (i, j) => ends.reduce((total, p) => total + p[i] * p[j], i === j ? 1e-12 : 0);
      const a = Math.sqrt(sum(0, 0)), b = sum(0, 1) / a, h = Math.sqrt(Math.max(sum(1, 1) - b * b, 0));
      for (let k = 0; k < 48; ++k) {
        const x = Math.cos(2 * Math.PI * k / 48), y = Math.sin(2 * Math.PI * k / 48);
        d += text([c[0] + a * x, c[1] + b * x + h * y], k === 0);
      }
      return d + "Z";
    }
    if (shape.kind === "ring") {
      const c = place(shape.v[0][0]), u = place(shape.v[1][0]), w = place(shape.v[2][0]);
      for (let k = 0; k < 48; ++k) {
        const x = Math.cos(2 * Math.PI * k / 48), y = Math.sin(2 * Math.PI * k / 48);
        d += text([c[0] + x * (u[0] - c[0]) + y * (w[0] - c[0]), c[1] + x * (u[1] - c[1]) + y * (w[1] - c[1])], k === 0);
      }
      return d + "Z";
    }
    const [c, start, sweep] = arc(shape, place, angles);
    for (let k = 0; k <= 20; ++k) {
      const angle = start + sweep * k / 20;
      d += text([c[0] + shape.size * Math.cos(angle), c[1] + shape.size * Math.sin(angle)], k === 0);
    }
    return d;
  }

  function depths(points) {
    const order = f.shapes.map((shape, k) => {
      let sum = 0, count = 0;
      for (const v of shape.v) for (const point of [v[0], v[1]]) {
        if (point < 0 || point === shape.vector) continue;
        sum += dot(points[point], view.toward);
        ++count;
      }
      return { k, depth: count ? sum / count : 0 };
    });
    order.sort((a, b) => Math.abs(a.depth - b.depth) > 1e-9 ? a.depth - b.depth : a.k - b.k);
    order.forEach(({ k }) => group.append(nodes[k]));
  }

  // How much light a face returns; 0 if it is turned away. The same as brightness in report/figure_screen.cpp.
  function brightness(shape, points) {
    const [a, b, c] = [0, 1, 2].map((k) => points[shape.v[k][0]]);
    const p = b.map((x, i) => x - a[i]), q = c.map((x, i) => x - a[i]);
    const n = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]], length = norm(n);
    if (!(length > 0) || !(dot(n, view.toward) > 0)) return 0;
    const light = view.toward.map((x, i) => 0.75 * x + 0.6 * view.up[i] - 0.28 * view.right[i]);
    return 0.55 + 0.45 * Math.max(0, dot(n, light) / length / norm(light));
  }

  function recorded(t) {
    const [low, high, part] = position(f.times, t), angles = {};
    for (const k of Object.keys(f.angles)) angles[k] = f.angles[k][low] * (1 - part) + f.angles[k][high] * part;
    const path = (point) => f.frames.slice(0, low + 1).map((frame) => frame.slice(point * size, point * size + size).map((x) => x * unit));
    return { points: pose(low, high, part), angles, path };
  }

  // Makes room where a motion that was changed leaves the picture; the room stays until the figure is played again.
  function makeRoom(points, place) {
    for (const k of f.traced) {
      const [x, y] = place(k);
      zoom = Math.min(8, Math.max(zoom, Math.abs(x - f.width / 2) / (f.width / 2 - 46), Math.abs(y - f.height / 2) / (f.height / 2 - 46)));
    }
    const w = f.width * zoom, h = f.height * zoom;
    root.setAttribute("viewBox", [(f.width - w) / 2, (f.height - h) / 2, w, h].map((x) => x.toFixed(1)).join(" "));
  }

  function showGhost(at, origin) {
    if (!at && ghost) ghost = void ghost.remove();
    if (!at) return;
    if (!ghost) {
      const order = Array.from(group.children);
      ghost = group.cloneNode(true);
      ghost.setAttribute("class", "shapes ghost");
      ghostNodes = nodes.map((node) => ghost.children[order.indexOf(node)]);
      group.before(ghost);
    }
    showShapes(ghostNodes, at.points, at.angles, screenOf(at.points, origin));
  }

  function showShapes(nodes, points, angles, place) {
    f.shapes.forEach((shape, n) => {
      const node = nodes[n];
      let hidden = false;
      if (shape.vector !== undefined) {
        const v = points[shape.vector];
        hidden = !(norm(v) > 1e-3 * (shape.full || 0) && norm(v) > 0);
      }
      if (shape.inside) {
        const room = shape.inside;
        hidden = hidden || shape.v.some((v) => {
          const p = vertex(v, shape, place, points);
          return !(p[0] > room && p[0] < f.width - room && p[1] > room && p[1] < f.height - room);
        });
      }
      if (shape.from !== undefined) {
        const a = place(shape.from), b = place(shape.to), length = Math.hypot(a[0] - b[0], a[1] - b[1]);
        hidden = hidden || length < shape.least || (shape.most > 0 && length >= shape.most);
      }
      if (shape.kind === "face") {
        const light = brightness(shape, points), grey = Math.round(245 * light);
        hidden = hidden || light === 0;
        node.style.fill = `rgb(${grey},${grey},${grey})`;
        if (node.classList.contains("facet")) node.style.stroke = node.style.fill;
      }
      node.setAttribute("visibility", hidden ? "hidden" : "visible");
      if (shape.kind === "circle") {
        const c = vertex(shape.v[0], shape, place, points);
        node.setAttribute("cx", c[0].toFixed(1));
        node.setAttribute("cy", c[1].toFixed(1));
      } else if (shape.kind === "text") {
        const p = vertex(shape.v[0], shape, place, points), [right, down] = shape.nudge || [0, 0];
        node.setAttribute("x", (p[0] + right).toFixed(1));
        node.setAttribute("y", (p[1] + down + 5).toFixed(1));
      } else if (shape.kind === "angle_text") {
        const [c, start, sweep] = arc(shape, place, angles), r = shape.size + 11, [right, down] = shape.nudge || [0, 0];
        const at = Math.abs(sweep) >= 0.5 ? start + sweep / 2 : start + sweep + (sweep < -1e-6 ? -0.32 : 0.32);
        node.setAttribute("x", (c[0] + right + r * Math.cos(at)).toFixed(1));
        node.setAttribute("y", (c[1] + down + r * Math.sin(at) + 5).toFixed(1));
      } else {
        node.setAttribute("d", path(shape, place, points, angles));
      }
    });
  }

  function show(t, withTrace) {
    const at = motion ? motion.at(t) : recorded(t), points = at.points, origin = camera(points), place = screenOf(points);
    if (motion) makeRoom(points, place);
    showGhost(motion && motion.ghost && motion.ghost(t), origin);
    showShapes(nodes, points, at.angles, place);
    if (!f.plane) depths(points);
    for (const trace of traces) {
      let d = "";
      if (withTrace) {
        for (const p of motion ? motion.path(trace.point, t) : at.path(trace.point)) {
          const there = direction(p.map((x, i) => x - origin[i]));
          d += text([there[0] + f.width / 2, there[1] + f.height / 2], d === "");
        }
        d += text(place(trace.point), d === "");
      }
      trace.path.setAttribute("d", d);
    }
    return place;
  }

  function follow(next) {
    motion = next;
    if (motion) return;
    zoom = 1;
    root.setAttribute("viewBox", [0, 0, f.width, f.height].join(" "));
  }

  function turn(azimuth, elevation) {  // by these angles from the view of the start
    const rotate = (v, axis, angle) => {
      const c = Math.cos(angle), s = Math.sin(angle), along = dot(axis, v) * (1 - c);
      const cross = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]];
      return v.map((x, i) => x * c + cross[i] * s + axis[i] * along);
    };
    const up = f.up.map((x, i) => x * Math.cos(0.35) + f.toward[i] * Math.sin(0.35));  // the vertical
    let right = rotate(f.right, up, azimuth), toward = rotate(f.toward, up, azimuth), top = rotate(f.up, up, azimuth);
    top = rotate(top, right, elevation);
    toward = rotate(toward, right, elevation);
    view = { right, up: top, toward };
  }

  return { show, turn, flash, follow, root, hold: (points) => { held = null; held = points && camera(points); }, toScreen: (points, k) => screenOf(points)(k) };
}

// Time ---------------------------------------------------------------------------------------------------------------
const times = data.times || (figure ? figure.times : [0]);
const start = times[0], end = times[times.length - 1];
const play = byId("play"), slider = byId("time"), speed = byId("speed"), trace = byId("trace"), clock = byId("clock");
let now = start, playing = false, last = 0, sought = start;
const plots = Array.from(document.querySelectorAll(".plot > svg[data-columns]")).map(plotCursor);
const outputs = Array.from(document.querySelectorAll("output[data-column]"));

function value(column, low, high, part) {
  const list = data.values[column], a = list[low], b = list[high];
  return a === null || b === null ? NaN : a * (1 - part) + b * part;
}

function plotCursor(root) {
  const [x0, x1] = root.dataset.x.split(",").map(Number), [y0, y1] = root.dataset.y.split(",").map(Number);
  const columns = root.dataset.columns.split(",").map(Number), xColumn = Number(root.dataset.xColumn);
  const toX = (v) => 70 + (v - x0) / (x1 - x0) * 328, toY = (v) => 210 - (v - y0) / (y1 - y0) * 198;
  const line = document.createElementNS(SVG, "path");
  line.setAttribute("class", "cursor");
  if (xColumn < 0) root.append(line);
  const spots = columns.map((_, k) => {
    const spot = document.createElementNS(SVG, "circle");
    spot.setAttribute("class", "spot");
    spot.setAttribute("r", "3.2");
    spot.style.fill = "var(--c" + (k % 7) + ")";
    root.append(spot);
    return spot;
  });
  if (xColumn < 0) {
    const seek = (event) => {
      const box = root.getBoundingClientRect();
      const x = (event.clientX - box.left) / box.width * 420;
      setTime(x0 + (x - 70) / 328 * (x1 - x0));
    };
    root.addEventListener("pointerdown", (event) => { seek(event); root.setPointerCapture(event.pointerId); });
    root.addEventListener("pointermove", (event) => { if (event.buttons) seek(event); });
  }
  return (low, high, part) => {
    const t = times[low] * (1 - part) + times[high] * part;
    line.setAttribute("d", "M" + toX(t).toFixed(1) + " 12V210");
    spots.forEach((spot, k) => {
      const y = value(columns[k], low, high, part), x = xColumn < 0 ? t : value(xColumn, low, high, part);
      const there = Number.isFinite(x) && Number.isFinite(y);
      spot.setAttribute("visibility", there ? "visible" : "hidden");
      if (!there) return;
      spot.setAttribute("cx", toX(x).toFixed(1));
      spot.setAttribute("cy", toY(y).toFixed(1));
    });
  };
}

function flashAt(place) {
  if (!data.happenings || !draw || (live && live.motion)) return;
  const lasts = 0.25 * Number(speed ? speed.value : 1);  // a quarter of a second to look at
  const here = data.happenings.filter((h) => h.t <= now && now < h.t + lasts);
  const status = byId("happening");
  const words = here.map((h) => h.text + " at t = " + h.t.toPrecision(5)).slice(0, 3).join("; ");
  if (status.textContent !== words) status.textContent = words;
  const at = here.find((h) => h.point >= 0);
  draw.flash.setAttribute("visibility", at ? "visible" : "hidden");
  if (!at) return;
  const p = place(at.point);
  draw.flash.setAttribute("cx", p[0]);
  draw.flash.setAttribute("cy", p[1]);
  draw.flash.setAttribute("r", (10 + 40 * (now - at.t) / lasts).toFixed(1));
}

function setTime(t) {
  now = Math.min(end, Math.max(start, t));
  if (live) {
    const wanted = sought = now;
    now = live.until(wanted);
    draw.follow(live.motion);
    live.tell(now, playing);
    if (now < wanted && !playing && !live.failed()) requestAnimationFrame(() => { if (sought === wanted && !playing) setTime(wanted); });
  }
  if (data.values) {
    const at = position(times, now);
    for (const plot of plots) plot(...at);
    for (const output of outputs) {
      const v = value(Number(output.dataset.column), ...at);
      output.textContent = Number.isFinite(v) ? v.toPrecision(4) : "";
    }
  }
  if (slider) slider.value = end > start ? 1000 * (now - start) / (end - start) : 0;
  if (clock) clock.textContent = "t = " + now.toPrecision(4);
  if (!draw) return;
  const place = draw.show(now, trace && trace.checked);
  flashAt(place);
  if (live) live.place(place);
}

function frame(at) {
  if (!playing) return;
  const next = now + (at - last) / 1000 * Number(speed.value);
  last = at;
  setTime(next > end ? start : next);
  if (live && live.failed() && now < next) setPlaying(false);
  requestAnimationFrame(frame);
}

function setPlaying(value) {
  playing = value;
  play.textContent = playing ? data.words.pause : data.words.play;
  play.setAttribute("aria-pressed", String(playing));
  if (playing) requestAnimationFrame((at) => { last = at; requestAnimationFrame(frame); });
}

const live = play && draw && data.live ? alembertLive(data, draw, {
  start, end,
  restart: () => setTime(start),
  again: () => setTime(now),
  play: () => { if (!playing) setPlaying(true); },
  pause: () => { const was = playing; if (was) setPlaying(false); return was; },
}) : null;

if (play) {
  play.addEventListener("click", () => {
    if (!playing && live && live.failed()) setTime(start);
    setPlaying(!playing);
  });
  slider.addEventListener("input", () => setTime(start + slider.value / 1000 * (end - start)));
  if (trace) trace.addEventListener("change", () => setTime(now));
}

// The view of a figure in space --------------------------------------------------------------------------------------
const stage = document.querySelector(".space");
if (stage && draw) {
  let azimuth = 0, elevation = 0, drag = null;
  const turn = (a, e) => {
    azimuth = a;
    elevation = Math.min(1.2, Math.max(-1.9, e));
    draw.turn(azimuth, elevation);
    setTime(now);
  };
  stage.addEventListener("pointerdown", (event) => {
    drag = [event.clientX, event.clientY, azimuth, elevation];
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener("pointermove", (event) => {
    if (drag) turn(drag[2] - (event.clientX - drag[0]) / 120, drag[3] - (event.clientY - drag[1]) / 120);
  });
  for (const name of ["pointerup", "pointercancel"]) stage.addEventListener(name, () => { drag = null; });
  stage.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (!step) return;
    event.preventDefault();
    turn(azimuth + step[0], elevation + step[1]);
  });
  const back = byId("view");
  if (back) back.addEventListener("click", () => turn(0, 0));
}

setTime(start);
})();
