// Where along the structure its supports wear: a bar at the place of each, with its interval.

/** What is drawn of a run: the measure of realisations, its label, and [value, half width]. */
const WHERE_MEASURES = [
  [
    "work_rate",
    "Work rate (W)",
    ({ worn }) => [worn.work_rate_w, worn.work_rate_half_width_95_w],
  ],
  [
    "force_mean",
    "Mean force (N)",
    ({ contact: { force } }) => [force?.mean_n, force?.mean_half_width_95_n],
  ],
  [
    "force_rms",
    "RMS force (N)",
    ({ contact: { force } }) => [force?.rms_n, force?.rms_half_width_95_n],
  ],
];

/** What is drawn of wear over the years: the quantity of years.csv, its unit, and its label. */
const WHERE_WORN = [
  ["depth_deepest", "m", "Deepest wear (mm)", 1e3],
  ["depth_all_round", "m", "Wear all round (mm)", 1e3],
  ["gap", "m", "Gap (mm)", 1e3],
  ["work_rate", "W", "Work rate (W)", 1],
];

/** Supports that have a position along the structure, of those that are `known`: where there are
 *  two or more, or a line that is drawn to its ends. One between two bodies stands on both. */
function placedSupports(known) {
  const placed = DATA.scene.supports.flatMap(({ name, at }) => {
    const places = [at, at && at.body && at.relative_to].filter((place) => place);
    return places.map(({ body, position }) => ({ ...known(name), name, body, position }));
  });
  const there = placed.filter(({ position, name }) => position >= 0 && known(name));
  return there.length > 1 || (there.length && DATA.scene.ends)
    ? there.sort((a, b) => a.position - b.position)
    : [];
}

/** The supports of a run with their statistics. */
function supportsOfRun() {
  const { supports, statistics } = DATA.summary;
  return placedSupports((name) => {
    const worn = (supports || []).find(({ support }) => support === name);
    const contact = statistics.supports.find(({ support }) => support === name);
    return worn && contact && { worn, contact };
  });
}

/** The value of a measure at a support and the half width of its interval: the mean over the
 *  realisations, where there are several. */
function valueWhere(support, [measure, , ofRun]) {
  const { realisations } = DATA.summary;
  if (!realisations) return ofRun(support);
  const mean = realisations.estimates.find(
    (one) => one.place === support.name && one.measure === measure,
  );
  return mean ? [mean.mean, mean.half_width_95] : [NaN, NaN];
}

/** Where the supports of a run wear. */
function whereSection() {
  const supports = supportsOfRun();
  const many = DATA.summary.realisations;
  const around = many ? sectorParts() : null;
  if (!supports.length && !around) return;
  const measures = WHERE_MEASURES.map((measure) => ({
    label: measure[1],
    of: (support) => valueWhere(support, measure),
  }));
  section(
    "where",
    "Where",
    many
      ? "The means over the realisations at each support along the structure, with their 95 % intervals." +
          (around ? " Around each support: the means of each sector, with theirs" : "") +
          (around && many.worn?.length ? "; depths are those within the service." : around ? "." : "")
      : "Each support along the structure, with the 95 % interval of its mean over time where it has one.",
    alongParts(supports, measures),
    around,
  );
}

/** Where wear is at the end of a study over the years. */
function wornWhereSection() {
  const { columns, rows } = tableOf(DATA.wear.years);
  const lastOf = (name) => rows.filter((i) => columns.place[i] === name).pop();
  const supports = placedSupports((name) => lastOf(name) !== undefined && {});
  const around = sectorParts();
  if (!supports.length && !around) return;
  const limit = 1e3 * DATA.draws.limit;
  const measures = WHERE_WORN.map(([quantity, unit, label, factor]) => ({
    label,
    limit: quantity === "depth_deepest" && limit > 0 ? limit : null,
    of: ({ name }) =>
      [`${quantity}_${unit}`, `${quantity}_half_width_95_${unit}`].map(
        (column) => factor * (columns[column] || [])[lastOf(name)],
      ),
  }));
  const year = columns.year[rows[rows.length - 1]];
  const mean = DATA.wear.seeds > 1 ? ", in the mean over the histories with 95 % intervals" : "";
  section(
    "where",
    "Where",
    `At the end of the study, after ${digits(year)} years${mean}: along the structure, and what the tube has lost in each direction around each support.`,
    alongParts(supports, measures),
    around,
  );
}

