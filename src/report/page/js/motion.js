// Runs as they are drawn, the state of the page (time, playing, what is in view), and the clock.

/** A run with its columns decoded, and both sides of every impact put into its curves. */
function readRun(run) {
  const kept = decode(run.kept);
  const count = kept ? kept.length : run.rows;
  const spacing = run.rows > 1 ? run.end / (run.rows - 1) : 0;
  const time = new Float64Array(count);
  for (let i = 0; i < count; i++) time[i] = (kept ? kept[i] : i) * spacing;
  if (count) time[count - 1] = run.end;
  const contacts = { count: run.contacts.count };
  for (const key of ["start", "end", "impulse", "peak", "approach", "departure"]) {
    contacts[key] = decode(run.contacts[key]);
  }
  const numberOf = new Map(meetingPlaces().map((name, i) => [name, i]));
  contacts.wall = decode(run.contacts.wall).map((name) => numberOf.get(name));
  contacts.largest = contacts.impulse.reduce((most, p) => Math.max(most, Math.abs(p)), 0) || 1;
  const probes = run.probes.map((probe) => readProbe(probe, time, contacts));
  const forces = run.forces.map((f) => ({ place: f.place, T: decode(f.time), F: decode(f.force) }));
  const shape = run.shape && readShape(run.shape);
  const named = Object.entries(run.bodies || {});
  const bodies = Object.fromEntries(named.map(([name, own]) => [name, readShape(own)]));
  return { ...run, time, contacts, probes, forces, shape, bodies, shown: !run.hidden };
}

/** Names of the places that contacts belong to: the walls, then the round supports. */
function meetingPlaces() {
  const round = (DATA.scene.supports || []).filter((support) => support.round);
  return [...DATA.scene.walls, ...round].map((place) => place.name);
}

/** False for a slider, which rubs and bounds nothing; they come after all walls. */
const stands = (wall) => wall.position !== null;

const samePlace = (a, b) => JSON.stringify(a ?? null) === JSON.stringify(b ?? null);

/**
 * A watched place: times T, displacements Q, velocities V. Rows are evenly spaced and skip the
 * instants of impacts; with both sides of each impact put in, a bounce is a corner at the wall in
 * time and upright in the phase plane, at any zoom.
 */
function readProbe(probe, time, contacts) {
  const alone = DATA.scene.kind === "oscillator" && DATA.scene.planes !== 2;
  const walls = DATA.scene.walls
    .map((_, i) => i)
    .filter((i) => stands(DATA.scene.walls[i]))
    .filter((i) => alone || samePlace(DATA.scene.walls[i].at, probe.at));
  const here = new Set(walls);
  const impacts = [];
  for (let k = 0; k < contacts.count; k++) {
    const bounced = Number.isNaN(contacts.peak[k]) && !Number.isNaN(contacts.departure[k]);
    if (bounced && here.has(contacts.wall[k])) impacts.push(k);
  }
  const [q, v] = [decode(probe.q), decode(probe.v)];
  const length = time.length + 2 * impacts.length;
  const [T, Q, V] = [new Float64Array(length), new Float32Array(length), new Float32Array(length)];
  let next = 0;
  let j = 0;
  for (let i = 0; i < time.length; i++) {
    for (; next < impacts.length && contacts.start[impacts[next]] <= time[i]; next++, j += 2) {
      const k = impacts[next];
      const wall = DATA.scene.walls[contacts.wall[k]];
      const sign = wall.side === "upper" ? 1 : -1;
      T[j] = T[j + 1] = contacts.start[k];
      Q[j] = Q[j + 1] = wall.position;
      V[j] = sign * contacts.approach[k];
      V[j + 1] = -sign * contacts.departure[k];
    }
    [T[j], Q[j], V[j]] = [time[i], q[i], v[i]];
    j++;
  }
  const extents = { Q: extent(Q) || [0, 0], V: extent(V) || [0, 0] };
  return { name: probe.name, at: probe.at, walls, extents, T, Q, V };
}

/** The shape of a structure: displacement u[(row * planes + plane) * stations + station]. */
function readShape(shape) {
  return {
    stations: shape.stations,
    planes: shape.planes,
    T: decode(shape.time),
    u: decode(shape.u),
    unit: shape.u.unit,
  };
}

/** Displacement and velocity between rows: the cubic through both, with the velocities of both. */
function stateAt(probe, t) {
  const { T, Q, V } = probe;
  const i = clamp(before(T, t), 0, T.length - 2);
  if (T.length < 2) return [Q[0], V[0]];
  const h = T[i + 1] - T[i];
  if (h <= 0) return [Q[i + 1], V[i + 1]];
  const s = clamp((t - T[i]) / h, 0, 1);
  const q = cubic(Q[i], Q[i + 1], h * V[i], h * V[i + 1], s);
  return [q, V[i] + s * (V[i + 1] - V[i])];
}

/** The displacement of every station in a plane at a time, between rows linearly. */
function shapeAt(shape, plane, t, out) {
  const n = shape.stations.length;
  const [row, first] = [shape.planes * n, plane * n];
  const last = shape.T.length - 1;
  const i = clamp(before(shape.T, t), 0, Math.max(0, last - 1));
  const j = Math.min(i + 1, last);
  const span = shape.T[j] - shape.T[i];
  const s = span > 0 ? clamp((t - shape.T[i]) / span, 0, 1) : 0;
  for (let k = 0; k < n; k++) {
    const [a, b] = [shape.u[i * row + first + k], shape.u[j * row + first + k]];
    out[k] = shape.unit * (a + s * (b - a));
  }
  return out;
}

/** A load's force at a time, N; impulses and tables have none that can be drawn. */
function forceOf(load, t) {
  if (load.harmonic) {
    const { amplitude, frequency, phase } = load.harmonic;
    return amplitude * Math.sin(TURN * frequency * t + phase);
  }
  return load.constant ? load.constant.force : 0;
}

const largestForce = (loads) =>
  loads.reduce(
    (most, load) =>
      Math.max(
        most,
        Math.abs(load.harmonic ? load.harmonic.amplitude : load.constant ? load.constant.force : 0),
      ),
    0,
  );

const isElastic = (wall) => wall.restitution === null || wall.restitution === undefined;

const runs = (DATA.runs || []).map(readRun);
const plain = runs.filter((run) => !run.reference);
runs.forEach((run) => {
  run.look = lookOf(plain.indexOf(run), run.reference);
});
/** The run that the drawing and single readings are about. */
const lead = plain.find((run) => run.shown) || runs[0];
const period = DATA.period;
const duration = DATA.duration;
const view = lead ? new View(0, duration) : null;

/**
 * The instant shown, and the instant under the pointer, which takes its place while it is there;
 * whether the reader has chosen the former.
 */
const state = { time: 0, hover: null, chosen: false, playing: false, speed: 1 };
const now = () => (state.hover !== null && !state.playing ? state.hover : state.time);

/** Called when the instant or what is shown of the runs changes. */
const tellers = [];
const toggled = [];

/** Shows the instant t, and brings it into view. */
function seek(t) {
  state.time = clamp(t, 0, duration);
  state.chosen = true;
  const width = view.hi - view.lo;
  if (state.time < view.lo || state.time > view.hi)
    view.set(state.time - 0.25 * width, state.time + 0.75 * width);
  tellers.forEach((tell) => tell());
  refresh();
}

/** A stretch in which single oscillations can be told apart. */
const glance = () => (period ? 2.5 * period : duration / 20);
