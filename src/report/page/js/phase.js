// The phase plane: orbit or Poincaré section; and the contacts by phase of the load and speed.

function phaseSection() {
  const choice = { index: 0, kind: "orbit", strobe: 0 };
  const probe = () => lead.probes[choice.index];
  const left = el("div");
  const right = el("div");
  const build = () => {
    [left, right].forEach((box) => dropPlots(box));
    left.replaceChildren(phasePlot(choice));
    right.replaceChildren(
      ...(period && lead.contacts.count && probe().walls.length
        ? [contactPhases(choice.index)]
        : []),
    );
    refreshAll();
  };
  const names = lead.probes.map((p, i) => [String(i), p.name || "the body"]);
  const pick =
    names.length > 1
      ? el(
          "div",
          { class: "bar controls" },
          "Watched place ",
          printed(
            selection("Watched place", names, "0", (i) => {
              choice.index = +i;
              build();
            }),
          ),
        )
      : null;
  section(
    "phase",
    "Phase",
    "Over the stretch of time shown above.",
    pick,
    el("div", { class: "two" }, left, right),
  );
  build();
}

/** Forgets the plots within a box that is to be filled anew. */
function dropPlots(box) {
  for (let i = drawings.length - 1; i >= 0; i--) {
    if (!box.contains(drawings[i].box)) continue;
    drawings[i].dropped = true;
    drawings.splice(i, 1);
  }
}

function phasePlot(choice) {
  const probe = lead.probes[choice.index];
  const [[unit, factor], [speed, fast]] = ["Q", "V"].map((key) =>
    lengthUnit(Math.max(...probe.extents[key].map(Math.abs))),
  );
  const scaled = (values, by) => values.map((x) => x * by);
  const of = (run) => run.probes[choice.index];
  const orbits = runs.map((run) => ({
    kind: "orbit",
    look: run.look,
    t: of(run).T,
    x: scaled(of(run).Q, factor),
    y: scaled(of(run).V, fast),
    view,
    alpha: runs.length > 1 ? 0.75 : 0.6,
    hidden: () => !run.shown || choice.kind !== "orbit",
  }));
  const strobes = runs.map((run) => ({
    kind: "points",
    look: run.look,
    x: [],
    y: [],
    size: 2.4,
    marker: run.reference ? "ring" : "disc",
    hidden: () => !run.shown || choice.kind !== "poincare",
  }));
  const plot = new Plot({
    x: `Displacement (${unit})`,
    y: `Velocity (${speed}/s)`,
    height: 430,
    alt: "Phase plane",
    marks: wallMarks(probe, factor, "x"),
    series: [...orbits, ...strobes],
  });
  plot.limits = () => {
    const span = (key) =>
      extent(runs.filter((run) => run.shown).flatMap((run) => of(run).extents[key]));
    [plot.X, plot.Y] = ["Q", "V"].map((key) => {
      const [lo, hi] = span(key).map((x) => x * (key === "Q" ? factor : fast));
      return hi > lo ? padded([lo, hi], 0.07) : [lo - 1, lo + 1];
    });
  };
  /** The state of every run once a period, at this phase of the load. */
  const strobe = () =>
    runs.forEach((run, k) => {
      const { x, y } = strobes[k];
      x.length = y.length = 0;
      for (
        let n = Math.ceil(view.lo / period - choice.strobe);
        (n + choice.strobe) * period <= view.hi;
        n++
      ) {
        const [q, v] = stateAt(of(run), (n + choice.strobe) * period);
        x.push(q * factor);
        y.push(v * fast);
      }
    });
  const changed = () => {
    if (plot.dropped) return;
    if (period) strobe();
    plot.redraw();
  };
  view.listeners.push(changed);
  if (period) strobe();
  plot.over = (ctx) => {
    if (!lead.shown) return;
    const [q, v] = stateAt(probe, now());
    drawDot(ctx, plot.sx(q * factor), plot.sy(v * fast), 5, ink.c2);
  };
  if (!period) return el("div", {}, plot.box);
  const told = el("span");
  const say = () => {
    told.textContent =
      choice.kind === "orbit" ? "" : `at ${Math.round(360 * choice.strobe)}° of the load`;
  };
  const slider = el("input", {
    type: "range",
    min: 0,
    max: 1,
    step: 0.005,
    value: choice.strobe,
    "aria-label": "Phase of the load",
    disabled: choice.kind === "orbit",
    oninput: (event) => {
      choice.strobe = +event.target.value;
      say();
      changed();
    },
  });
  const kinds = segmented(
    "Orbit or section",
    [
      ["orbit", "Orbit"],
      ["poincare", "Poincaré section"],
    ],
    choice.kind,
    (kind) => {
      choice.kind = kind;
      slider.disabled = kind === "orbit";
      say();
      changed();
    },
  );
  say();
  return el("div", {}, el("div", { class: "bar controls" }, kinds, slider, told), plot.box);
}

