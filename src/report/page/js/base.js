// The data, elements of the page, numbers as text. Every file of this folder runs in one scope, in
// the order that html.rs lists.

const DATA = JSON.parse(document.getElementById("data").textContent);
const page = document.getElementById("page");
const root = document.documentElement;
const TURN = 2 * Math.PI;

/** Errors of the page, counted for tests: on the root element as data-errors. */
root.dataset.errors = "0";
const countError = () => {
  root.dataset.errors = String(+root.dataset.errors + 1);
};
addEventListener("error", countError);
addEventListener("unhandledrejection", countError);
document.addEventListener("securitypolicyviolation", countError);

/**
 * An element with attributes and children. Strings become text, never markup. `on…` attributes are
 * listeners, `style` is an object of CSS properties (a style attribute is refused by the policy).
 */
function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key === "style") Object.assign(node.style, value);
    else if (value === true) node.setAttribute(key, "");
    else if (value !== null && value !== undefined && value !== false)
      node.setAttribute(key, value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

/** A text of the tool as a sentence. */
const sentence = (text) => `${text[0].toUpperCase()}${text.slice(1)}.`;

/** A text of the tool with the names in it, between backticks, set as such. */
const worded = (text) => text.split("`").map((part, k) => (k % 2 ? el("code", {}, part) : part));

/** A column of the data as an array: typed, or of words. */
function decode(column) {
  if (column === null || column === undefined || Array.isArray(column)) return column;
  if (column.words) return Array.from(decode(column.at), (index) => column.words[index]);
  const kinds = { f64: Float64Array, f32: Float32Array, u32: Uint32Array, i16: Int16Array };
  const kind = Object.keys(kinds).find((key) => column[key] !== undefined);
  const text = atob(column[kind]);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return new kinds[kind](bytes.buffer);
}

/** A table of the data: its columns by name, and the numbers of its rows. */
function tableOf(table) {
  const columns = Object.fromEntries(table.columns.map((c) => [c.name, decode(c.values)]));
  const rows = Array.from({ length: table.rows }, (_, i) => i);
  return { count: table.rows, rows, names: table.columns.map((c) => c.name), columns };
}

const clamp = (x, least, most) => Math.min(Math.max(x, least), most);

/** The index of the last entry of the sorted list that is not beyond x; −1 where all are. */
function before(list, x) {
  let [from, to] = [0, list.length];
  while (from < to) {
    const middle = (from + to) >> 1;
    if (list[middle] <= x) from = middle + 1;
    else to = middle;
  }
  return from - 1;
}

/** The index of the entry of the list that is nearest to x. */
const nearestTo = (list, x) =>
  list.reduce((best, y, i) => (Math.abs(y - x) < Math.abs(list[best] - x) ? i : best), 0);

/** The cubic from a to b with the slopes c and d at its ends, at the share s of its length. */
function cubic(a, b, c, d, s) {
  const r = 1 - s;
  return a * (1 + 2 * s) * r * r + c * s * r * r + b * s * s * (3 - 2 * s) - d * s * s * r;
}

/** Least and largest finite value of a list, or undefined. */
function extent(values) {
  let [least, most] = [Infinity, -Infinity];
  for (const x of values) {
    if (x < least && x !== -Infinity) least = x;
    if (x > most && x !== Infinity) most = x;
  }
  return least <= most ? [least, most] : undefined;
}

/** A range with some room at both ends. */
const padded = ([lo, hi], share) => [lo - share * (hi - lo), hi + share * (hi - lo)];

const minus = (text) => text.replace(/-/g, "−");

/** A whole number as an exponent. */
const raised = (n) => [...String(n)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] || "⁻").join("");

/** A number to n digits, with powers of ten written out. */
function digits(x, n = 4) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x < 0 ? "−∞" : "∞";
  // A count has all its digits.
  if (Number.isInteger(x) && Math.abs(x) < 1e9) return minus(String(x));
  if (Math.abs(x) < 1e5 && Math.abs(x) >= 1e-3) return minus(String(+x.toPrecision(n)));
  const [mantissa, exponent] = x.toExponential(n - 1).split("e");
  return minus(mantissa.replace(/\.?0+$/, "")) + "·10" + raised(+exponent);
}

/** Digits that tell these numbers apart, from four on. */
function digitsApart(values) {
  const all = [...new Set(values)].filter(Number.isFinite);
  const tell = (n) => new Set(all.map((x) => digits(x, n))).size === all.length;
  for (let n = 4; n < 15; n++) if (tell(n)) return n;
  return 15;
}

/** A measure of realisations in words. */
const measureInWords = (name) =>
  ({ force_mean: "mean force", force_rms: "RMS force", force_largest: "largest force" })[name] ||
  name.replace(/_/g, " ").replace(/^force mean ([yz])$/, "mean force along $1");

/** A number with the half width of its interval, where it has one: both end where two digits of the half width end. */
function plusMinus(x, half) {
  if (!(half > 1e-12 * Math.abs(x))) return digits(x);
  const size = Math.floor(Math.log10(Math.max(Math.abs(x), half)));
  const power = size < -3 || size > 4 ? size : 0;
  const decimals = clamp(power + 1 - Math.floor(Math.log10(half)), 0, 20);
  const shown = (value) => minus((value / 10 ** power).toFixed(decimals).replace(/^-(?=[0.]*$)/, ""));
  const both = `${shown(x)} ± ${shown(half)}`;
  return power ? `(${both})·10${raised(power)}` : both;
}

/** A number with a prefixed unit: 0.0031 s becomes 3.1 ms. */
function prefixed(x, unit, n = 3) {
  if (!Number.isFinite(x)) return "–";
  if (x === 0) return `0 ${unit}`;
  const power = clamp(Math.floor(Math.log10(Math.abs(x)) / 3 + 1e-9) * 3, -15, 9);
  const prefix = ["f", "p", "n", "µ", "m", "", "k", "M", "G"][power / 3 + 5];
  return `${minus(String(+(x / 10 ** power).toPrecision(n)))} ${prefix}${unit}`;
}

/** A whole number with its thousands apart. */
const counted = (n) => n.toLocaleString("en").replace(/,/g, " ");

/**
 * The unit in which lengths of about this size (m) are shown, and how many of it are a metre: the
 * motions of structures are millimetres, of a falling ball metres.
 */
function lengthUnit(size) {
  const units = [
    ["m", 1],
    ["mm", 1e3],
    ["µm", 1e6],
    ["nm", 1e9],
  ];
  return units.find(([, factor]) => size * factor >= 0.05) || units[3];
}

/** A word as a POSIX shell takes it. */
const shellWord = (word) =>
  /^[\w=+.,/:@%-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`;

/** Offers a text as a file. */
function save(name, text, type) {
  const link = el("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
}

/** Rows of cells as CSV. */
function csvText(rows) {
  const cell = (value) => {
    const text = value === null || value === undefined || Number.isNaN(value) ? "" : String(value);
    return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return rows.map((row) => row.map(cell).join(",")).join("\n") + "\n";
}
