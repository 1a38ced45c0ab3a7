// The picture of branches over the key.

/** Where all special points span the picture, it begins on the shortest stretch with this share. */
const MOST_OF_SPECIALS = 0.75;

/** An axis that does not begin at 0 leaves out at least this share of the largest value. */
const FAR_FROM_FLOOR = 0.5;

/** The values between lo and hi, those of lines where they leave this stretch too. */
function valuesWithin([lo, hi], lines, marks) {
  const seen = marks.filter(({ x }) => x >= lo && x <= hi).map(({ y }) => y);
  for (const { x, y } of lines) {
    for (let k = 0; k < x.length; k++) {
      if (x[k] >= lo && x[k] <= hi) seen.push(y[k]);
      for (const edge of k ? [lo, hi] : [])
        if ((x[k - 1] - edge) * (x[k] - edge) < 0)
          seen.push(y[k - 1] + ((y[k] - y[k - 1]) * (edge - x[k - 1])) / (x[k] - x[k - 1]));
    }
  }
  return seen;
}

/** The range of a measure about what is seen of it between the ends of `view`. */
function rangeInView(view, { lines, marks, dots, measure }) {
  const seen = valuesWithin(view, lines, marks);
  for (let k = 0; k < dots.x.length; k++)
    if (dots.x[k] >= view[0] && dots.x[k] <= view[1]) seen.push(dots.y[k]);
  const span = extent(measure.log ? seen.filter((y) => y > 0) : seen) || [0, 1];
  // Towards a graze a multiplier grows without bound.
  if (measure.log) return [clamp(span[0], 1e-4, 0.5) / 1.5, clamp(span[1], 2, 1e3) * 1.5];
  if (measure.floor === undefined || span[0] > FAR_FROM_FLOOR * span[1]) return padded(span, 0.08);
  const most = span[1] + 0.06 * (span[1] - Math.min(0, span[0]));
  return [Math.min(-0.03 * most, span[0]), most];
}

