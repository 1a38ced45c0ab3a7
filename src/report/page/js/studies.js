// Pages of several runs: the comparison of methods, accuracy against speed.

/** Names of the columns of compare.csv as people write them. */
const COMPARED = [
  ["method", "method"],
  ["step_s", "step (s)"],
  ["restitution", "restitution"],
  ["error_over_gap", "error / gap"],
  ["agrees_until_s", "agrees until (s)"],
  ["largest_displacement_m", "max |u| (m)"],
  ["penetration_m", "penetration (m)"],
  ["peak_force_N", "peak force (N)"],
  ["energy_residual", "energy residual"],
  ["complementarity_residual", "complementarity"],
  ["step_ns", "ns a step"],
  ["refuted", "refuted"],
  ["failure", "failure"],
];

function compareSection() {
  const table = tableOf(DATA.compare.table);
  const rows = Array.from({ length: table.count }, (_, i) => i);
  const said = (name) =>
    Array.isArray(table.columns[name]) && table.columns[name].some((word) => word);
  const columns = columnsOf(
    table,
    COMPARED.filter(([name]) => !["refuted", "failure"].includes(name) || said(name)),
  );
  const saved = () =>
    save(
      "compare.csv",
      csvText([table.names, ...rows.map((i) => table.names.map((name) => table.columns[name][i]))]),
      "text/csv",
    );
  section(
    "methods",
    "Methods",
    `Every method on the same scene, against the exact motion${DATA.horizon ? " up to the horizon of prediction" : ""}.`,
    sortable(columns, rows, { height: 60 + ROW * rows.length }),
    el("div", { class: "bar controls" }, button("The table above", saved, "Save compare.csv")),
    distancePlot(),
  );
}

/** The distance of each method from the reference: the largest of each stretch, since |Δu| itself passes through 0. */
function distancePlot() {
  const { distance, agreement } = DATA.compare;
  if (!distance) return null;
  const time = decode(distance.time);
  const series = distance.names
    .map((name, i) => {
      const run = runs.find((other) => other.label === name);
      return (
        run && {
          look: run.look,
          x: time,
          y: decode(distance.methods[i]),
          hidden: () => !run.shown,
          run,
        }
      );
    })
    .filter((s) => s);
  const marks = [{ y: agreement, dash: [2, 3], label: "a tenth of the gap" }];
  if (DATA.horizon) marks.push(horizonMark(true));
  const plot = new Plot({
    x: "Time (s)",
    y: "|Δu| / gap",
    alt: "Distance from the exact motion",
    height: 260,
    view,
    log: [false, true],
    series,
    marks,
  });
  plot.range = () => {
    let [lo, hi] = [Infinity, agreement];
    for (const s of plot.shown)
      for (const y of s.y) if (y > 0 && y < Infinity) [lo, hi] = [Math.min(lo, y), Math.max(hi, y)];
    return [clamp(lo, 1e-16, agreement / 10), 2 * Math.min(hi, 1e3)];
  };
  timed(plot);
  return el(
    "div",
    {},
    el(
      "h3",
      {},
      `Distance from the exact motion, the largest of each ${prefixed(distance.stretch || 0, "s", 2)}`,
    ),
    runChips(),
    plot.box,
  );
}

const CHARTED = [
  ["displacement_error_over_gap", "Displacement", "Largest displacement error over the gap"],
  ["velocity_graph_error", "Velocity", "Error of the velocity graph"],
  ["impulse_error_of_the_worst_wall", "Impulse", "Relative impulse error of the worst wall"],
  ["contact_time_error", "Contact times", "Error of the contact times"],
  [
    "own_displacement_error_over_gap",
    "Own springs",
    "Displacement error against the exact motion between its own springs",
  ],
];

/** Accuracy against speed, with a choice of error. */
function chartSection() {
  const table = tableOf(DATA.chart.table);
  const { method, step_s: step, seconds, remark } = table.columns;
  const methods = [...new Set(method)];
  const kinds = CHARTED.filter(
    ([name]) => table.columns[name] && !Array.isArray(table.columns[name]),
  );
  const choice = { error: kinds[0][0] };
  // Integrators other than the default are many, and begin switched off.
  const items = methods.map((name, n) => ({
    label: name,
    look: lookOf(n),
    shown: !/integrator=(?!trapezoidal)/.test(name),
  }));
  const series = items.map((item) => ({
    kind: "marked",
    look: item.look,
    x: [],
    y: [],
    rows: [],
    hidden: () => !item.shown,
    item,
  }));
  const front = {
    kind: "line",
    look: { colour: () => ink.reference, width: 8, dash: [], behind: true },
    x: [],
    y: [],
  };
  const plot = new Plot({
    x: " ",
    y: "Time of the run (s)",
    alt: "Accuracy against speed",
    height: 480,
    log: [true, true],
    series: [front, ...series],
  });
  const fill = () => {
    const errors = table.columns[choice.error];
    plot.x = kinds.find(([name]) => name === choice.error)[2];
    for (const s of series) {
      s.rows = method
        .map((_, i) => i)
        .filter((i) => method[i] === s.item.label && errors[i] > 0 && seconds[i] > 0);
      s.rows.sort((i, j) => errors[i] - errors[j]);
      [s.x, s.y] = [s.rows.map((i) => errors[i]), s.rows.map((i) => seconds[i])];
    }
    // The least time for each error, a staircase.
    const all = series
      .filter((s) => !s.hidden())
      .flatMap((s) => s.rows)
      .sort((i, j) => errors[i] - errors[j]);
    [front.x, front.y] = [[], []];
    let best = Infinity;
    for (const i of all) {
      if (!(seconds[i] < best)) continue;
      if (front.x.length) {
        front.x.push(errors[i]);
        front.y.push(best);
      }
      best = seconds[i];
      front.x.push(errors[i]);
      front.y.push(best);
    }
    plot.dirty = true;
    refresh();
  };
  const points = () =>
    series
      .filter((s) => !s.hidden())
      .flatMap((s) => s.rows.map((i, k) => ({ x: s.x[k], y: s.y[k], i })));
  tellNearest(plot, points, ({ i, x, y }) =>
    [
      method[i],
      `${step[i] > 0 ? `step ${prefixed(step[i], "s")}, ` : ""}took ${prefixed(y, "s")}`,
      `error ${digits(x, 3)}`,
      Array.isArray(remark) ? remark[i] : "",
    ]
      .filter((line) => line)
      .join("\n"),
  );
  fill();
  const kindButtons = segmented(
    "Error",
    kinds.map(([name, text]) => [name, text]),
    choice.error,
    (name) => {
      choice.error = name;
      fill();
    },
  );
  const told = table.names.filter((name) => name !== "remark");
  const rows = method.map((_, i) => i);
  const columns = columnsOf(
    table,
    told.map((name) => [name, name.replace(/_/g, " ")]),
  );
  const saved = () =>
    save(
      "work-precision.csv",
      csvText([table.names, ...rows.map((i) => table.names.map((name) => table.columns[name][i]))]),
      "text/csv",
    );
  section(
    "work",
    "Accuracy against speed",
    "Every method over a range of steps, against the exact motion; best of several timings. Further down is cheaper, further left is more accurate; the pale band is the least time for each error.",
    el("div", { class: "bar controls" }, kindButtons),
    plot.box,
    chips(items, fill),
  );
  section(
    "points",
    "Points",
    null,
    sortable(columns, rows, { height: 360 }),
    el(
      "div",
      { class: "bar controls" },
      button("The table above", saved, "Save work-precision.csv"),
    ),
  );
}
