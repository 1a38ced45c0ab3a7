// Displacement, velocity, impulses and forces over one axis of time.

/** Makes a plot over time follow and set the instant; `read(run, t)` gives what its curves are. */
function timed(plot, read, show) {
  plot.hover = (t) => {
    state.hover = t === null ? null : clamp(t, 0, duration);
    tellers.forEach((tell) => tell());
  };
  plot.click = (t) => seek(t);
  plot.over = (ctx) => {
    const t = now();
    if (t < plot.X[0] || t > plot.X[1]) return;
    const x = plot.sx(t);
    ctx.strokeStyle = state.hover !== null && !state.playing ? ink.soft : ink.c2;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(x, plot.y0);
    ctx.lineTo(x, plot.y1);
    ctx.stroke();
    if (read)
      drawReadings(
        ctx,
        plot,
        x,
        runs.filter((run) => run.shown).map((run) => [run, read(run, t)]),
        show,
      );
  };
  return plot;
}

/**
 * The values of the curves at the cursor, as dots and in a box beside it. At the instant that the
 * page begins with there is no box: it would hide curves that nobody asked to read.
 */
function drawReadings(ctx, plot, x, readings, show) {
  for (const [run, y] of readings) drawDot(ctx, x, plot.sy(y), 3.4, run.look.colour(), 1.2);
  if (state.hover === null && !state.chosen) return;
  const lines = readings.map(([run, y]) => (readings.length > 1 ? `${run.label}  ` : "") + show(y));
  if (!lines.length) return;
  const width = Math.max(...lines.map((line) => ctx.measureText(line).width)) + 16;
  const beside = x + 12 + width > plot.x1 ? x - 12 - width : x + 12;
  const left = clamp(beside, plot.x0 + 2, Math.max(plot.x0 + 2, plot.x1 - width - 2));
  const under = plot.heading && left < plot.x0 + 20 + 8 * plot.heading.length;
  const top = plot.y0 + (under ? 27 : 6);
  ctx.fillStyle = clear(ink.paper, 0.9);
  ctx.strokeStyle = ink.line;
  ctx.beginPath();
  ctx.roundRect(left, top, width, 17 * lines.length + 6, 5);
  ctx.fill();
  ctx.stroke();
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  readings.forEach(([run], i) => {
    ctx.fillStyle = run.reference ? ink.soft : run.look.colour();
    ctx.fillText(lines[i], left + 8, top + 12 + 17 * i);
  });
}

/** The line of a wall across an axis in units of which `factor` are a metre. */
const wallMark = (axis, factor, isSoft) => (wall) => ({
  [axis]: wall.position * factor,
  side: wall.side,
  label: axis === "y" ? wall.name : "",
  soft: isSoft(wall),
});

/** Lines of the walls that a watched place can meet. */
const wallMarks = (probe, factor, axis) =>
  probe.walls.map((i) => DATA.scene.walls[i]).map(wallMark(axis, factor, isElastic));

const horizonMark = (label) => ({
  x: DATA.horizon,
  dash: [5, 4],
  colour: () => ink.mind,
  label: label ? "horizon of prediction" : "",
});

/** A wall beyond this multiple of the motion is no part of its drawing at first. */
const FAR_WALL = 8;

