// The effects of keys that a sweep varies one at a time: a tornado diagram of each measure, a table.

/** True for an effect that its interval distinguishes from none, or that has no interval. */
const isSeen = (columns, i) => {
  const half = (columns.half_width_95 || [])[i];
  return !(typeof half === "number" && Math.abs(columns.effect[i]) <= half);
};

/** True if the measure lies on one side of that of the case at both bounds. */
const turnsBetween = (columns, i) =>
  (columns.at_low[i] - columns.base[i]) * (columns.at_high[i] - columns.base[i]) > 0;

/** The looks of a measure at the lower and at the upper bound of a key, as in the figure. */
const BOUND_LOOKS = [3, 2];

/** Bars from the measure in the case to that at each bound, of the keys in these rows. */
function effectBars(columns, rows, name) {
  const unit = columns.unit[rows[0]];
  const label = name + (unit ? ` (${unit})` : "");
  const bar = (ctx, plot, i, y) => {
    const base = plot.sx(columns.base[i]);
    const ends = [columns.at_low[i], columns.at_high[i]].map((x, side) => [plot.sx(x), side]);
    // The longer half first, so that both show where they lie on one side.
    ends.sort(([a], [b]) => Math.abs(b - base) - Math.abs(a - base));
    for (const [end, side] of ends) {
      if (!Number.isFinite(end)) continue;
      ctx.strokeStyle = ctx.fillStyle = lookOf(BOUND_LOOKS[side]).colour();
      ctx.lineWidth = 1.4;
      const place = [Math.min(base, end), y - 8, Math.abs(end - base), 16];
      if (!isSeen(columns, i)) ctx.fillStyle = ink.paper;
      ctx.fillRect(...place);
      ctx.strokeRect(...place);
    }
  };
  const values = rows.flatMap((i) => [columns.base[i], columns.at_low[i], columns.at_high[i]]);
  return barPlot(columns, rows, {
    x: label,
    alt: `Effects on ${label}`,
    values,
    base: columns.base[rows[0]],
    bar,
  });
}

/**
 * Bars of the keys in these rows, the first above. Options: x, alt, values (what the axis spans),
 * base (where an upright line stands), bar(ctx, plot, i, y) draws that of row i at the height y.
 */
function barPlot(columns, rows, { x, alt, values, base, bar }) {
  const level = (k) => rows.length - k;
  const draw = (ctx, plot) => {
    rows.forEach((i, k) => bar(ctx, plot, i, plot.sy(level(k))));
    ctx.strokeStyle = ink.ink;
    ctx.beginPath();
    ctx.moveTo(plot.sx(base), plot.y0);
    ctx.lineTo(plot.sx(base), plot.y1);
    ctx.stroke();
  };
  const plot = new Plot({
    x,
    height: 60 + 28 * rows.length,
    left: 210,
    narrow: 140,
    alt,
    yTicks: rows.map((i, k) => [level(k), String(columns.key[i])]),
    range: () => [0.4, rows.length + 0.6],
    series: [{ kind: "own", look: lookOf(0), x: values, y: [], draw }],
  });
  return plot.box;
}

/** The lines of each measure and place of a table of effects or shares, by its name in words. */
function linesByMeasure({ columns, rows }) {
  const groups = new Map();
  for (const i of rows) {
    const name = `${columns.measure[i]} ${columns.place[i] || ""}`.replace(/_/g, " ").trim();
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push(i);
  }
  return [...groups];
}

/** The diagrams of all measures and places, with what the colours stand for. */
function effectDiagrams(effects) {
  const { columns, rows } = effects;
  const words = ["at the lower bound", "at the upper bound"];
  const hollow = rows.some((i) => !isSeen(columns, i));
  return [
    el(
      "div",
      { class: "bar" },
      words.map((text, side) => swatch(text, () => lookOf(BOUND_LOOKS[side]).colour())),
      hollow ? el("span", {}, "hollow: the effect is not distinguished from none") : null,
    ),
    ...linesByMeasure(effects).map(([name, lines]) => effectBars(columns, lines, name)),
  ];
}

/** The words of a table of effects or shares that stand before its numbers. */
const namedColumns = (columns) =>
  ["measure", "place", "unit", "key"]
    .filter((name) => Array.isArray(columns[name]))
    .map((name) => ({
      name,
      text: true,
      value: (i) => String(columns[name][i]),
      show: (i) => String(columns[name][i]) || "–",
    }));

function effectsSection(effects, seeds) {
  const { columns, rows } = effects;
  const number = (name, title) => ({
    name: title,
    value: (i) => columns[name][i],
    show: (i) => digits(columns[name][i], 4),
  });
  const half = columns.half_width_95 || [];
  const effect = {
    name: "effect",
    value: (i) => columns.effect[i],
    show: (i) => plusMinus(columns.effect[i], half[i]),
  };
  const seen = wordColumn("distinguished from none", (i) => (isSeen(columns, i) ? "yes" : "no"));
  section(
    "effects",
    "Effects",
    "Each key by itself, from the case, the widest bar first. An effect is the measure at the upper bound less that at the lower one" +
      (rows.some((i) => turnsBetween(columns, i))
        ? "; where both lie on one side of the case, the measure turns between them, and its bar says more."
        : ".") +
      (seeds
        ? ` Means over ${seeds}, of differences under the same seeds; ± is the half width of the 95 % interval, by Student's t.`
        : ""),
    ...effectDiagrams(effects),
    sortable(
      [
        ...namedColumns(columns),
        number("low", "low"),
        number("high", "high"),
        number("base", "in the case"),
        number("at_low", "at low"),
        number("at_high", "at high"),
        effect,
        ...(seeds ? [seen] : []),
      ],
      rows,
      { height: 60 + ROW * Math.min(rows.length, 16) },
    ),
  );
}
