// The supports of a structure in two planes: the orbit in each, with the work of wear by sector as a
// ring around it, and their numbers.

/** The ring begins at this multiple of the support's reach, and its highest sector is this share of it high. */
const RING = [1.06, 0.3];

function supportSection() {
  const { supports, statistics } = DATA.summary;
  const rows = supports.map((support, i) => ({ ...support, ...statistics.supports[i] }));
  const drawn = DATA.scene.supports
    .map((support) => ({
      support,
      worn: rows.find((row) => row.support === support.name),
      pair: watching(support.name),
    }))
    .filter(({ pair, worn }) => pair && worn);
  const upper = rows.some((row) => row.upper_figure);
  section(
    "supports",
    DATA.scene.supports.length ? "Supports" : "Sliders",
    (drawn.length
      ? "Where the structure went within its supports, over the stretch of time shown above; the ring " +
        "shows the work rate by sector, over the window of the statistics."
      : "Over the window of the statistics.") +
      (upper
        ? " A work rate without friction is an upper figure: what slides is then held back by " +
          "structural damping alone."
        : ""),
    drawn.length
      ? el(
          "div",
          { class: drawn.length > 1 ? "two" : "" },
          drawn.map((one) => supportPlot(one)),
        )
      : null,
    supportTable(rows),
  );
}

function supportPlot({ support, worn, pair: [y, z] }) {
  const { centre, reach } = support;
  const [unit, factor] = lengthUnit(reach);
  const at = (probe) => (t) => stateAt(probe, t)[0] * factor;
  const orbit = {
    kind: "orbit",
    look: lead.look,
    t: y.T,
    x: y.Q.map((q) => q * factor),
    y: y.T.map(at(z)),
    view,
    alpha: 0.6,
    hidden: () => !lead.shown,
  };
  const edge = { kind: "own", look: lead.look, x: [], y: [], draw: drawEdge };
  const most = Math.max(...worn.sectors.map((sector) => sector.work_rate_w));
  const scale = (plot) => (plot.x1 - plot.x0) / (plot.X[1] - plot.X[0]);
  function drawEdge(ctx, plot) {
    const [X, Y] = [(y) => plot.sx(y * factor), (z) => plot.sy(z * factor)];
    drawOutline(ctx, support, X, Y, factor * scale(plot), placeColour(support.name));
    const [cx, cy] = [X(centre[0]), Y(centre[1])];
    if (!(most > 0)) return;
    ctx.fillStyle = clear(placeColour(support.name), 0.65);
    const inner = RING[0] * reach * factor * scale(plot);
    const high = RING[1] * reach * factor * scale(plot);
    const parts = worn.sectors.map(({ from_deg: from, to_deg: to, work_rate_w: work }) => ({ from, to, work }));
    drawWedges(ctx, cx, cy, inner, parts, ({ work }) => inner + (work / most) * high);
  }
  const plot = new Plot({
    x: `Displacement along y (${unit})`,
    y: `along z (${unit})`,
    height: 430,
    heading: support.name,
    alt: `Orbit within the support ${support.name}, and its work rate by sector`,
    series: [orbit, edge],
  });
  plot.limits = () => {
    // One length is as long along both axes.
    const [w, h] = [plot.x1 - plot.x0, plot.y1 - plot.y0];
    const shown = (1.05 * (RING[0] + RING[1]) * reach * factor) / Math.min(w, h);
    const around = (c, size) => [c * factor - shown * size, c * factor + shown * size];
    [plot.X, plot.Y] = [around(centre[0], w), around(centre[1], h)];
  };
  view.listeners.push(() => plot.redraw());
  plot.over = (ctx) => {
    if (!lead.shown) return;
    const [w, u] = [y, z].map((probe) => at(probe)(now()));
    drawDot(ctx, plot.sx(w), plot.sy(u), 5, placeColour(support.name));
  };
  const told = most > 0 ? `highest sector: ${digits(most)} W` : "no work of wear";
  return el("div", {}, el("div", { class: "bar help" }, told), plot.box);
}

/** The numbers of the supports, as in supports.csv. */
function supportTable(rows) {
  const number = (name, value, half) => ({
    name,
    value: (row) => value(row) ?? NaN,
    show: (row) => plusMinus(value(row), (half && half(row)) || null),
  });
  const worn = (key, factor) => (row) => row.worn && row.worn[key] * factor;
  const columns = [
    wordColumn("support", (row) => row.support),
    wordColumn("work rate is", (row) => (row.upper_figure ? "upper figure" : "with friction")),
    number(
      "work rate (W)",
      (row) => row.work_rate_w,
      (row) => row.work_rate_half_width_95_w,
    ),
    number("by impacts (%)", (row) => row.impact_share && 100 * row.impact_share),
    number("friction power (W)", (row) => row.friction_power_w),
    number("sliding (m)", (row) => row.sliding_m),
    number(
      "mean force (N)",
      (row) => row.force?.mean_n,
      (row) => row.force?.mean_half_width_95_n,
    ),
    number("along y (N)", (row) => row.force?.mean_vector_n[0]),
    number("along z (N)", (row) => row.force?.mean_vector_n[1]),
    number("largest force (N)", (row) => row.force_largest?.mean_n),
    number("at (s)", (row) => row.force_largest?.at_s),
    rows.some((row) => row.worn) ? number("worn (mm³)", worn("volume_m3", 1e9)) : null,
    rows.some((row) => row.worn) ? number("deepest (mm)", worn("depth_deepest_m", 1e3)) : null,
    rows.some((row) => row.worn) ? number("one scar (mm)", worn("depth_one_scar_m", 1e3)) : null,
    rows.some((row) => row.worn) ? number("all round (mm)", worn("depth_all_round_m", 1e3)) : null,
  ].filter(Boolean);
  return sortable(columns, rows, { height: Math.min(420, 70 + ROW * rows.length) });
}
