// Basins: which attractor each start leads to, in the colours of the SVG picture.

/** Tones of the first attractors, and of all others: those of the SVG picture, in both themes. */
const ATTRACTOR_TONES = [
  [247, 247, 247],
  [181, 207, 230],
  [220, 154, 51],
  [192, 69, 42],
  [75, 35, 87],
  [17, 17, 17],
];
const OTHER_TONE = [127, 169, 140];
const NO_TONE = [128, 128, 128];

/** Contacts of a signature that is written whole in the legend. */
const SHORT = 2;

/** The attractors of a sweep that tells them, by their numbers; null without. */
function readAttractors() {
  if (!DATA.sweep.attractors) return null;
  const table = tableOf(DATA.sweep.attractors);
  const { columns } = table;
  const byNumber = new Map(Array.from(columns.attractor, (number, i) => [number, i]));
  const word = (name, i) => {
    const value = columns[name] && columns[name][i];
    return value === undefined || Number.isNaN(value) ? "" : String(value);
  };
  const periods = (i) => {
    const count = columns.period[i];
    return count > 1 ? `, ${count} periods` : "";
  };
  const short = (i) => {
    const contacts = word("signature", i).split(" ").length;
    return (contacts > SHORT ? `${contacts} contacts` : word("signature", i)) + periods(i);
  };
  return { ...table, byNumber, word, short, long: (i) => word("signature", i) + periods(i) };
}

/** The tone of an attractor by its number; grey for a start without one. */
function attractorTone(number) {
  if (!(number >= 1)) return NO_TONE;
  return ATTRACTOR_TONES[number - 1] || OTHER_TONE;
}

/** What is told of the attractor of a row. */
function attractorText(attractors, number) {
  const i = attractors.byNumber.get(number);
  if (i === undefined) return "leads to no attractor that was found";
  return `leads to attractor ${number}: ${attractors.long(i)}, ${digits(100 * attractors.columns.share[i], 3)} % of the starts`;
}

/** The map of starts by attractor, with its legend. */
function basinMap(columns, [first, second], otherAxes, attractors, tell, pick) {
  const slice = sliceOf(columns, otherAxes, () => plot.refill());
  const plot = cellMap({
    x: columnLabel(first),
    y: columnLabel(second),
    xs: columns[first],
    ys: columns[second],
    shows: slice.shows,
    toneOf: (i) => attractorTone(columns.attractor[i]),
    tell,
    pick,
    height: 520,
    alt: "Basins of attraction",
  });
  const share = (i) => attractors.columns.share[i];
  const own = ATTRACTOR_TONES.map((tone, k) => [tone, attractors.byNumber.get(k + 1)])
    .filter(([, i]) => i !== undefined)
    .map(([tone, i]) =>
      swatch(
        `${attractors.columns.attractor[i]}: ${digits(100 * share(i), 3)} %, ${attractors.short(i)}`,
        () => `rgb(${tone})`,
      ),
    );
  const others = attractors.rows.filter(
    (i) => attractors.columns.attractor[i] > ATTRACTOR_TONES.length,
  );
  if (others.length) {
    const sum = others.reduce((total, i) => total + share(i), 0);
    own.push(
      swatch(`${digits(100 * sum, 3)} %, ${others.length} others`, () => `rgb(${OTHER_TONE})`),
    );
  }
  const lost = Array.from(columns.attractor).filter((number) => !(number >= 1)).length;
  if (lost)
    own.push(
      swatch(
        `${digits((100 * lost) / columns.attractor.length, 3)} %, none found`,
        () => `rgb(${NO_TONE})`,
      ),
    );
  const controls = slice.controls.length ? el("div", { class: "bar controls" }, slice.controls) : null;
  return el("div", {}, controls, el("div", { class: "bar" }, own), plot.box);
}

/** The attractors as a table. */
function attractorSection(attractors) {
  const { columns, rows } = attractors;
  const number = (name, title, n = 4) => ({
    name: title,
    value: (i) => columns[name][i],
    show: (i) => digits(columns[name][i], n),
  });
  const text = (name, title) => ({
    name: title,
    text: true,
    value: (i) => attractors.word(name, i),
    show: (i) => attractors.word(name, i) || "–",
  });
  /** A list of numbers, with fewer digits than the file has. */
  const list = (name, title) => ({
    ...text(name, title),
    show: (i) =>
      attractors
        .word(name, i)
        .replace(/\d+\.\d+(e-?\d+)?/g, (x) => digits(+x))
        .replace(/-/g, "−") || "–",
  });
  section(
    "attractors",
    "Attractors",
    "What the starts lead to; phases in cycles of the load, speeds in m/s.",
    sortable(
      [
        number("attractor", "attractor"),
        number("rows", "starts", 9),
        number("share", "share"),
        text("signature", "signature"),
        number("period", "periods"),
        list("phases_cycles", "phases"),
        list("approach_speeds_m_per_s", "approach speeds"),
        list("multipliers", "multipliers"),
      ],
      rows,
      { height: 60 + ROW * Math.min(rows.length, 14) },
    ),
  );
}
