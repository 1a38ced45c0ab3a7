// Branches of periodic orbits over a key: their points, and what is drawn of them over the key.

/** Markers of special points, those of the SVG picture. */
const SPECIAL_MARKERS = {
  fold: "triangle",
  "period-doubling": "open-diamond",
  "symmetry-breaking": "ring",
  "neimark-sacker": "disc",
  "grazing-in": "cross",
  "grazing-out": "plus",
};
const specialMarker = (label) => SPECIAL_MARKERS[label] || "open-square";

/** How the orbits of a stretch are drawn, as in the SVG picture. */
const BRANCH_LOOKS = {
  stable: { colour: () => ink.c1, dash: [], width: 2 },
  unstable: { colour: () => ink.c2, dash: [6, 3], width: 1.5 },
  "passes a wall": { colour: () => ink.faint, dash: [1.4, 2.4], width: 1.2 },
};

/** True for an event whose speed is one towards the wall. */
const isApproach = ({ kind }) => DATA.continue.approaches.includes(kind);

/** The points of the branches, as the page needs them. */
function readBranches(data) {
  const table = tableOf(data.points);
  const { columns, count } = table;
  const [phases, speeds] = [decode(data.events.phases), decode(data.events.speeds)];
  const first = new Uint32Array(count + 1);
  const branchAt = (i) => data.branches[columns.branch[i] - 1] || { events: [] };
  for (let i = 0; i < count; i++) first[i + 1] = first[i] + branchAt(i).events.length;
  const label = (i) => (Array.isArray(columns.label) ? columns.label[i] : "");
  const speedsOf = (i) => {
    const { events } = branchAt(i);
    return Array.from(speeds.subarray(first[i], first[i + 1])).filter((_, k) =>
      isApproach(events[k]),
    );
  };
  const top = speeds.reduce((most, v) => Math.max(most, Math.abs(v)), 0);
  const state = (i) => {
    // At a graze the speed is 0 to rounding.
    if (speedsOf(i).some((v) => v < -1e-6 * top)) return "passes a wall";
    return columns.stable[i] ? "stable" : "unstable";
  };
  const orbits = data.orbits && {
    row: decode(data.orbits.row),
    first: decode(data.orbits.first),
    phase: decode(data.orbits.phase),
    q: decode(data.orbits.q),
    v: decode(data.orbits.v),
  };
  return {
    ...table,
    value: columns[data.key],
    first,
    phases,
    speeds,
    branchAt,
    label,
    speedsOf,
    state,
    orbits,
    rowsOf: (number) => table.rows.filter((i) => columns.branch[i] === number),
    multipliers: (i) => multipliersOf(columns, i),
  };
}

/** The multipliers of row i: those that the table has, the largest ones of a structure. */
function multipliersOf(columns, i) {
  const list = [];
  for (let k = 1; columns[`multiplier_${k}_re`]; k++)
    list.push([columns[`multiplier_${k}_re`][i], columns[`multiplier_${k}_im`][i]]);
  return list;
}

/** What can be drawn over the key: [name, label, values of a row, options]. */
function branchMeasures(points) {
  const { columns } = points;
  const cycle = (x) => x - Math.floor(x);
  const phasesOf = (i) => {
    const { events } = points.branchAt(i);
    const own = Array.from(points.phases.subarray(points.first[i], points.first[i + 1]), cycle);
    return own.filter((_, k) => isApproach(events[k]));
  };
  const column = (name) => (i) => [columns[name][i]];
  return [
    {
      name: "speed",
      text: "Approach speed of every impact (m/s)",
      // A motion that meets no wall has the speed 0.
      of: (i) => (points.branchAt(i).events.length ? points.speedsOf(i) : [0]),
      floor: 0,
    },
    { name: "phase", text: "Phase of every impact (cycles)", of: phasesOf, wraps: true },
    {
      name: "multiplier",
      text: "Largest |multiplier|",
      of: (i) => [largestModulus(points.multipliers(i))],
      log: true,
    },
    { name: "displacement", text: "Largest |displacement| (m)", of: column("displacement_max_m") },
    { name: "gap", text: "Least gap to a wall not met (m)", of: column("least_gap_m") },
    { name: "period", text: "Period (s)", of: column("period_s") },
  ].filter((measure) => {
    for (let i = 0; i < points.count; i++) if (measure.of(i).some(Number.isFinite)) return true;
    return false;
  });
}

/** The curves of a measure: runs of points of one branch, one event and one look, and all points. */
function branchCurves(points, measure) {
  const [lines, all] = [[], []];
  const open = new Map();
  const goesOn = (i) => points.columns.branch[i + 1] === points.columns.branch[i];
  for (let i = 0; i < points.count; i++) {
    // At a special point orbits change: it is where those after it begin.
    const state = points.state(points.label(i) && goesOn(i) ? i + 1 : i);
    const values = measure.of(i);
    const fresh = !i || points.columns.branch[i] !== points.columns.branch[i - 1];
    if (fresh) open.clear();
    values.forEach((y, k) => {
      all.push({ x: points.value[i], y, i });
      const run = open.get(k);
      const jumps = run && measure.wraps && Math.abs(run.y[run.y.length - 1] - y) > 0.5;
      if (run && !jumps) {
        run.x.push(points.value[i]);
        run.y.push(y);
      }
      if (!run || jumps || run.state !== state) {
        const next = { state, x: [points.value[i]], y: [y] };
        open.set(k, next);
        lines.push(next);
      }
    });
  }
  return { lines, all };
}
