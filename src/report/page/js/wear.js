// Wear over the years at supports whose gaps grow: curves with their intervals, and the table.

/** The rows of years.csv with a column for each quantity of each place, as in a sweep; m as mm. */
function wearColumns(table) {
  const { rows } = table;
  const { place, year } = table.columns;
  const names = [...new Set(place)];
  // Numbers, as decoded columns are.
  const column = (name, value) => Float64Array.from(rows.filter((i) => place[i] === name).map(value));
  const columns = { year: column(names[0], (i) => year[i]) };
  for (const header of table.names.filter((name) => !["year", "place"].includes(name))) {
    const [, quantity, unit] = /^(.*)_(\w+)$/.exec(header);
    const [shown, factor] = unit === "m" ? ["mm", 1e3] : [unit, 1];
    for (const name of names)
      columns[`${quantity}_${name.replace(/-/g, "_")}_${shown}`] = column(
        name,
        (i) => factor * table.columns[header][i],
      );
  }
  return columns;
}

/** Curves that are shown at first, where all are too many: of the supports that are worn deepest. */
const FIRST_CURVES = 6;

/** The names of these curves; null where few are there, of which all may be shown. */
function firstOfWear(columns, measures) {
  const last = (name) => columns[name][columns[name].length - 1];
  const of = (quantity) => measures.filter((name) => name.startsWith(quantity));
  const deepest = of("depth_deepest");
  if (deepest.length <= FIRST_CURVES / 2) return null;
  const worst = (names) => [...names].sort((a, b) => last(b) - last(a)).slice(0, FIRST_CURVES);
  return [...worst(deepest), ...worst(of("work_rate"))];
}

function wearSection() {
  const { answers, seeds, supports } = DATA.wear;
  const over = DATA.wear.over && {
    name: DATA.wear.over.name,
    columns: wearColumns(tableOf(DATA.wear.over.years)),
  };
  // A name stays as it is.
  const capitalised = (answer) =>
    supports.some(({ name }) => answer.startsWith(name)) ? answer : answer.charAt(0).toUpperCase() + answer.slice(1);
  const table = tableOf(DATA.wear.years);
  const columns = wearColumns(table);
  const measures = Object.keys(columns).filter((name) => name !== "year" && !isHalfWidth(name));
  const { limit } = DATA.draws;
  const marks = (unit) => (limit && unit === "mm" ? [{ y: 1e3 * limit, dash: [6, 4], label: "limit of depths" }] : []);
  const tell = (i) =>
    [
      `${digits(columns.year[i], 4)} years`,
      ...measures.map((name) => `${columnLabel(name)}: ${withInterval(columns, name, i)}`),
    ].join("\n");
  section(
    "wear",
    "Wear over the years",
    seeds > 1
      ? `Means over ${seeds} histories, and as bands their 95 % intervals, by Student's t.`
      : "One history: without random loads and a start that scatters all are the same.",
    el("ul", {}, answers.map((answer) => el("li", {}, capitalised(answer)))),
    measureCurves(columns, "year", measures, tell, () => {}, { over, first: firstOfWear(columns, measures), marks }),
  );
  const rows = Array.from({ length: columns.year.length }, (_, i) => i);
  const cell = (name) => ({
    name: columnLabel(name),
    value: (i) => columns[name][i],
    show: (i) => withInterval(columns, name, i),
  });
  section(
    "years",
    "Years",
    null,
    sortable(
      [
        { name: "Year", value: (i) => columns.year[i], show: (i) => digits(columns.year[i], 4) },
        ...measures.map(cell),
      ],
      rows,
      { height: 60 + ROW * Math.min(rows.length, 16) },
    ),
  );
}
