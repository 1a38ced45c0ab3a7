// Every realisation of a run, or history of wear, alone: a strip of dots for each support, and the
// table with the seeds and the command that makes each.

/** So many strips are drawn at most. */
const MOST_STRIPS = 16;

/** Height of a strip in pixels, and the share of it over which its dots lie. */
const STRIP = [44, 0.56];

/** What the strips of a run show, of realisations.csv: column, label, and the measure of its mean. */
const RUN_STRIPS = [
  ["work_rate_W", "Work rate (W)", "work_rate"],
  ["force_mean_N", "Mean force (N)", "force_mean"],
  ["force_rms_N", "RMS force (N)", "force_rms"],
  ["force_largest_N", "Largest force (N)", "force_largest"],
];

/** The same of histories, of history.csv: column, label, and how many of its unit are one in SI. */
const WEAR_STRIPS = [
  ["depth_deepest_m", "Deepest wear (mm)", 1e3],
  ["depth_all_round_m", "Wear all round (mm)", 1e3],
  ["gap_m", "Gap (mm)", 1e3],
  ["work_rate_W", "Work rate (W)", 1],
];

/** The rows of a place in a table, and the mean of a column with its half width: of realisations. */
function drawsOfRun({ columns, rows }) {
  const supports = rows.some((i) => columns.kind[i] === "support");
  const kind = supports ? "support" : "wall";
  const own = rows.filter((i) => columns.kind[i] === kind);
  const measures = RUN_STRIPS.filter(([column]) => own.some((i) => Number.isFinite((columns[column] || [])[i])));
  return {
    rows: own,
    number: columns.realisation,
    measures: measures.map(([column, label, measure]) => ({
      label,
      value: (i) => columns[column][i],
      mean: (place) => {
        const found = DATA.summary.realisations.estimates.find(
          (one) => one.place === place && one.kind === kind && one.measure === measure,
        );
        return found ? [found.mean, found.half_width_95] : [NaN, NaN];
      },
    })),
  };
}

/** The same of histories at their end. */
function drawsOfWear({ columns, rows }) {
  const years = tableOf(DATA.wear.years);
  const last = columns.year[rows[rows.length - 1]];
  const meanRow = (place) =>
    years.rows.filter((i) => years.columns.place[i] === place && years.columns.year[i] === last)[0];
  return {
    rows: rows.filter((i) => columns.year[i] === last),
    number: columns.history,
    measures: WEAR_STRIPS.map(([column, label, factor]) => ({
      label,
      value: (i) => factor * columns[column][i],
      mean: (place) => {
        const half = column.replace(/_(\w)$/, "_half_width_95_$1");
        return [column, half].map((name) => factor * (years.columns[name] || [])[meanRow(place)]);
      },
    })),
  };
}

/** The command that makes realisation `number` alone, on the case as it was run. */
function commandOf(number, folder) {
  const { seeds, scheme } = DATA.draws;
  const set = seeds.map(({ key, seed }) => `--set ${shellWord(`${key}=${seed + number - 1}`)}`);
  const by = scheme ? ` --scheme ${shellWord(scheme)}` : "";
  return `signorini run ${shellWord(`${DATA.name}.toml`)} ${set.join(" ")}${by} --out ${folder}/${number}`;
}

function realisationsSection() {
  const { table, seeds, notes } = DATA.draws;
  if (!table || !(seeds || []).length) return;
  const known = tableOf(table);
  const { rows, number, measures } = DATA.wear ? drawsOfWear(known) : drawsOfRun(known);
  const count = new Set(rows.map((i) => number[i])).size;
  if (count < 2 || !measures.length) return;
  const one = DATA.wear ? "history" : "realisation";
  const places = [...new Set(rows.map((i) => known.columns.place[i]))];
  const draws = { rows, number, place: known.columns.place, places: places.slice(0, MOST_STRIPS), one };
  const box = el("div");
  const build = (measure) => {
    dropPlots(box);
    box.replaceChildren(stripPlot(draws, measure), meansOfStrips(draws, measure));
    refreshAll();
  };
  const names = measures.map(({ label }, i) => [String(i), label]);
  const choose = segmented("Measure", names, "0", (i) => build(measures[+i]));
  section(
    "realisations",
    DATA.wear ? "Histories" : "Realisations",
    (DATA.wear
      ? "Each history at its end, a dot each, in their order from the top of a strip down; "
      : "Each realisation, a dot each, in their order from the top of a strip down; ") +
      "the line is their mean, the band its 95 % interval, by Student's t." +
      (DATA.wear
        ? " Of the deepest wear each dot is the deepest sector of one history, which is an upper figure, and the line the deepest of their means."
        : "") +
      (places.length > MOST_STRIPS ? ` Of ${places.length} places the first ${MOST_STRIPS}.` : ""),
    (notes || []).length ? el("ul", { class: "notes" }, notes.map((note) => el("li", {}, note))) : null,
    el("div", { class: "bar controls" }, choose),
    box,
    ...seedParts(draws, measures),
  );
  build(measures[0]);
}

