// The page of a comparison: the table of methods, and how far each is from the exact motion.

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
  if (!text) return null;
  // A number and its unit stand on one line.
  const whole = text.replace(/(\d) (?=([mµn]?s|%)(\W|$))/g, "$1\u00a0");
  return el("p", { class: "conclusion" }, `${whole[0].toUpperCase()}${whole.slice(1)}.`);
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
