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

/** The rows of a measure that has the value `value`, up to rounding. */
const rowsWith = (values, value) =>
  Array.from(values.keys()).filter((i) => Math.abs(values[i] - value) <= ROUNDING * Math.abs(value));

/** Where a measure has an extreme value: at one place, or between which ones; "" where its interval
 *  does not tell it from another row, and where rows have more than two keys. */
function placeInWords(measure, value, columns, axes) {
  const values = columns[measure];
  const rows = rowsWith(values, value);
  const half = halfWidthsOf(columns, measure);
  const apart = (i) => !(Math.abs(values[i] - value) <= half[i] + half[rows[0]]);
  if (half && ![...values.keys()].every((i) => rows.includes(i) || Number.isNaN(values[i]) || apart(i))) return "";
  if (axes.length > 2 || axes.some(({ column }) => Array.isArray(columns[column]))) return "";
  const at = ({ column }, i) =>
    `${digits(columns[column][i], digitsApart(columns[column]))}${nameAndUnit(column)[1]}`;
  const direction = bothDirections(columns.direction) && rows.length === 1 ? `, ${columns.direction[rows[0]]}` : "";
  const places = new Set(rows.map((i) => axes.map((axis) => at(axis, i)).join(", ")));
  if (places.size === 1) return ` (at ${[...places][0]}${direction})`;
  if (axes.length > 1) return ` (in ${rows.length} rows)`;
  const ends = extent(rows.map((i) => columns[axes[0].column][i]));
  const shown = ends.map((x) => digits(x, digitsApart(columns[axes[0].column]))).join(" to ");
  return ` (at ${places.size} values, ${shown}${nameAndUnit(axes[0].column)[1]})`;
}

/** The least and the largest value of a measure, and where they are. */
function extremesInWords(measure, columns, axes) {
  const span = extent(columns[measure]);
  const [name, unit] = nameAndUnit(measure);
  if (!span) return `${name} nowhere`;
  // As of the speed of impacts where there is none.
  const missing = Array.from(columns[measure]).filter(Number.isNaN).length;
  const none = missing ? `, none at ${missing} value${missing === 1 ? "" : "s"}` : "";
  const everywhere = missing ? "wherever there is one" : "everywhere";
  if (!(span[1] - span[0] > ROUNDING * Math.max(...span.map(Math.abs))))
    return `${name} ${digits(span[0])}${unit} ${everywhere}${none}`;
  const n = digitsApart(span);
  const [least, most] = span.map((value) => {
    const half = (halfWidthsOf(columns, measure) || [])[rowsWith(columns[measure], value)[0]];
    return [half > 0 ? plusMinus(value, half) : digits(value, n), placeInWords(measure, value, columns, axes)];
  });
  return `${name} ${least[0]}${least[1]} to ${most[0]}${unit}${most[1]}${none}`;
}

/** How many starts lead to which attractor, and how many to none that was found. */
function attractorsInWords(attractors, numbers) {
  const { columns, rows, short } = attractors;
  const largest = [...rows].sort((i, j) => columns.share[j] - columns.share[i]);
  const told = largest.slice(0, TOLD_ATTRACTORS).map((i) => `${digits(100 * columns.share[i], 3)} % to ${short(i)}`);
  const number = `${rows.length} attractor${rows.length === 1 ? "" : "s"}`;
  const lost = Array.from(numbers).filter((one) => !(one >= 1)).length;
  const undecided = `; of ${digits((100 * lost) / numbers.length, 3)} % none was found: more periods to settle and to keep may decide them`;
  return `the starts lead to ${number}: ${told.join(", ")}${rows.length > told.length ? ", …" : ""}${lost ? undecided : ""}`;
}

/** The values that the instants of a row return to, or null where they do not within those kept. */
function repeated(values, width) {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  const kept = sorted.filter((y, k) => !k || y - sorted[k - 1] > width);
  return kept.length <= sorted.length / 2 ? kept : null;
}

/** Measures of rising and of falling values that differ by less than this share agree. */
const SAME_MEASURE = 0.01;

/** At how many values, and between which, something holds: "15 of 91 values, between 1 and 4.5 Hz". */
function valuesInWords(found, count, axis) {
  const ends = extent(found).map((x) => digits(x));
  const where = ends[0] === ends[1] ? `at ${ends[0]}` : `between ${ends.join(" and ")}`;
  return `${found.length} of ${count} values, ${where}${nameAndUnit(axis)[1]}`;
}

/** Where measures of rising and of falling values differ; null where a sweep has no instants to tell
 *  by whether the motions repeat. */
function measuresApartInWords({ columns, rows }, measures, axis) {
  const pairs = new Map();
  for (const i of rows) pairs.set(columns[axis][i], { ...pairs.get(columns[axis][i]), [columns.direction[i]]: i });
  const apart = (values, { up, down }) =>
    Math.abs(values[up] - values[down]) > SAME_MEASURE * Math.max(Math.abs(values[up]), Math.abs(values[down]));
  const found = measures.map((name) => {
    const where = [...pairs].filter(([, pair]) => apart(columns[name], pair)).map(([value]) => value);
    const text = where.length && `up and down differ by more than 1 % in ${nameAndUnit(name)[0]} at ${valuesInWords(where, pairs.size, axis)}`;
    return [where.length, text];
  });
  const [count, text] = found.sort((a, b) => b[0] - a[0])[0] || [0];
  return count ? `${text} (two motions, or ones that do not repeat)` : "up and down agree to 1 %";
}

/** Where rows of rising and of falling values lead to different motions that repeat. */
function directionsInWords(table, samples, measures, axis) {
  const { columns } = table;
  if (!bothDirections(columns.direction)) return null;
  if (!samples) return measures.length ? measuresApartInWords(table, measures, axis) : null;
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
  const open = pairs.size - whole.length;
  const unlike = apart.length
    ? `up and down lead to different motions at ${valuesInWords(apart, pairs.size, axis)}`
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
  const told = effects ? [] : measures.slice(0, TOLD_MEASURES);
  const found = [
    attractors && columns.attractor ? attractorsInWords(attractors, columns.attractor) : null,
    ...(attractors ? [] : told.map((name) => extremesInWords(name, columns, axes))),
    axisColumns.length === 1 ? directionsInWords(table, samples, attractors ? [] : measures, axisColumns[0]) : null,
    failedInWords(table),
  ].filter((part) => part);
  return found.length ? `${varied}: ${found.join("; ")}` : varied;
}