/** The picture of `points`; `choice` has the measure and the row chosen, select(row) chooses one. */
function branchPlot(points, choice, select) {
  const measures = branchMeasures(points);
  const specials = [];
  for (let i = 0; i < points.count; i++) if (points.label(i)) specials.push(i);
  const beneath = DATA.continue.beneath && {
    x: decode(DATA.continue.beneath.x),
    y: decode(DATA.continue.beneath.y),
  };
  choice.measure = measures[0];
  let curves = { lines: [], all: [] };
  /** Where the marker of a special point stands: a graze on the axis, else the fastest impact. */
  const heightOf = (i) => {
    const values = choice.measure.of(i).filter(Number.isFinite);
    if (choice.measure.name !== "speed") return values[0];
    return points.label(i).startsWith("grazing") ? 0 : Math.max(...values);
  };
  const drawBeneath = (ctx, plot) => {
    if (!beneath || choice.measure.name !== "speed") return;
    ctx.fillStyle = clear(ink.faint, 0.75);
    for (let k = 0; k < beneath.x.length; k++)
      ctx.fillRect(plot.sx(beneath.x[k]) - 1.2, plot.sy(beneath.y[k]) - 1.2, 2.4, 2.4);
  };
  const drawLines = (ctx, plot) => {
    for (const run of curves.lines) {
      const look = BRANCH_LOOKS[run.state];
      ctx.strokeStyle = look.colour();
      ctx.lineWidth = look.width;
      ctx.setLineDash(look.dash);
      ctx.beginPath();
      for (let k = 0; k < run.x.length; k++) {
        const y = clamp(plot.sy(run.y[k]), -1e4, 1e4);
        if (k) ctx.lineTo(plot.sx(run.x[k]), y);
        else ctx.moveTo(plot.sx(run.x[k]), y);
      }
      ctx.stroke();
    }
    ctx.setLineDash([]);
  };
  /** Markers alone: the key below and the pointer name them, and no name hides an orbit. */
  const drawSpecials = (ctx, plot) => {
    ctx.fillStyle = ctx.strokeStyle = ink.ink;
    for (const i of specials) {
      const [x, y] = [plot.sx(points.value[i]), plot.sy(heightOf(i))];
      if (x >= plot.x0 - 5 && x <= plot.x1 + 5 && Number.isFinite(y))
        drawMarker(ctx, specialMarker(points.label(i)), x, y, 4.2);
    }
  };
  const own = (draw) => ({ kind: "own", look: lookOf(0), x: [], y: [], draw });
  const plot = new Plot({
    x: DATA.continue.label,
    y: " ",
    height: 500,
    alt: "Branches of periodic orbits",
    view: new View(
      ...padded(extent([...points.value, ...(beneath ? beneath.x : [])]) || [0, 1], 0.02),
    ),
    series: [own(drawBeneath), own(drawLines), own(drawSpecials)],
  });
  // Orbits change their kind at the special points: the first view is about them.
  const part = plot.view.beginAbout(
    specials.map((i) => points.value[i]),
    MOST_OF_SPECIALS,
  );
  plot.range = () => {
    const dots = beneath && choice.measure.name === "speed" ? beneath : { x: [], y: [] };
    const grazes = specials.filter((i) => heightOf(i) === 0).map((i) => ({ x: points.value[i], y: 0 }));
    return rangeInView(plot.X, { ...curves, marks: grazes, dots, measure: choice.measure });
  };
  tellNearest(
    plot,
    () => curves.all,
    ({ i, y }) =>
      [
        `branch ${points.columns.branch[i]}, point ${points.columns.point[i]}${points.label(i) ? `: ${points.label(i)}` : ""}`,
        `${columnLabel(DATA.continue.key)}: ${digits(points.value[i], 7)}`,
        `${choice.measure.text}: ${digits(y)}`,
        `${signatureText(points.columns.signature[i], points.columns.symmetric[i], points.branchAt(i).events.length)}, ${points.state(i)}`,
      ].join("\n"),
  );
  const ring = plot.over;
  plot.over = (ctx) => {
    ring(ctx);
    if (choice.row === null) return;
    for (const y of choice.measure.of(choice.row))
      drawRing(ctx, plot.sx(points.value[choice.row]), plot.sy(y), 6.5, ink.ink);
  };
  plot.click = () => plot.found && select(plot.found.i);
  const fill = () => {
    curves = branchCurves(points, choice.measure);
    plot.y = choice.measure.text;
    plot.log = [false, Boolean(choice.measure.log)];
    plot.marks = choice.measure.log ? [{ y: 1, dash: [2, 3], label: "stable below 1" }] : [];
    plot.redraw();
  };
  fill();
  const pick = selection(
    "Measure",
    measures.map(({ name, text }) => [name, text]),
    choice.measure.name,
    (name) => {
      choice.measure = measures.find((measure) => measure.name === name);
      fill();
    },
  );
  const used = new Set(curves.lines.map((run) => run.state));
  const labels = [...new Set(specials.map(points.label))];
  const keys = el(
    "div",
    { class: "bar" },
    Object.keys(BRANCH_LOOKS)
      .filter((state) => used.has(state))
      .map((state) => el("span", { class: "key" }, sampleOf(BRANCH_LOOKS[state]), state)),
    labels.map((label) => el("span", { class: "key" }, markerSample(specialMarker(label)), label)),
    beneath ? swatch(`impacts of ${DATA.continue.beneath.name || "a sweep"}`, () => ink.faint) : null,
  );
  const bar = el(
    "div",
    { class: "bar controls" },
    pick,
    button("The whole range", () => plot.view.set(...plot.view.full), "Whole range"),
    el(
      "span",
      { class: "right help" },
      part ? firstShown(plot.view, `about ${part === "all" ? "the" : "most"} special points`) : null,
      "drag to zoom · double click for all · click an orbit to see it",
    ),
  );
  return { plot, box: el("div", {}, bar, plot.box, keys) };
}
