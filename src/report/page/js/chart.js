// The page of a chart: accuracy against speed.

/** The errors: column of work-precision.csv, its name, and the label of the axis. */
const CHARTED = [
  ["displacement_error_over_gap", "Displacement", "Largest displacement error over the gap"],
  ["velocity_graph_error", "Velocity", "Error of the velocity graph"],
  ["impulse_error_of_the_worst_wall", "Impulse", "Relative impulse error of the worst wall"],
  ["contact_time_error", "Contact times", "Largest shift of a contact over the duration"],
  [
    "own_displacement_error_over_gap",
    "Own springs",
    "Displacement error against the exact motion between its own springs",
  ],
];

/** Errors below this are negligible; from this on a result is useless, however cheap. */
const [NEGLIGIBLE, NO_ANSWER] = [1e-9, 1];

const CHART_NOTE =
  "Further down is cheaper, further left is more accurate; the pale band is the least time for each error. Times are the best of several.";

/** Width of a plot, in pixels, from which on curves are named at their ends. */
const ROOM_FOR_NAMES = 560;

/** The curves of one kind of error, and what is told of their points. */
class ChartData {
  constructor() {
    const { labels, floors, orders, programs } = DATA.chart;
    this.table = tableOf(DATA.chart.table);
    this.columns = this.table.columns;
    const { columns } = this;
    this.kinds = CHARTED.filter(([name]) => columns[name] && !Array.isArray(columns[name]));
    [this.error] = this.kinds[0];
    [this.floors, this.orders] = [floors || [], orders || {}];
    const methods = [...new Set(columns.method)];
    const isPenalty = (name) => name.startsWith("penalty");
    const law = (name) => name.replace(/,?integrator=[^,]*/, "");
    // Against the walls the integrators of one penalty end at one floor: the first stands for all.
    const first = (name) => methods.find((other) => law(other) === law(name)) === name;
    const curve = (springs) => (name, n) => {
      const label = labels[columns.method.indexOf(name)];
      const floor = this.floors.find((one) => label.startsWith(`${one.law},`));
      // Where one integrator stands for all, its name would only take room.
      const short = floor && !springs ? floor.law : label;
      return { look: lookOf(n), method: name, springs, label, short, floor, points: [] };
    };
    this.curves = [
      ...methods.filter((name) => !isPenalty(name) || first(name)).map(curve(false)),
      ...methods.filter(isPenalty).map(curve(true)),
    ];
    const walls = this.curves.filter(({ springs }) => !springs).length;
    this.programs = (programs || []).map(([label, points], n) => ({
      look: lookOf(walls + n),
      label,
      short: label,
      points: points.map(([x, y]) => ({ x, y, text: `${label}\ntook ${prefixed(y, "s")}\nerror ${digits(x, 3)}` })),
    }));
    this.choose(this.error);
  }

  /** The curves of the error that is chosen. */
  get shown() {
    const springs = this.error.startsWith("own");
    const own = this.curves.filter((one) => one.springs === springs && one.points.length);
    // Other programs tell the error of the displacement only.
    return this.error === this.kinds[0][0] ? [...own, ...this.programs] : own;
  }

  /** Which integrators of a penalty are drawn. */
  get integrators() {
    return this.error.startsWith("own")
      ? "Every integrator of every penalty is drawn."
      : "Of the integrators of a penalty the first is drawn.";
  }

  /** The floor of a curve in the error that is chosen. */
  floorOf({ floor, springs }) {
    return (floor && !springs && floor[this.error]) || null;
  }

  choose(error) {
    this.error = error;
    const { method, seconds, contacts_missing: missing, contacts_spurious: spurious } = this.columns;
    const errors = this.columns[error];
    // Where a contact is missing, the shift of the others says nothing.
    const whole = (i) => error !== "contact_time_error" || !(missing[i] + spurious[i] > 0);
    for (const curve of this.curves) {
      const rows = method.map((_, i) => i).filter((i) => method[i] === curve.method);
      const drawn = rows.filter((i) => errors[i] > 0 && seconds[i] > 0 && whole(i));
      drawn.sort((i, j) => seconds[i] - seconds[j]);
      curve.points = drawn.map((i, k) => ({
        x: errors[i],
        y: seconds[i],
        text: this.told(curve, i, drawn[k - 1]),
      }));
    }
  }

  /** What is told of the point of row i, the next coarser of which is that of row `coarser`. */
  told(curve, i, coarser) {
    const { method, step_s: step, seconds, remark } = this.columns;
    const errors = this.columns[this.error];
    const here =
      coarser !== undefined &&
      Math.log(errors[i] / errors[coarser]) / Math.log(step[i] / step[coarser]);
    const order = this.orders[method[i]];
    const floor = this.floorOf(curve);
    return [
      method[i],
      `${step[i] > 0 ? `step ${prefixed(step[i], "s")}, ` : ""}took ${prefixed(seconds[i], "s")}`,
      `error ${digits(errors[i], 3)}`,
      Number.isFinite(here) ? `order ${minus(here.toFixed(2))} from the coarser step to this` : "",
      Number.isFinite(order)
        ? `order ${minus(order.toFixed(2))} of the displacement over all steps${curve.floor ? ", of its own springs" : ""}`
        : "",
      floor ? `${floor.label}, to which finer steps lead` : "",
      Array.isArray(remark) ? remark[i] : "",
    ]
      .filter((line) => line)
      .join("\n");
  }

