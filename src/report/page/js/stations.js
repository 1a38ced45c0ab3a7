// Where a structure is drawn, and what it does there.

/**
 * Where a shape is drawn, in that plane of two: stations with their places x, at(t) which gives the
 * displacement of each, and the range of each over the run.
 */
function shapeStations(shape, plane) {
  const { stations, planes, u, unit } = shape;
  const n = stations.length;
  const [low, high] = [new Float64Array(n), new Float64Array(n)];
  for (let row = plane * n; row < u.length; row += planes * n) {
    for (let k = 0; k < n; k++) {
      low[k] = Math.min(low[k], unit * u[row + k]);
      high[k] = Math.max(high[k], unit * u[row + k]);
    }
  }
  const buffer = new Float64Array(n);
  return { x: stations, low, high, at: (t) => shapeAt(shape, plane, t, buffer), whole: true };
}

/** The same of the structure, of one without a shape through its watched places. */
function stationsOf(plane = 0) {
  const { ends, kind } = DATA.scene;
  // Of matrices and modes without a line a shape has the walls where no probe watches, by their
  // numbers.
  const atWalls = lead.shape && !ends && ["matrices", "modal"].includes(kind);
  if (lead.shape && !atWalls) return shapeStations(lead.shape, plane);
  // Without a shape: the watched places, by where they are if they say so.
  const two = DATA.scene.planes === 2;
  // Places on several bodies, and relative to each other, are not on one line.
  const place = ({ at }) =>
    at && !at.body && !at.relative_to ? (at.position ?? at.dof) : undefined;
  const placed = lead.probes.every((probe) => Number.isFinite(place(probe)) && !two) && !atWalls;
  const probes = placed ? [...lead.probes].sort((a, b) => place(a) - place(b)) : lead.probes;
  const x = probes.map((probe, i) => (placed ? place(probe) : i));
  const watched = {
    x,
    names: placed ? null : probes.map((probe) => probe.name),
    low: probes.map((probe) => Math.min(0, probe.extents.Q[0])),
    high: probes.map((probe) => Math.max(0, probe.extents.Q[1])),
    at: (t) => probes.map((probe) => stateAt(probe, t)[0]),
    ats: probes.map((probe) => probe.at),
    whole: placed && !ends,
  };
  if (!atWalls) return watched;
  const more = shapeStations(lead.shape, plane);
  const walls = lead.shape.stations.map((number) => DATA.scene.walls[number]);
  const names = walls.map(({ name }) => name.replace(/-(upper|lower)$/, ""));
  return {
    x: [...x, ...walls.map((_, k) => x.length + k)],
    names: [...watched.names, ...names],
    low: [...watched.low, ...more.low],
    high: [...watched.high, ...more.high],
    at: (t) => [...watched.at(t), ...more.at(t)],
    ats: [...watched.ats, ...walls.map(({ at }) => at)],
    whole: false,
  };
}

/** Where a place is along what is drawn: its position in m, or the number of its mass. */
function placeAlong(at) {
  const { ends } = (at && DATA.scene.bodies.find(({ name }) => name === at.body)) || DATA.scene;
  return at ? (at.position ?? (ends ? undefined : at.dof)) : undefined;
}

/** Where the drawing along a structure begins and ends, of stations at x. */
const endsOf = (x) => DATA.scene.ends || [Math.min(...x) - 0.5, Math.max(...x) + 0.5];

/** Where the stations have been: the band between their least and largest displacements. */
function drawSwept(ctx, stations, X, Y) {
  ctx.fillStyle = clear(ink.c3, 0.2);
  ctx.beginPath();
  stations.x.forEach((x, i) => ctx.lineTo(X(x), Y(stations.high[i])));
  for (let i = stations.x.length - 1; i >= 0; i--)
    ctx.lineTo(X(stations.x[i]), Y(stations.low[i]));
  ctx.fill();
}

/** Where the structure is at rest: a dashed line from `a` to `b` at this height. */
function drawAtRest(ctx, a, b, middle) {
  ctx.setLineDash([3, 4]);
  ctx.strokeStyle = ink.faint;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(a, middle);
  ctx.lineTo(b, middle);
  ctx.stroke();
  ctx.setLineDash([]);
}

/** How an end of a bar or beam is held: pinned, clamped, or on a spring. */
function drawEnd(ctx, x, middle, side, held) {
  ctx.fillStyle = ink.sheet;
  ctx.strokeStyle = ink.wall;
  ctx.lineWidth = 1.8;
  ctx.beginPath();
  if (held === "pinned") {
    ctx.moveTo(x, middle + 4);
    ctx.lineTo(x - 10, middle + 22);
    ctx.lineTo(x + 10, middle + 22);
    ctx.closePath();
    ctx.fill();
    ctx.stroke();
    ctx.fillStyle = hatch(ctx);
    ctx.fillRect(x - 14, middle + 23, 28, 7);
  } else if (held === "clamped") {
    ctx.moveTo(x, middle - 26);
    ctx.lineTo(x, middle + 26);
    ctx.stroke();
    ctx.fillStyle = hatch(ctx);
    ctx.fillRect(side < 0 ? x - 10 : x, middle - 26, 10, 52);
  } else if (held && held.stiffness) {
    ctx.moveTo(x, middle + 4);
    for (let k = 0; k < 6; k++) ctx.lineTo(x + (k % 2 ? -5 : 5), middle + 6 + 3 * k);
    ctx.lineTo(x, middle + 26);
    ctx.stroke();
    ctx.fillStyle = hatch(ctx);
    ctx.fillRect(x - 10, middle + 26, 20, 7);
  }
}
