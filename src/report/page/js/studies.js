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
    conclusionOf(DATA.compare.conclusion),
    sortable(columns, rows, { height: 60 + ROW * rows.length }),
    el("div", { class: "bar controls" }, button("The table above", saved, "Save compare.csv")),
    distancePlot(),
  );
}

/** What a study says in one sentence, if it does. */
function conclusionOf(text) {
  return text ? el("p", { class: "conclusion" }, `${text[0].toUpperCase()}${text.slice(1)}.`) : null;
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

/** Errors below this are negligible; from this on a result is useless, however cheap. */
const [NEGLIGIBLE, NO_ANSWER] = [1e-8, 1];

/** The names of the errors of CHARTED for which the cheapest methods are known. */
const CHEAPEST_OF = {
  displacement_error_over_gap: "displacement",
  impulse_error_of_the_worst_wall: "impulse",
  contact_time_error: "contact time",
};

/** Accuracy against speed, with a choice of error: what follows from it, then the picture. */
function chartSection() {
  const { labels, conclusion, cheapest } = DATA.chart;
  const table = tableOf(DATA.chart.table);
  const { method, step_s: step, seconds, remark } = table.columns;
  const kinds = CHARTED.filter(
    ([name]) => table.columns[name] && !Array.isArray(table.columns[name]),
  );
  const choice = { error: kinds[0][0] };
  const isPenalty = (name) => name.startsWith("penalty");
  const law = (name) => name.replace(/,?integrator=[^,]*/, "");
  const methods = [...new Set(method)];
  // Against the walls the integrators of one penalty end at one floor: the first stands for all.
  const first = (name) => methods.find((other) => law(other) === law(name)) === name;
  const ownSprings = () => choice.error.startsWith("own");
  const series = methods.map((name, n) => ({
    kind: "marked",
    look: lookOf(n),
    x: [],
    y: [],
    rows: [],
    label: labels[method.indexOf(name)],
    hidden: () => (ownSprings() ? !isPenalty(name) : isPenalty(name) && !first(name)),
    name,
  }));
  const front = {
    kind: "line",
    look: { colour: () => ink.reference, width: 8, dash: [], behind: true },
    x: [],
    y: [],
  };
  const named = { kind: "own", look: lookOf(0), x: [], y: [], draw: drawNames };
  const plot = new Plot({
    x: " ",
    y: "Time of the run (s)",
    alt: "Accuracy against speed",
    height: 480,
    log: [true, true],
    series: [front, ...series, named],
  });
  const limits = plot.limits;
  plot.limits = () => {
    limits.call(plot);
    // Whole decades of the errors that matter; what lies beyond is named at the edge.
    const within = series
      .filter((s) => !s.hidden())
      .flatMap((s) => s.x)
      .filter((x) => x >= NEGLIGIBLE && x <= NO_ANSWER);
    const least = Math.min(0.1, ...within);
    plot.X = [10 ** Math.floor(Math.log10(0.9 * least)), NO_ANSWER];
  };
  /** Each curve's name at one of its ends, where neither a name nor a point stands. */
  function drawNames(ctx, plot) {
    const shown = series.filter((s) => !s.hidden() && s.x.length);
    const inside = (x) => x >= plot.X[0] && x <= plot.X[1];
    const spots = (s) =>
      s.x
        .map((x, k) => [x, plot.sy(s.y[k])])
        .filter(([x]) => inside(x))
        .map(([x, y]) => [plot.sx(x), y]);
    // The points, and the lines between them at every few pixels.
    const taken = shown.flatMap((s) =>
      spots(s).flatMap(([x, y], k, all) => {
        const [a, b] = all[k + 1] || [x, y];
        const parts = Math.max(1, Math.ceil(Math.hypot(a - x, b - y) / 8));
        const along = (part) => [
          x + ((a - x) * part) / parts - 4,
          y + ((b - y) * part) / parts - 4,
        ];
        return Array.from({ length: parts }, (_, part) => [...along(part), 8, 8]);
      }),
    );
    const names = [];
    const inFrame = ([x, y, w, h]) =>
      x >= plot.x0 + 2 && x + w <= plot.x1 - 2 && y >= plot.y0 + 2 && y + h <= plot.y1 - 2;
    const apart =
      (others) =>
      ([x, y, w, h]) =>
        !others.some(([a, b, c, d]) => x < a + c && a < x + w && y < b + d && b < y + h);
    ctx.textBaseline = "middle";
    ctx.textAlign = "left";
    ctx.lineJoin = "round";
    for (const s of shown) {
      const own = spots(s).sort(([, y], [, other]) => y - other);
      // A curve that lies beyond the axis is named at the edge, with an arrow and its error.
      const most = extent(s.x)[1];
      const beyond = own.length ? "" : most < plot.X[0] ? "left" : "right";
      const ends = own.length
        ? [own[0], own[own.length - 1]]
        : [[beyond === "left" ? plot.x0 + 6 : plot.x1 - 6, plot.sy(Math.max(...s.y))]];
      // Where one integrator stands for all, its name would only take room.
      const name = ownSprings() || !isPenalty(s.name) ? s.label : s.label.replace(/, [a-z-]+$/, "");
      const text = {
        "": name,
        left: `◂ ${name} (${digits(most, 1)})`,
        right: `${name} ▸`,
      }[beyond];
      const [w, h] = [ctx.measureText(text).width, 15];
      const around = ([x, y]) => [
        [x + 8, y - h / 2, w, h],
        [x - 8 - w, y - h / 2, w, h],
        [x - w / 2, y - 8 - h, w, h],
        [x - w / 2, y + 8, w, h],
      ];
      // Farther and farther along the frame, where the ends are crowded.
      const places = Array.from({ length: 40 }, (_, k) => k).flatMap((k) =>
        ends.flatMap(([x, y]) => [...around([x, y + 10 * k]), ...around([x, y - 10 * k])]),
      );
      // Over a line where there is no room beside all of them, over no other name.
      const within = places.filter(inFrame).filter(apart(names));
      const place = within.find(apart(taken)) || within[0];
      if (!place) continue;
      names.push(place);
      const [x, y] = [place[0], place[1] + h / 2];
      ctx.strokeStyle = ink.paper;
      ctx.lineWidth = 4;
      ctx.strokeText(text, x, y);
      ctx.fillStyle = s.look.colour();
      ctx.fillText(text, x, y);
    }
  }
  const told = el("div");
  const fill = () => {
    const errors = table.columns[choice.error];
    plot.x = kinds.find(([name]) => name === choice.error)[2];
    for (const s of series) {
      s.rows = method
        .map((_, i) => i)
        .filter((i) => method[i] === s.name && errors[i] > 0 && seconds[i] > 0);
      s.rows.sort((i, j) => seconds[i] - seconds[j]);
      [s.x, s.y] = [s.rows.map((i) => errors[i]), s.rows.map((i) => seconds[i])];
    }
    // The least time for each error, a staircase.
    const all = series
      .filter((s) => !s.hidden())
      .flatMap((s) => s.rows)
      .filter((i) => errors[i] <= NO_ANSWER)
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
    told.replaceChildren(...cheapestTable(cheapest, CHEAPEST_OF[choice.error]));
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
  const shownColumns = table.names.filter((name) => name !== "remark");
  const rows = method.map((_, i) => i);
  const columns = columnsOf(
    table,
    shownColumns.map((name) => [name, name.replace(/_/g, " ")]),
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
    null,
    conclusionOf(conclusion),
    el("div", { class: "bar controls" }, kindButtons),
    told,
    plot.box,
    el(
      "p",
      { class: "lead" },
      "Every method over a range of steps, against the exact motion; best of several timings. Further down is cheaper, further left is more accurate; the pale band is the least time for each error. Of the integrators of a penalty the first is drawn.",
    ),
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

/** The table of the cheapest methods for one kind of error; nothing where none is known. */
function cheapestTable(cheapest, error) {
  const rows = (cheapest || []).filter((row) => row.error === error);
  if (!rows.length) return [];
  const text = (name, show) => ({ name, text: true, value: show, show });
  const number = (name, value) => ({
    name,
    value: (row) => value(row) ?? NaN,
    show: (row) => prefixed(value(row) ?? NaN, "s", 2),
  });
  const columns = [
    text("error within", (row) => row.within),
    text("kind", (row) => row.kind),
    text("cheapest method", (row) => row.label || "none of the steps tried"),
    number("step", (row) => row.step_s),
    number("time", (row) => row.seconds),
  ];
  return [sortable(columns, rows, { height: 60 + ROW * rows.length })];
}
