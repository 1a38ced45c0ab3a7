// Where around a support its tube wears: wedges by sector, and by flat.

/** A flat, which has one direction, is drawn over so many degrees on either side. */
const FLAT_WIDE = 9;

/** A limit further away than this multiple of the depth is not drawn. */
const LIMIT_NEAR = 2;

/**
 * Wedges about (cx, cy) in pixels, from the radius `inner` to `outer(part)`; parts are { from, to }
 * in degrees from +y towards +z.
 */
function drawWedges(ctx, cx, cy, inner, parts, outer) {
  for (const part of parts) {
    const [from, to] = [part.from, part.to].map((deg) => (-deg * TURN) / 360);
    ctx.beginPath();
    ctx.arc(cx, cy, inner, from, to, true);
    ctx.arc(cx, cy, outer(part), to, from, false);
    ctx.closePath();
    ctx.fill();
  }
}

/** What wedges can show: name, column of sector-means.csv, unit, and how many of it are one in SI. */
const SECTOR_MEASURES = [
  ["Depth", "depth", "m", "µm", 1e6],
  ["Work rate", "work_rate", "W", "mW", 1e3],
];

/** The parts of each support by the measure: { place: [{ from, to, value, half }] }. */
function partsByPlace({ columns, rows }, [, column, unit, , factor]) {
  const [values, halves] = [columns[`${column}_${unit}`], columns[`${column}_half_width_95_${unit}`]];
  const places = {};
  if (!values) return places;
  for (const i of rows) {
    if (!Number.isFinite(values[i])) continue;
    const [from, to] = [columns.from_deg[i], columns.to_deg[i]];
    const wide = columns.part[i] === "flat" ? FLAT_WIDE : 0;
    (places[columns.place[i]] ||= []).push({
      from: from - wide,
      to: to + wide,
      text: wide ? `flat at ${digits(from)}°` : `${digits(from)}° to ${digits(to)}°`,
      value: factor * values[i],
      half: factor * (halves[i] ?? NaN),
    });
  }
  return places;
}

/** The deepest wear at a support and its half width, m, as the table of the page has it; null where it
 *  has none. */
function deepestAt(place) {
  const { wear, summary } = DATA;
  if (!wear) {
    const all = summary?.realisations?.worn || [];
    const own = all.find((one) => one.place === place && one.measure === "depth_deepest");
    return own ? [own.mean, own.half_width_95] : null;
  }
  const { columns, rows } = tableOf(wear.years);
  const last = rows.filter((i) => columns.place[i] === place).pop();
  const of = (column) => (columns[column] || [])[last];
  return Number.isFinite(of("depth_deepest_m")) ? [of("depth_deepest_m"), of("depth_deepest_half_width_95_m")] : null;
}

/** What is told above the wedges: the part of the largest mean, and of depths first the deepest. */
function toldOfWedges(name, highest, [, column, , unit, factor]) {
  if (!(highest.value > 0)) return "none";
  const mean = `largest mean: ${plusMinus(highest.value, highest.half)} ${unit}, ${highest.text}`;
  const deepest = column === "depth" ? deepestAt(name) : null;
  if (!deepest) return mean;
  const [value, half] = deepest.map((x) => factor * (x ?? NaN));
  return `deepest: ${plusMinus(value, half || null)} ${unit}; ${mean}`;
}

/** One support: wedges from its centre, with their intervals, and the limit as a circle where it is
 *  near `most`, the farthest end of any support's. */
