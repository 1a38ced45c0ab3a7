// The page of a comparison: the means over realisations, the table of methods, and how far each is
// from the reference.

/** Names of the columns of compare.csv as people write them, with errors as shares of `length`. */
const compared = (length) => [
  ["method", "method"],
  ["error_over_gap", `error / ${length}`],
  ["agrees_until_s", "agrees until (s)"],
  ["force_largest_N", "largest force (N)"],
  ["peak_force_N", "peak force (N)"],
  ["restitution", "restitution"],
  ["penetration_m", "penetration (m)"],
  ["largest_displacement_m", "max |u| (m)"],
  ["step_s", "step (s)"],
  ["energy_residual", "energy residual"],
  ["complementarity_residual", "complementarity"],
  ["step_ns", "ns a step"],
  ["refuted", "refuted"],
  ["failure", "failure"],
];

function compareSection() {
  const { reference, draws } = DATA.compare;
  const table = tableOf(DATA.compare.table);
  const said = (name) =>
    Array.isArray(table.columns[name]) && table.columns[name].some((word) => word);
  const columns = columnsOf(
    table,
    compared(DATA.compare.length).filter(([name]) => !["refuted", "failure"].includes(name) || said(name)),
  );
  section(
    "methods",
    "Methods",
    "Every method on the same scene" +
      (reference ? `, against ${reference}${DATA.horizon ? " up to the horizon of prediction" : ""}` : "") +
      (draws > 1 ? `: draw 1 of ${draws}.` : ".") +
      " The largest force of a method with rigid walls is the largest mean over a short stretch (--force-averaging)," +
      " that of a penalty and of springs the largest value; max |u| is that of the recorded rows.",
    conclusionOf(DATA.compare.conclusion),
    sortable(columns, table.rows, { height: 60 + 2 * ROW * table.count, wrapped: true }),
    saveBar("compare.csv", () => linesOf(table)),
    distancePlot(),
  );
}

/** The means of each method over the realisations, and their differences from one method's. */
function methodMeansSection() {
  const { means, draws } = DATA.compare;
  const table = tableOf(means);
  const { columns, rows } = table;
  const text = (name, words) => wordColumn(words, (i) => columns[name][i]);
  // A column without any number is one of empty words.
  const at = (name, i) => (Array.isArray(columns[name]) ? NaN : columns[name][i]);
  const number = (words, name, half) => ({
    name: words,
    value: (i) => at(name, i),
    show: (i) => plusMinus(at(name, i), at(half, i)),
  });
  const less = Array.from(columns.less).find((name) => typeof name === "string" && name);
  // By place and quantity, in the order of the file, and the methods of each together.
  const key = (i) => `${columns.place[i]} ${columns.kind[i]} ${columns.measure[i]}`;
  const first = new Map([...rows].reverse().map((i) => [key(i), i]));
  rows.sort((i, j) => first.get(key(i)) - first.get(key(j)) || i - j);
  section(
    "means",
    "Means over realisations",
    `Over ${draws} realisations, with 95 % intervals` +
      (less ? `; differences are between runs with the same seeds.` : "."),
    sortable(
      [
        text("place", "place"),
        text("kind", "kind"),
        { ...text("measure", "mean of"), show: (i) => measureInWords(columns.measure[i]) },
        text("unit", "unit"),
        text("method", "method"),
        number("mean", "mean", "half_width_95"),
        ...(less ? [number(`less ${less}`, "difference", "difference_half_width_95")] : []),
      ],
      rows,
      { height: 60 + ROW * Math.min(rows.length, 16) },
    ),
  );
}

/** What a study says in one sentence, if it does. */
function conclusionOf(text) {
  if (!text) return null;
  // A number and its unit stand on one line.
  const whole = text.replace(/(\d) (?=([mµn]?s|%)(\W|$))/g, "$1\u00a0");
  return el("p", { class: "conclusion" }, sentence(whole));
}

/** The distance of each method from the reference: the largest of each stretch, since |Δu| itself passes through 0. */
function distancePlot() {
  const { distance, agreement, reference, length } = DATA.compare;
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
  const marks = [{ y: agreement, dash: [2, 3], label: `a tenth of ${length === "gap" ? "the gap" : length}` }];
  if (DATA.horizon) marks.push(horizonMark(true));
  const plot = new Plot({
    x: "Time (s)",
    y: `|Δu| / ${length}`,
    alt: `Distance from ${reference}`,
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
      `Distance from ${reference}, the largest of each ${prefixed(distance.stretch || 0, "s", 2)}`,
    ),
    runChips(),
    plot.box,
  );
}