  /** The least time for each error, a staircase up to the last error that is an answer. */
  get front() {
    const points = this.shown.flatMap((one) => one.points).filter(({ x }) => x <= NO_ANSWER);
    points.sort((a, b) => a.x - b.x);
    const [x, y] = [[], []];
    let best = Infinity;
    for (const point of points) {
      if (!(point.y < best)) continue;
      if (x.length) {
        x.push(point.x);
        y.push(best);
      }
      best = point.y;
      x.push(point.x);
      y.push(best);
    }
    if (x.length) {
      x.push(NO_ANSWER);
      y.push(best);
    }
    return { x, y };
  }
}

/** Accuracy against speed, with a choice of error: what follows from it, then the picture. */
function chartSection() {
  const { conclusions, cheapest, compared } = DATA.chart;
  const data = new ChartData();
  const frontLook = { colour: () => ink.reference, width: 8, dash: [], behind: true };
  const plot = new Plot({
    x: " ",
    y: "Time of the run",
    alt: "Accuracy against speed",
    height: 480,
    log: [true, true],
  });
  const limits = plot.limits;
  plot.limits = () => {
    limits.call(plot);
    // Whole decades of the errors that matter; what lies beyond is named at the edge.
    const all = data.shown.flatMap((one) => one.points.map(({ x }) => x));
    const least = Math.min(0.1, ...all.filter((x) => x >= NEGLIGIBLE && x <= NO_ANSWER));
    plot.X = [10 ** Math.floor(Math.log10(0.9 * least)), NO_ANSWER];
    plot.yTicks = logTicks(...plot.Y, 12).map(([y]) => [y, prefixed(y, "s", 2)]);
  };
  const name = (curve) => (data.floorOf(curve) || { label: curve.short }).label;
  // At the edge there is no room for a floor beyond it, which is told below.
  const shortName = (curve) => (data.floorOf(curve)?.at > NO_ANSWER ? curve.short : name(curve));
  const key = el("ul", { class: "curves", hidden: true });
  // In a narrow window names among the curves would lie on them: they stand below.
  const drawNames = (ctx) => {
    const named = (of) => plot.curves.map((curve) => ({ ...curve, name: of(curve) }));
    key.hidden = plot.w >= ROOM_FOR_NAMES;
    if (key.hidden) drawEndNames(ctx, plot, named(shortName), [data.front]);
    else key.replaceChildren(...namesBeside(plot, named(name)));
  };
  const [headline, told] = [el("div"), el("div")];
  const reasons = el("ul", { class: "notes floors" });
  const note = el("p", { class: "lead" });
  const fill = () => {
    plot.x = data.kinds.find(([column]) => column === data.error)[2];
    plot.curves = data.shown.map((curve) => ({
      ...curve,
      kind: "marked",
      x: curve.points.map(({ x }) => x),
      y: curve.points.map(({ y }) => y),
    }));
    plot.series = [
      { kind: "line", look: frontLook, ...data.front },
      ...plot.curves,
      { kind: "own", look: lookOf(0), x: [], y: [], draw: drawNames },
    ];
    const floors = data.shown.filter((curve) => data.floorOf(curve));
    plot.marks = floors.map((curve) => ({
      x: data.floorOf(curve).at,
      floor: true,
      dash: [5, 3],
      colour: curve.look.colour,
    }));
    reasons.replaceChildren(
      ...floors.map((curve) => el("li", {}, `${data.floorOf(curve).reason || curve.floor.reason}.`)),
    );
    headline.replaceChildren(...[conclusionOf(conclusions[data.error])].filter((text) => text));
    told.replaceChildren(...[cheapestTable(cheapest, data.error)].filter((table) => table));
    const sentences = [CHART_NOTE, data.integrators, ...(compared || []).map(sentence)];
    note.replaceChildren(...worded(sentences.join(" ")));
    plot.redraw();
  };
  tellNearest(
    plot,
    () => data.shown.flatMap((one) => one.points),
    ({ text }) => text,
  );
  fill();
  const tabs = segmented("Error", data.kinds, data.error, (error) => {
    data.choose(error);
    fill();
  });
  section(
    "work",
    "Accuracy against speed",
    null,
    headline,
    el("div", { class: "bar controls" }, tabs),
    told,
    plot.box,
    key,
    reasons,
    note,
  );
  pointsSection(data.table);
}

/** Every point with its errors. */
function pointsSection(table) {
  const columns = columnsOf(table, [
    ["method", "Method"],
    ["step_s", "Step (s)"],
    ["seconds", "Time (s)"],
    ...CHARTED,
    ["contacts_missing", "Missing"],
    ["contacts_spurious", "Spurious"],
  ]);
  section(
    "points",
    "Points",
    "Every run: its step, its time and its errors, and the contacts that it misses or has beyond the reference's.",
    sortable(columns, table.rows, { height: 360 }),
    saveBar("work-precision.csv", () => linesOf(table)),
  );
}