function wedgePlot(name, parts, measure, most, limit) {
  const [label, , , unit] = measure;
  const shown = limit && limit < LIMIT_NEAR * most ? limit : null;
  const reach = Math.max(most, shown || 0) || 1;
  const draw = (ctx, plot) => {
    const [cx, cy] = [plot.sx(0), plot.sy(0)];
    const scale = (plot.x1 - plot.x0) / (plot.X[1] - plot.X[0]);
    ctx.fillStyle = clear(placeColour(name), 0.65);
    drawWedges(ctx, cx, cy, 0, parts, ({ value }) => Math.max(0, value) * scale);
    ctx.strokeStyle = ink.ink;
    ctx.lineWidth = 1.2;
    for (const { from, to, value, half } of parts) {
      if (!(half > 0)) continue;
      const angle = (-0.5 * (from + to) * TURN) / 360;
      const at = (size) => [cx + Math.max(0, size) * scale * Math.cos(angle), cy + Math.max(0, size) * scale * Math.sin(angle)];
      ctx.beginPath();
      ctx.moveTo(...at(value - half));
      ctx.lineTo(...at(value + half));
      ctx.stroke();
    }
    if (!shown) return;
    ctx.strokeStyle = ink.wall;
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.arc(cx, cy, shown * scale, 0, TURN);
    ctx.stroke();
    drawLabel(ctx, `limit ${digits(shown)} ${unit}`, cx, cy - shown * scale - 9, "center");
  };
  const plot = new Plot({
    x: `${label} towards y (${unit})`,
    y: `towards z (${unit})`,
    height: 340,
    heading: name,
    alt: `${label} around the support ${name}: ${parts.map(({ text, value, half }) => `${text}: ${plusMinus(value, half)} ${unit}`).join("; ")}`,
    series: [{ kind: "own", look: lookOf(0), x: [], y: [], draw }],
  });
  plot.limits = () => {
    // One depth is as long in every direction.
    const [w, h] = [plot.x1 - plot.x0, plot.y1 - plot.y0];
    const half = (1.12 * reach) / Math.min(w, h);
    [plot.X, plot.Y] = [w, h].map((side) => [-half * side, half * side]);
  };
  tellPart(plot, parts, unit);
  const highest = parts.reduce((best, part) => (part.value > best.value ? part : best), parts[0]);
  const told = toldOfWedges(name, highest, measure);
  const far = limit && !shown && highest.value > 0 ? `; the limit of ${digits(limit)} ${unit} lies outside` : "";
  return el("div", {}, el("p", { class: "lead" }, told + far), plot.box);
}

/** Tells of the part in the direction of the pointer. */
function tellPart(plot, parts, unit) {
  const tip = el("div", { class: "tip", hidden: true });
  plot.box.append(tip);
  plot.hover = (x, at) => {
    const angle = at && (Math.atan2(plot.ty(at[1]), plot.tx(at[0])) * 360) / TURN;
    const turned = (deg) => ((deg % 360) + 360) % 360;
    const found =
      x !== null && at && parts.find(({ from, to }) => turned(angle - from) < to - from);
    const text = found ? `${found.text}\n${plusMinus(found.value, found.half)} ${unit}` : null;
    showTip(plot, tip, text, at);
  };
}

/** The wedges of all supports, and their numbers; null where the table has none. */
function sectorParts() {
  const { sectors, limit } = DATA.draws || {};
  if (!sectors) return null;
  const table = tableOf(sectors);
  const known = SECTOR_MEASURES.filter((measure) => Object.keys(partsByPlace(table, measure)).length);
  if (!known.length) return null;
  const [box, list] = [el("div"), el("div")];
  const build = (measure) => {
    dropPlots(box);
    const [, column, , unit, factor] = measure;
    const places = Object.entries(partsByPlace(table, measure));
    box.className = places.length > 1 ? "two" : "";
    // All supports to one scale.
    const ends = places.flatMap(([, parts]) => parts.map(({ value, half }) => value + (half || 0)));
    const most = Math.max(0, ...ends);
    const shownLimit = column === "depth" && limit ? factor * limit : null;
    box.replaceChildren(...places.map(([name, parts]) => wedgePlot(name, parts, measure, most, shownLimit)));
    const rows = places.flatMap(([place, parts]) => parts.map((part) => ({ place, ...part })));
    list.replaceChildren(
      sortable(
        [
          wordColumn("support", ({ place }) => place),
          { name: "sector", value: ({ from }) => from, show: ({ text }) => text },
          {
            name: `${measure[0].toLowerCase()} (${unit})`,
            value: ({ value }) => value,
            show: ({ value, half }) => plusMinus(value, half),
          },
        ],
        rows,
        { height: 60 + ROW * Math.min(rows.length, 8) },
      ),
    );
    refreshAll();
  };
  const choices = known.map(([label, , , unit], i) => [String(i), `${label} (${unit})`]);
  const choose = segmented("By sector", choices, "0", (i) => build(known[+i]));
  build(known[0]);
  return [
    el("h3", {}, "Around each support"),
    choices.length > 1 ? el("div", { class: "bar controls" }, choose) : null,
    box,
    list,
  ];
}