/** Bars along the structure, of the measure that is chosen. */
function alongParts(supports, measures) {
  if (!supports.length) return null;
  const box = el("div");
  const build = (measure) => {
    dropPlots(box);
    const bodies = DATA.scene.bodies.length ? DATA.scene.bodies : [DATA.scene];
    const plots = bodies.map(({ name, ends }) => {
      const here = supports.filter(({ body }) => body === name);
      return here.length ? wherePlot(here, measure, name, ends) : null;
    });
    box.replaceChildren(...plots.filter((plot) => plot));
    refreshAll();
  };
  const names = measures.map(({ label }, i) => [String(i), label]);
  const choose = segmented("Measure", names, "0", (i) => build(measures[+i]));
  build(measures[0]);
  return [el("div", { class: "bar controls" }, choose), box];
}

/** Bars at the supports over the line of the structure, or of one of its bodies. */
function wherePlot(supports, { label, limit, of }, body, ownEnds) {
  const values = supports.map(of);
  const ends = values.flatMap(([value, half]) => [value - (half || 0), value + (half || 0)]);
  const most = Math.max(0, ...ends.filter(Number.isFinite));
  const shown = limit && limit < LIMIT_NEAR * most ? limit : null;
  const highest = Math.max(most, shown || 0);
  const last = supports[supports.length - 1].position;
  const [first, length] = ownEnds || [0, last + supports[0].position];
  const draw = (ctx, plot) => {
    const floor = plot.sy(0);
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
    const names = [];
    supports.forEach(({ name, position }, i) => {
      const [value, half] = values[i];
      if (!Number.isFinite(value)) return;
      const [x, y] = [plot.sx(position), plot.sy(value)];
      ctx.fillStyle = placeColour(name);
      ctx.fillRect(x - 11, y, 22, floor - y);
      ctx.strokeStyle = ctx.fillStyle = ink.ink;
      ctx.lineWidth = 1.4;
      const top = half > 0 ? plot.sy(value + half) : y;
      if (half > 0) {
        const bottom = plot.sy(Math.max(0, value - half));
        ctx.beginPath();
        for (const edge of [top, bottom]) {
          ctx.moveTo(x - 5, edge);
          ctx.lineTo(x + 5, edge);
        }
        ctx.moveTo(x, top);
        ctx.lineTo(x, bottom);
        ctx.stroke();
      }
      names.push({ name, value, x, y: top - 4, half: ctx.measureText(name).width / 2 + 3 });
    });
    // Where there is no room for all names, those of the highest bars.
    const placed = [];
    const meets = (a, b) => Math.abs(a.x - b.x) < a.half + b.half && Math.abs(a.y - b.y) < 16;
    for (const one of names.sort((a, b) => b.value - a.value)) {
      if (placed.some((other) => meets(one, other))) continue;
      placed.push(one);
      ctx.fillStyle = clear(ink.paper, 0.7);
      ctx.fillRect(one.x - one.half, one.y - 14, 2 * one.half, 15);
      ctx.fillStyle = ink.ink;
      ctx.fillText(one.name, one.x, one.y);
    }
    ctx.strokeStyle = ink.wall;
    ctx.lineWidth = 4;
    ctx.beginPath();
    ctx.moveTo(plot.sx(first), floor);
    ctx.lineTo(plot.sx(length), floor);
    ctx.stroke();
  };
  const told = supports.map(({ name, position }, i) => {
    const [value, half] = values[i];
    return `${name} at ${digits(position)} m: ${plusMinus(value, half || null)}`;
  });
  const plot = new Plot({
    x: `Position along ${body || "the structure"} (m)`,
    y: label,
    height: 260,
    left: 80,
    alt: `${label} at each support: ${told.join("; ")}`,
    range: () => [-0.04 * (highest || 1), 1.25 * (highest || 1)],
    series: [{ kind: "own", look: lookOf(0), x: [first, length], y: [], draw }],
    marks: shown ? [{ y: shown, label: "limit" }] : [],
  });
  return plot.box;
}