/** Displacement or velocity ("Q" or "V") of a watched place. */
function motionPlot(index, key, several) {
  const probe = lead.probes[index];
  const [unit, factor] = lengthUnit(Math.max(...probe.extents[key].map(Math.abs)));
  const marks = key === "Q" ? wallMarks(probe, factor, "y") : [];
  const range = () => {
    const shown = runs
      .filter((run) => run.shown)
      .flatMap((run) => run.probes[index].extents[key].map((x) => x * factor));
    // Walls that are far beyond the motion would make a line of it.
    const most = Math.max(...shown.map(Math.abs));
    const near = marks.filter(({ y }) => most === 0 || Math.abs(y) <= FAR_WALL * most);
    return padded(extent([...shown, ...near.map(({ y }) => y)]), 0.13);
  };
  const of = key === "Q" ? unit : `${unit}/s`;
  const scaled = (values) => values.map((x) => x * factor);
  const plot = new Plot({
    y: `${key === "Q" ? "Displacement" : "Velocity"} (${of})`,
    height: several ? 150 : 188,
    heading: several ? probe.name : "",
    alt: `${key === "Q" ? "Displacement" : "Velocity"} over time ${probe.name}`,
    view,
    range,
    marks,
    series: runs.map((run) => ({
      look: run.look,
      x: run.probes[index].T,
      y: scaled(run.probes[index][key]),
      hidden: () => !run.shown,
    })),
  });
  return timed(
    plot,
    (run, t) => stateAt(run.probes[index], t)[key === "Q" ? 0 : 1] * factor,
    (y) => `${digits(y, 5)} ${of}`,
  );
}

/** Impulses of impacts as stems, or null without one. */
function impulsePlot() {
  const names = meetingPlaces();
  // Of one run those of each place in its colour, of several those of each run in that of the run.
  const places = runs.length > 1 ? [null] : PLACES;
  const stems = (run, place) => {
    const { peak, start, impulse, wall, count } = run.contacts;
    const here = (k) => place === null || (names[wall[k]] && placeOf(names[wall[k]]) === place);
    const all = Array.from({ length: count }, (_, k) => k);
    const impacts = all.filter((k) => Number.isNaN(peak[k]) && here(k));
    return {
      kind: "stems",
      look: run.look,
      colour: place === null ? null : () => placeColour(place),
      marker: run.reference ? "ring" : "disc",
      hidden: () => !run.shown,
      x: impacts.map((k) => start[k]),
      y: impacts.map((k) => impulse[k]),
    };
  };
  const series = runs.flatMap((run) => places.map((place) => stems(run, place)));
  if (!series.some((s) => s.x.length)) return null;
  const range = () =>
    padded(
      extent([0, ...series.filter((s) => !s.hidden()).flatMap((s) => extent(s.y) || [])]),
      0.13,
    );
  return timed(
    new Plot({
      y: "Impulse (N s)",
      alt: "Impulses of impacts over time",
      height: 132,
      view,
      range,
      series,
    }),
  );
}

/** Finite contact forces, or null without one. */
function forcePlot() {
  const series = runs.flatMap((run) =>
    run.forces.map((force) => ({
      look: { ...run.look, dash: [] },
      colour: runs.length > 1 ? null : () => placeColour(force.place),
      x: force.T,
      y: force.F,
      hidden: () => !run.shown,
    })),
  );
  if (!series.length) return null;
  const whole = () =>
    padded(
      extent([0, ...series.filter((s) => !s.hidden()).flatMap((s) => extent(s.y) || [])]),
      0.08,
    );
  return timed(
    new Plot({
      y: "Contact force (N)",
      alt: "Contact forces over time",
      height: 140,
      view,
      range: whole,
      series,
    }),
  );
}

