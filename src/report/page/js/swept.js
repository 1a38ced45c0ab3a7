// What a sweep varied, over what range, and what was found, in one sentence.

/** Measures whose extremes the sentence tells. */
const TOLD_MEASURES = 2;
/** Attractors whose shares it tells. */
const TOLD_ATTRACTORS = 3;
/** Instants of a row that are nearer than this share of all their values are the same. */
const SAME_INSTANT = 1e-3;

/** The name and the unit of a column within a sentence: ["frequency", " Hz"]. */
function nameAndUnit(column) {
  const [, name, unit] = /^(.*?)(?: \(([^()]*)\))?$/.exec(columnLabel(column));
  return [name.charAt(0).toLowerCase() + name.slice(1), unit ? ` ${unit}` : ""];
}

/** An axis with its range: "frequency from 4 to 5.5 Hz, 301 values". */
function axisInWords({ column }, columns) {
  const [name, unit] = nameAndUnit(column);
  const values = Array.isArray(columns[column]) ? undefined : extent(columns[column]);
  // Of a random design each row has one of its own.
  const count = new Set(columns[column]).size;
  const number = `${count} value${count === 1 ? "" : "s"}`;
  const n = values && digitsApart(values);
  const range = values && values[1] > values[0] ? ` from ${digits(values[0], n)} to ${digits(values[1], n)}${unit}` : "";
  return `${name}${range}, ${number}`;
}

/** The least and the largest value of a measure, and over one axis where they are. */
function extremesInWords(measure, columns, axes) {
  const span = extent(columns[measure]);
  const [name, unit] = nameAndUnit(measure);
  if (!span) return null;
  const [axis] = axes;
  // As of the speed of impacts where there is none.
  const missing = Array.from(columns[measure]).filter(Number.isNaN).length;
  const none = missing ? `, none at ${missing} value${missing === 1 ? "" : "s"}` : "";
  const everywhere = missing ? "wherever there is one" : "everywhere";
  if (!(span[1] - span[0] > ROUNDING * Math.max(...span.map(Math.abs))))
    return `${name} ${digits(span[0])}${unit} ${everywhere}${none}`;
  const at = (value) => {
    if (axes.length > 1 || Array.isArray(columns[axis.column])) return "";
    const where = columns[axis.column][columns[measure].indexOf(value)];
    return ` (at ${digits(where, digitsApart(columns[axis.column]))}${nameAndUnit(axis.column)[1]})`;
  };
  return `${name} ${digits(span[0])}${at(span[0])} to ${digits(span[1])}${unit}${at(span[1])}${none}`;
}

/** How many starts lead to which attractor. */
function attractorsInWords(attractors) {
  const { columns, rows, short } = attractors;
  const largest = [...rows].sort((i, j) => columns.share[j] - columns.share[i]);
  const told = largest.slice(0, TOLD_ATTRACTORS).map((i) => `${digits(100 * columns.share[i], 3)} % to ${short(i)}`);
  const number = `${rows.length} attractor${rows.length === 1 ? "" : "s"}`;
  return `the starts lead to ${number}: ${told.join(", ")}${rows.length > told.length ? ", …" : ""}`;
}

/** The values that the instants of a row return to, or null where they do not within those kept. */
function repeated(values, width) {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  const kept = sorted.filter((y, k) => !k || y - sorted[k - 1] > width);
  return kept.length <= sorted.length / 2 ? kept : null;
}

/** Where rows of rising and of falling values lead to different motions that repeat. */
function directionsInWords(table, samples, axis) {
  const { columns } = table;
  if (!samples || !bothDirections(columns.direction)) return null;
  const instants = samples.columns[sampledColumn(samples)];
  const [least, most] = extent(instants) || [0, 0];
  const width = SAME_INSTANT * (most - least);
  const byRow = new Map();
  samples.columns.row.forEach((row, k) => byRow.set(row, [...(byRow.get(row) || []), instants[k]]));
  const pairs = new Map();
  for (const i of table.rows) {
    const pair = pairs.get(columns[axis][i]) || {};
    pair[columns.direction[i]] = repeated(byRow.get(columns.row[i]) || [], width);
    pairs.set(columns[axis][i], pair);
  }
  const whole = [...pairs].filter(([, { up, down }]) => up && down);
  const differ = ({ up, down }) =>
    up.length !== down.length || up.some((y, k) => Math.abs(y - down[k]) > 2 * width);
  const apart = whole.filter(([, pair]) => differ(pair)).map(([value]) => value);
  const unit = nameAndUnit(axis)[1];
  const open = pairs.size - whole.length;
  const unlike = apart.length
    ? `up and down lead to different motions at ${apart.length} values, ${extent(apart).map((x) => digits(x)).join(" to ")}${unit}`
    : "up and down lead to the same motions";
  const [rest, stay] = [whole.length ? unlike : null, `at ${open} values motions do not repeat within what was kept`];
  return [rest, open ? stay : null].filter((part) => part).join("; ");
}

/** How many rows have no result, and what became of them; null where all have one. */
function failedInWords({ columns, count }) {
  const states = columns.status || [];
  const failed = [...new Set(states)].filter((status) => status !== "ok");
  const number = (status) => states.filter((one) => one === status).length;
  return failed.length ? failed.map((status) => `${number(status)} of ${count} rows are ${status}`).join(", ") : null;
}

/** The sentence that heads the page of a sweep. */
function sweptInWords(table, measures, attractors, samples, axisColumns) {
  const { axes, effects } = DATA.sweep;
  const { columns } = table;
  const many = axes.length > 2;
  const varied = many
    ? `${axes.length} keys varied: ${axes.map(({ column }) => nameAndUnit(column)[0]).join(", ")}`
    : axes.map((axis) => axisInWords(axis, columns)).join("; ");
  const told = effects || many ? [] : measures.slice(0, TOLD_MEASURES);
  const found = [
    attractors && columns.attractor ? attractorsInWords(attractors) : null,
    ...(attractors ? [] : told.map((name) => extremesInWords(name, columns, axes))),
    axisColumns.length === 1 ? directionsInWords(table, samples, axisColumns[0]) : null,
    failedInWords(table),
  ].filter((part) => part);
  return found.length ? `${varied}: ${found.join("; ")}` : varied;
}
