// Where along the structure its supports wear: a bar at the place of each, with its interval.

/** What is drawn: the measure of realisations, its label, and [value, half width] of one run. */
const WHERE_MEASURES = [
  [
    "work_rate",
    "Work rate (W)",
    ({ worn }) => [worn.work_rate_w, worn.work_rate_half_width_95_w],
  ],
  [
    "mean_force",
    "Mean force (N)",
    ({ contact: { force } }) => [force?.mean_n, force?.mean_half_width_95_n],
  ],
  [
    "rms_force",
    "RMS force (N)",
    ({ contact: { force } }) => [force?.rms_n, force?.rms_half_width_95_n],
  ],
];

/** Supports that have a position along the structure: where there are two or more. One between two
 *  bodies stands on both. */
function placedSupports() {
  const { supports, statistics } = DATA.summary;
  const placed = DATA.scene.supports.flatMap(({ name, at }) => {
    const worn = (supports || []).find(({ support }) => support === name);
    const contact = statistics.supports.find(({ support }) => support === name);
    const places = [at, at && at.body && at.relative_to].filter((place) => place);
    return places.map(({ body, position }) => ({ name, body, position, worn, contact }));
  });
  const known = placed.filter(({ position, worn, contact }) => position >= 0 && worn && contact);
  return known.length > 1 ? known.sort((a, b) => a.position - b.position) : [];
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

function whereSection() {
  const supports = placedSupports();
  if (!supports.length) return;
  const choice = { index: 0 };
  const box = el("div");
  const build = () => {
    dropPlots(box);
    const measure = WHERE_MEASURES[choice.index];
    const bodies = DATA.scene.bodies.length ? DATA.scene.bodies : [DATA.scene];
    const plots = bodies.map(({ name, length }) => {
      const here = supports.filter(({ body }) => body === name);
      return here.length ? wherePlot(here, measure, name, length) : null;
    });
    box.replaceChildren(...plots.filter((plot) => plot));
    refreshAll();
  };
  const names = WHERE_MEASURES.map(([, label], i) => [String(i), label]);
  section(
    "where",
    "Where",
    DATA.summary.realisations
      ? "The means over the realisations at each support along the structure, with their 95 % intervals."
      : "Each support along the structure, with the 95 % interval of its mean over time where it has one.",
    el(
      "div",
      { class: "bar controls" },
      segmented("Measure", names, "0", (i) => {
        choice.index = +i;
        build();
      }),
    ),
    box,
  );
  build();
}

/** Bars at the supports over the line of the structure, or of one of its bodies. */
function wherePlot(supports, measure, body, ownLength) {
  const values = supports.map((support) => valueWhere(support, measure));
  const ends = values.flatMap(([value, half]) => [value - (half || 0), value + (half || 0)]);
  const highest = Math.max(0, ...ends.filter(Number.isFinite));
  const last = supports[supports.length - 1].position;
  const length = ownLength > 0 ? ownLength : last + supports[0].position;
  const draw = (ctx, plot) => {
    const floor = plot.sy(0);
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
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
      ctx.fillText(name, x, top - 4);
    });
    ctx.strokeStyle = ink.wall;
    ctx.lineWidth = 4;
    ctx.beginPath();
    ctx.moveTo(plot.sx(0), floor);
    ctx.lineTo(plot.sx(length), floor);
    ctx.stroke();
  };
  const told = supports.map(({ name, position }, i) => {
    const [value, half] = values[i];
    return `${name} at ${digits(position)} m: ${plusMinus(value, half || null)}`;
  });
  const plot = new Plot({
    x: `Position along ${body || "the structure"} (m)`,
    y: measure[1],
    height: 260,
    left: 80,
    alt: `${measure[1]} at each support: ${told.join("; ")}`,
    range: () => [-0.04 * (highest || 1), 1.25 * (highest || 1)],
    series: [{ kind: "own", look: lookOf(0), x: [0, length], y: [], draw }],
  });
  return plot.box;
}