/** The whole run in a strip, and what of it is in view; drag to move it. */
function overview(probe) {
  const series = [
    { look: { ...lead.look, width: 1, dash: [] }, colour: () => ink.faint, x: probe.T, y: probe.Q },
  ];
  const plot = new Plot({
    height: 44,
    top: 4,
    bottom: 6,
    bare: true,
    view: new View(0, duration),
    group: view,
    range: () => padded(probe.extents.Q, 0.1),
    series,
    alt: "The whole run",
  });
  // The view of this plot is the whole run: dragging moves the view of the others.
  const full = plot.view;
  full.set = () => {};
  view.listeners.push(refresh);
  plot.over = (ctx) => {
    const [a, b] = [plot.sx(view.lo), plot.sx(view.hi)];
    ctx.fillStyle = clear(ink.paper, 0.62);
    ctx.fillRect(plot.x0, plot.y0, a - plot.x0, plot.y1 - plot.y0);
    ctx.fillRect(b, plot.y0, plot.x1 - b, plot.y1 - plot.y0);
    ctx.strokeStyle = ink.accent;
    ctx.lineWidth = 2;
    ctx.strokeRect(a, plot.y0 + 1, Math.max(2, b - a), plot.y1 - plot.y0 - 2);
    plot.selection = null;
  };
  let grabbed = null;
  plot.overlay.classList.add("grab");
  plot.overlay.addEventListener("pointerdown", (event) => {
    const t = plot.tx(event.offsetX);
    const width = view.hi - view.lo;
    if (t < view.lo || t > view.hi) view.set(t - width / 2, t + width / 2);
    grabbed = [t, view.lo, view.hi];
  });
  plot.overlay.addEventListener("pointermove", (event) => {
    if (!grabbed) return;
    const shift = plot.tx(event.offsetX) - grabbed[0];
    view.set(grabbed[1] + shift, grabbed[2] + shift);
  });
  for (const end of ["pointerup", "pointerleave"])
    plot.overlay.addEventListener(end, () => {
      grabbed = null;
    });
  return el("div", { class: "screen" }, plot.box);
}

/** Most watched places that are shown at first. */
const FEW = 3;

function motionSection() {
  const several = lead.probes.length > 1;
  const choices = lead.probes.map((probe, i) => ({ label: probe.name, shown: i < FEW }));
  const panels = lead.probes.map((_, index) =>
    (several ? ["Q"] : ["Q", "V"]).map((key) => motionPlot(index, key, several)),
  );
  const all = [...panels.flat(), impulsePlot(), forcePlot()].filter((plot) => plot);
  // The last plot that is seen has the axis of time.
  let axis = null;
  const putAxis = () => {
    const seen = all.filter((plot) => !plot.box.hidden);
    const last = seen[seen.length - 1];
    if (last === axis) return;
    if (axis) Object.assign(axis, { x: undefined, bottom: 10, height: axis.height - 30 }).redraw();
    if (last) Object.assign(last, { x: "Time (s)", bottom: 40, height: last.height + 30 }).redraw();
    axis = last;
  };
  if (DATA.horizon) all.forEach((plot, i) => plot.marks.push(horizonMark(i === 0)));
  const show = () => {
    panels.forEach((plots, i) =>
      plots.forEach((plot) => {
        plot.box.hidden = !choices[i].shown;
      }),
    );
    putAxis();
    refreshAll();
  };
  show();
  const jump = (text, lo, hi) =>
    button(`Show from ${digits(lo)} to ${digits(hi)} s`, () => view.set(lo, hi), text);
  const jumps = [
    jump("Whole run", 0, duration),
    period ? jump("First ten periods", 0, Math.min(duration, 10 * period)) : null,
    period ? jump("Last ten periods", Math.max(0, duration - 10 * period), duration) : null,
    DATA.horizon ? jump("Up to the horizon", 0, DATA.horizon) : null,
  ];
  const key = (name) => el("kbd", {}, name);
  const help = el(
    "span",
    { class: "right help" },
    "drag to zoom · ",
    key("shift"),
    " drag to move · ",
    key("ctrl"),
    " wheel · double click for all · click to set the time · ",
    key("←"),
    " ",
    key("→"),
    " contacts · ",
    key("+"),
    " ",
    key("−"),
    " ",
    key("0"),
    " zoom",
  );
  const contactKeys =
    lead.contacts.count && runs.length === 1 && PLACES.length <= PLACE_COLOURS.length
      ? el(
          "div",
          { class: "bar" },
          "Contacts: ",
          PLACES.map((name) => swatch(name, () => placeColour(name))),
        )
      : null;
  section(
    "motion",
    "Motion",
    null,
    runs.length > 1 ? runChips() : null,
    several ? el("div", { class: "controls" }, chips(choices, show)) : null,
    all.map((plot) => plot.box),
    overview(lead.probes[0]),
    contactKeys,
    el("div", { class: "bar controls" }, jumps, help),
  );
}
