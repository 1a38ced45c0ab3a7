// The measures of a sweep over one axis: curves, with those of another sweep beneath.

/** The place that a column of a measure is about, by its name; undefined where it is about none. */
const placeOfColumn = (column) =>
  PLACES.find((place) => `${column}_`.includes(`_${place.replace(/-/g, "_")}_`));

/** Markers of rising and falling values. */
const DIRECTION_MARKERS = { up: "triangle", down: "down" };

/** A bend of a curve of more than this share of its range is where something happens. */
const BEND = 0.03;

/** The numbers of the values of a list, from the least on. */
const orderOf = (x) => Array.from(x, (_, i) => i).sort((i, j) => x[i] - x[j]);

/** The values of the axis about which a measure does not go on as beside it. */
function eventful(columns, axis, measures) {
  const found = [];
  const order = orderOf(columns[axis]);
  const x = order.map((i) => columns[axis][i]);
  for (const name of measures) {
    const y = order.map((i) => columns[name][i]);
    const [least, most] = extent(y) || [0, 0];
    for (let k = 1; k + 1 < x.length; k++) {
      const share = (x[k] - x[k - 1]) / (x[k + 1] - x[k - 1] || 1);
      const bend = y[k] - (y[k - 1] + share * (y[k + 1] - y[k - 1]));
      // A value of −∞, or one that is missing, does not go on as beside it either.
      if (!(Math.abs(bend) <= BEND * (most - least))) found.push(x[k - 1], x[k + 1]);
    }
  }
  return found;
}

/** So few rows are all shown at first. */
const FEW_ROWS = 20;

/** The stretch of the axis that is shown first: where something happens, if that is a part of it. */
function firstView(columns, axis, measures, over = null) {
  const ends = extent([...columns[axis], ...(over ? over.columns[axis] : [])]) || [0, 1];
  const log = isGeometric(distinct(columns[axis]));
  const beside = (ends[1] / ends[0]) ** 0.03;
  const view = log
    ? new View(ends[0] / beside, ends[1] * beside, log)
    : new View(...padded(ends[1] > ends[0] ? ends : [ends[0] - 1, ends[0] + 1], 0.03));
  const few = columns[axis].length <= FEW_ROWS;
  view.part = !few && view.beginAbout(eventful(columns, axis, measures));
  return view;
}

/** The stretch that is shown of an axis, of its whole range: "1 to 4.5 of 1 to 10 Hz". */
function partInWords(view, values, axis) {
  const ends = extent(values);
  const range = (stretch) => stretch.map((x) => digits(clamp(x, ...ends), 3)).join(" to ");
  return `${range([view.lo, view.hi])} of ${range(ends)}${nameAndUnit(axis)[1]}`;
}

/** The words with which all these names begin: of measures at several places what is measured. */
function sharedWords(names) {
  const all = names.map((name) => name.split(" "));
  const differs = all[0].findIndex((word, k) => all.some((words) => words[k] !== word));
  return all[0].slice(0, differs < 0 ? all[0].length : differs).join(" ");
}

/**
 * Measures over one axis, those of one unit in one plot; all plots show one stretch of it. Options:
 * over (another sweep), view, first (the names of those that are shown at first), marks(unit).
 */
function measureCurves(columns, axis, measures, tell, pick, options = {}) {
  const { over = null, view = firstView(columns, axis, measures), first = null, marks = () => [] } = options;
  const unitOf = (name) => (/\((.*)\)$/.exec(columnLabel(name)) || ["", ""])[1];
  const units = [...new Set(measures.map(unitOf))];
  // From left to right, also where the values fall.
  const rows = orderOf(columns[axis]);
  // Up and down are curves of their own colours; else a measure of a place has the place's colour.
  const directions = bothDirections(columns.direction) ? ["up", "down"] : [undefined];
  const itemOf = (name, n) => {
    const place = placeOfColumn(name);
    const own = lookOf(n);
    const colour =
      directions.length > 1 ? () => ink.ink : place ? () => placeColour(place) : own.colour;
    return { label: columnLabel(name), look: { ...own, colour }, shown: first ? first.includes(name) : n < 6, name };
  };
  const curve = (item, direction) => {
    const along = rows.filter((i) => !direction || columns.direction[i] === direction);
    return {
      kind: rows.length > 120 ? "line" : "marked",
      look: { ...item.look, marker: DIRECTION_MARKERS[direction] || item.look.marker },
      colour: direction && (() => directionColour(direction)),
      infinite: true,
      name: item.name,
      rows: along,
      x: along.map((i) => columns[axis][i]),
      y: along.map((i) => columns[item.name][i]),
      hidden: () => !item.shown,
    };
  };
  /** The same measure of the other sweep: thin and pale, in its colour; up and down by themselves. */
  const theirs = over && bothDirections(over.columns.direction) ? ["up", "down"] : [undefined];
  const paleCurve = (item, direction) => {
    const [x, y] = [over.columns[axis], over.columns[item.name]];
    const along = orderOf(x).filter((i) => !direction || over.columns.direction[i] === direction);
    const look = { ...item.look, dash: [], width: 3, behind: true };
    const series = { kind: "line", look, alpha: 0.4, hidden: () => !item.shown };
    return { ...series, x: along.map((i) => x[i]), y: along.map((i) => y[i]) };
  };
  const plotsOf = (unit) => {
    const items = measures.filter((name) => unitOf(name) === unit).map(itemOf);
    if (!items.some(({ shown }) => shown)) items[0].shown = true;
    if (first) items.sort((a, b) => b.shown - a.shown);
    const shared = items.filter(({ name }) => over && over.columns[name] && !Array.isArray(over.columns[name]));
    const series = items.flatMap((item) => directions.map((direction) => curve(item, direction)));
    const bands = series.map((s) => bandOf(s, halfWidthsOf(columns, s.name))).filter((band) => band);
    const y = items.length > 1 ? unit || sharedWords(items.map(({ label }) => label)) || "Number" : items[0].label;
    const plot = new Plot({
      x: columnLabel(axis),
      y,
      height: 300,
      alt: `${y} over ${columnLabel(axis)}`,
      view,
      log: [view.log, false],
      marks: marks(unit),
      series: [...shared.flatMap((item) => theirs.map((one) => paleCurve(item, one))), ...bands, ...series],
    });
    const points = () =>
      series
        .filter((s) => !s.hidden())
        .flatMap((s) => s.rows.map((i, k) => ({ x: s.x[k], y: s.y[k], i })));
    tellNearest(plot, points, ({ i }) => tell(i));
    plot.click = () => plot.found && pick(plot.found.i);
    return [items.length > 1 ? chips(items, () => plot.redraw()) : null, plot.box];
  };
  return el(
    "div",
    {},
    directions.length > 1 || over
      ? el("div", { class: "bar" }, directions.length > 1 ? directionKeys() : null, over ? overKey(over) : null)
      : null,
    el(
      "div",
      { class: "bar controls" },
      button("All values", () => view.set(...view.full), "Whole range"),
      el(
        "span",
        { class: "right help" },
        view.part ? firstShown(view, `${partInWords(view, columns[axis], axis)}, where curves bend`) : null,
        "drag to zoom · double click for all",
      ),
    ),
    units.flatMap(plotsOf),
  );
}
