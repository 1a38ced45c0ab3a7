// The effects of keys that a sweep varies one at a time, as a table.

/** True for an effect that its interval distinguishes from none, or that has no interval. */
const isSeen = (columns, i) =>
  !(Math.abs(columns.effect[i]) <= (columns.half_width_95 || [])[i]);

function effectsSection(effects, seeds) {
  const { columns, count } = effects;
  const number = (name, title) => ({
    name: title,
    value: (i) => columns[name][i],
    show: (i) => digits(columns[name][i], 4),
  });
  const text = (name, title) => ({
    name: title,
    text: true,
    value: (i) => String(columns[name][i]),
    show: (i) => String(columns[name][i]) || "–",
  });
  const half = columns.half_width_95 || [];
  const effect = {
    name: "effect",
    value: (i) => columns.effect[i],
    show: (i) =>
      Number.isFinite(half[i])
        ? `${digits(columns.effect[i], 3)} ± ${digits(half[i], 2)}`
        : digits(columns.effect[i], 4),
  };
  const seen = {
    name: "distinguished from none",
    text: true,
    value: (i) => (isSeen(columns, i) ? "yes" : "no"),
    show: (i) => (isSeen(columns, i) ? "yes" : "no"),
  };
  const named = ["place", "unit"].filter((name) => Array.isArray(columns[name]));
  section(
    "effects",
    "Effects",
    "Each key by itself, from the case: the measure at the upper bound less that at the lower one, the largest first." +
      (seeds
        ? ` Means over ${seeds} realisations of the random loads, of differences under the same seeds; ± is the half width of the 95 % interval, by Student's t.`
        : ""),
    sortable(
      [
        text("measure", "measure"),
        ...named.map((name) => text(name, name)),
        text("key", "key"),
        number("low", "low"),
        number("high", "high"),
        number("base", "in the case"),
        number("at_low", "at low"),
        number("at_high", "at high"),
        effect,
        ...(seeds ? [seen] : []),
      ],
      Array.from({ length: count }, (_, i) => i),
      { height: 60 + ROW * Math.min(count, 16) },
    ),
  );
}