/** A strip for each place. */
function stripPlot({ rows, number, place, places, one }, measure) {
  const numbers = [...new Set(rows.map((i) => number[i]))];
  const last = Math.max(1, numbers.length - 1);
  const height = (p, n) => places.length - 1 - p + STRIP[1] * (0.5 - n / last);
  const points = rows
    .filter((i) => places.includes(place[i]) && Number.isFinite(measure.value(i)))
    .map((i) => ({
      i,
      x: measure.value(i),
      y: height(places.indexOf(place[i]), numbers.indexOf(number[i])),
    }));
  const means = places.map((name) => measure.mean(name));
  const band = (ctx, plot) => {
    means.forEach(([mean, half], p) => {
      if (!Number.isFinite(mean)) return;
      const [top, bottom] = [0.5, -0.5].map((side) => plot.sy(places.length - 1 - p + 0.86 * side));
      ctx.fillStyle = ctx.strokeStyle = placeColour(places[p]);
      if (half > 0) {
        ctx.globalAlpha = 0.2;
        ctx.fillRect(plot.sx(mean - half), top, plot.sx(mean + half) - plot.sx(mean - half), bottom - top);
        ctx.globalAlpha = 1;
      }
      ctx.lineWidth = 2.2;
      ctx.beginPath();
      ctx.moveTo(plot.sx(mean), top);
      ctx.lineTo(plot.sx(mean), bottom);
      ctx.stroke();
    });
  };
  const dots = (ctx, plot) => {
    ctx.fillStyle = ink.soft;
    ctx.globalAlpha = 0.85;
    for (const { x, y } of points) {
      ctx.beginPath();
      ctx.arc(plot.sx(x), plot.sy(y), 3.4, 0, TURN);
      ctx.fill();
    }
  };
  const ends = means.flatMap(([mean, half]) => [mean - (half || 0), mean + (half || 0)]);
  const plot = new Plot({
    x: measure.label,
    height: 56 + STRIP[0] * places.length,
    left: 92,
    narrow: 72,
    alt: `${measure.label} of each ${one}, by support`,
    range: () => [-0.6, places.length - 0.4],
    series: [
      { kind: "own", look: { ...lookOf(0), behind: true }, x: ends, y: [], draw: band },
      { kind: "own", look: lookOf(0), x: points.map(({ x }) => x), y: [], draw: dots },
    ],
  });
  plot.yTicks = places.map((name, p) => [places.length - 1 - p, name]);
  tellNearest(
    plot,
    () => points,
    ({ i }) => `${place[i]}, ${one} ${number[i]}\n${measure.label}: ${digits(measure.value(i))}`,
  );
  return plot.box;
}

/** The means of the strips in words. */
const meansOfStrips = ({ places }, measure) =>
  el(
    "p",
    { class: "lead" },
    `${measure.label}, means: ` +
      places.map((name) => `${name} ${plusMinus(...measure.mean(name))}`).join("; ") +
      ".",
  );

/** The table of seeds, with the numbers of the first measure, and the commands. */
function seedParts({ rows, number, place, places, one }, measures) {
  const { seeds } = DATA.draws;
  const numbers = [...new Set(rows.map((i) => number[i]))];
  const [measure] = measures;
  const valueOf = (n, name) => {
    const row = rows.find((i) => number[i] === n && place[i] === name);
    return row === undefined ? NaN : measure.value(row);
  };
  const folder = DATA.wear ? "histories" : "realisations";
  const command = (n) => commandOf(n, folder);
  const shown = el("pre", { class: "command" });
  const pick = (n) => {
    shown.textContent = command(n);
  };
  pick(numbers[0]);
  const seed = ({ key, seed: first }) => ({
    name: key,
    value: (n) => first + n - 1,
    show: (n) => String(first + n - 1),
  });
  return [
    el("h3", {}, "Seeds"),
    el(
      "p",
      { class: "lead" },
      (DATA.wear
        ? "The first year of each history, in the gaps of the start, is a run with these seeds; each later window has seeds of its own. "
        : "") +
        `The command makes one of them alone, with every figure of a run, in the folder of this page, where ${DATA.name}.toml is what "Save the case" below gives. Click a row for its command.`,
    ),
    sortable(
      [
        { name: one, value: (n) => n, show: (n) => String(n) },
        ...seeds.map(seed),
        ...places.slice(0, 8).map((name) => ({
          name: `${name}: ${measure.label.charAt(0).toLowerCase()}${measure.label.slice(1)}`,
          value: (n) => valueOf(n, name),
          show: (n) => digits(valueOf(n, name)),
        })),
        wordColumn("command", command),
      ],
      numbers,
      { height: 60 + ROW * Math.min(numbers.length, 10), pick },
    ),
    shown,
  ];
}