/** The contacts at the walls of a watched place: when in the period, and how fast. */
function contactPhases(index) {
  const { walls } = lead.probes[index];
  const [unit, factor] = lengthUnit(
    Math.max(...lead.contacts.approach.map((v) => Math.abs(v) || 0)),
  );
  const series = runs.flatMap((run) =>
    walls.map((wall, n) => ({
      kind: "points",
      look: run.look,
      x: [],
      y: [],
      when: [],
      size: 2.6,
      run,
      wall,
      marker: run.reference ? "ring" : n % 2 ? "open-square" : "disc",
      colour: runs.length > 1 ? null : () => placeColour(DATA.scene.walls[wall].name),
      hidden: () => !run.shown,
    })),
  );
  const phase = (t) => ((t / period) % 1) * 360;
  const fill = () =>
    series.forEach((s) => {
      s.x.length = s.y.length = s.when.length = 0;
      const { start, wall, approach, count } = s.run.contacts;
      for (let k = Math.max(0, before(start, view.lo)); k < count && start[k] <= view.hi; k++) {
        if (wall[k] !== s.wall || start[k] < view.lo) continue;
        s.x.push(phase(start[k]));
        s.y.push(approach[k] * factor);
        s.when.push(start[k]);
      }
    });
  fill();
  const top = Math.max(...series.flatMap((s) => (extent(s.y) || [0, 1e-12])[1]));
  const plot = new Plot({
    x: "Phase of the load at the contact (°)",
    y: `Approach speed (${unit}/s)`,
    height: 430,
    alt: "Contacts by phase of the load and approach speed",
    view: new View(0, 360),
    range: () => [0, 1.06 * top],
    series,
  });
  view.listeners.push(() => {
    if (plot.dropped) return;
    fill();
    plot.redraw();
  });
  const points = () =>
    series
      .filter((s) => !s.hidden())
      .flatMap((s) => s.x.map((x, i) => ({ x, y: s.y[i], s, t: s.when[i] })));
  tellNearest(
    plot,
    points,
    ({ s, t, y }) =>
      `${DATA.scene.walls[s.wall].name} at t = ${t.toFixed(5)} s\n${digits(y)} ${unit}/s`,
  );
  plot.click = () => plot.found && seek(plot.found.t);
  const ring = plot.over;
  plot.over = (ctx) => {
    ring(ctx);
    const { start, wall, approach } = lead.contacts;
    const k = before(start, now());
    if (k < 0 || !walls.includes(wall[k]) || now() - start[k] > period / 2) return;
    drawRing(ctx, plot.sx(phase(start[k])), plot.sy(approach[k] * factor), 7, ink.c2);
  };
  const names = walls
    .map((wall, n) => `${n % 2 ? "□" : "●"} ${DATA.scene.walls[wall].name}`)
    .join("   ");
  return el(
    "div",
    {},
    el(
      "div",
      { class: "bar" },
      names,
      el("span", { class: "right help" }, "click a point to go there"),
    ),
    plot.box,
  );
}
