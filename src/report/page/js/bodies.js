// Several bodies, each along its own axis from the side, in each plane. What bounds the motion of one
// relative to another moves with that other.

/** Heights of the drawing of a body in a plane, px; of one in two planes. */
const BODY_HEIGHT = 150;
const BODY_IN_TWO = 104;

/** The drawing of all bodies that have a shape. */
function bodiesStage() {
  const { bodies, loads, planes, supports, walls } = DATA.scene;
  const shapes = Object.entries(lead.bodies);
  const memory = glance() * 0.14;
  const force = largestForce(loads) || 1;

  /** The displacement of a place of a body at t; undefined where it has none in the drawing. */
  const movedAt = (at, plane, t) => {
    const shape = lead.bodies[at.body];
    const x = placeAlong(at);
    if (!shape || !Number.isFinite(x)) return undefined;
    return shapeAt(shape, plane, t, new Float64Array(shape.stations.length))[nearestTo(shape.stations, x)];
  };

  /**
   * What bounds a body at a place: from `room[0]` to `room[1]` about `base(t)`, undefined where
   * nothing does; `of` are the numbers of the places of contact.
   */
  const boundsOf = (name, plane) => {
    const all =
      planes === 2
        ? supports.map((support) => ({
            at: support.at,
            name: support.name,
            room: roomOf(support, plane),
            of: struckPlaces(support).map(({ index }) => index),
          }))
        : walls.filter(stands).map((wall) => ({
            at: wall.at,
            name: wall.name,
            room: wall.side === "upper" ? [undefined, wall.position] : [wall.position, undefined],
            of: [walls.indexOf(wall)],
          }));
    return all.flatMap(({ at, room: [low, high], ...rest }) => {
      const other = at && at.relative_to;
      const found = [];
      if (at && at.body === name)
        found.push({ ...rest, x: placeAlong(at), room: [low, high], base: (t) => (other ? movedAt(other, plane, t) : 0) });
      // The other one is bounded the other way round.
      if (other && other.body === name) {
        const turned = [high, low].map((u) => u && -u);
        found.push({ ...rest, x: placeAlong(other), room: turned, base: (t) => movedAt(at, plane, t) });
      }
      return found.filter((bound) => Number.isFinite(bound.x));
    });
  };

  const rows = shapes.flatMap(([name, shape]) =>
    Array.from({ length: shape.planes }, (_, plane) => ({
      name,
      plane,
      shape,
      body: bodies.find((body) => body.name === name) || {},
      stations: shapeStations(shape, plane),
      bounds: boundsOf(name, plane),
    })),
  );
  const each = planes === 2 ? BODY_IN_TWO : BODY_HEIGHT;
  const high = each / 2 - 20;
  const most = Math.max(
    1e-300,
    ...rows.flatMap(({ stations }) => [...stations.high, ...stations.low].map(Math.abs)),
  );
  const gap = Math.max(
    0,
    ...rows.flatMap(({ bounds }) => bounds.flatMap(({ room }) => room.map((u) => Math.abs(u ?? 0)))),
  );
  const scale = Math.min(high / most, gap > 0 ? (0.75 * high) / gap : Infinity);

  const drawBound = (ctx, { x, room, base, of, name }, X, Y, wide, t, struck) => {
    const from = base(t);
    if (from === undefined) return;
    const [fresh, share] = of
      .map((index) => struck[index] || [0, 0])
      .reduce((best, one) => (one[0] > best[0] ? one : best), [0, 0]);
    room.forEach((edge, i) => {
      if (edge === undefined) return;
      const out = i ? -1 : 1;
      const y = Y(from + edge) + 4 * out;
      ctx.fillStyle = hatch(ctx);
      ctx.fillRect(X(x) - wide, Math.min(y, y + 12 * out), 2 * wide, 12);
      ctx.strokeStyle = placeColour(name);
      ctx.lineWidth = 2.2 + 5 * fresh * Math.sqrt(share);
      ctx.beginPath();
      ctx.moveTo(X(x) - wide, y);
      ctx.lineTo(X(x) + wide, y);
      ctx.stroke();
    });
  };

  const drawBody = (ctx, { body, stations }, X, Y, u) => {
    if (body.ends) {
      for (const [width, colour] of [
        [7, ink.body],
        [4, ink.mass],
      ]) {
        ctx.strokeStyle = colour;
        ctx.lineWidth = width;
        ctx.beginPath();
        stations.x.forEach((x, i) => ctx.lineTo(X(x), Y(u[i])));
        ctx.stroke();
      }
      return;
    }
    ctx.fillStyle = ink.mass;
    ctx.strokeStyle = ink.body;
    ctx.lineWidth = 1.6;
    stations.x.forEach((x, i) => {
      ctx.beginPath();
      ctx.roundRect(X(x) - 6, Y(u[i]) - 4, 12, 8, 2);
      ctx.fill();
      ctx.stroke();
    });
  };

  const drawLoads = (ctx, { name, plane, stations }, X, Y, u, t) => {
    for (const load of loads) {
      const at = load.at || {};
      const x = placeAlong(at);
      if (at.body !== name || !Number.isFinite(x)) continue;
      const angle = ((at.direction || 0) * TURN) / 360;
      const part = forceOf(load, t) * (plane ? Math.sin(angle) : Math.cos(angle));
      drawArrow(ctx, X(x), Y(u[nearestTo(stations.x, x)]), 0, (-34 * part) / force, ink.accent, 2.2);
    }
  };

  const drawRow = (ctx, row, top, w, t, struck) => {
    const { name, plane, body, stations, bounds } = row;
    const ends = body.ends || endsOf(stations.x);
    const [a, b] = [34, w - 34];
    const X = (x) => a + ((b - a) * (x - ends[0])) / (ends[1] - ends[0]);
    const middle = top + each / 2 + 7;
    const Y = (u) => middle - scale * u;
    drawSwept(ctx, stations, X, Y);
    drawAtRest(ctx, a, b, middle);
    if (body.ends) {
      drawEnd(ctx, a, middle, -1, body.left);
      drawEnd(ctx, b, middle, 1, body.right);
    }
    const u = Float64Array.from(stations.at(t));
    drawBody(ctx, row, X, Y, u);
    const wide = clamp(0.02 * (b - a), 3, 12);
    bounds.forEach((bound) => drawBound(ctx, bound, X, Y, wide, t, struck));
    drawLoads(ctx, row, X, Y, u, t);
    const along = planes === 2 ? ` along ${plane ? "z" : "y"}` : "";
    const magnified = body.ends ? ` × ${digits(scale / (Math.abs(X(1) - X(0)) || 1), 3)}` : "";
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(`${name}: displacement${along}${magnified}`, 6, top + 12, w - 12);
  };

  const absent = bodies.map(({ name }) => name).filter((name) => !lead.bodies[name]);
  const remark = [
    "what stands between two bodies moves with the other",
    ...(absent.length ? [`not drawn: ${absent.join(", ")}, whose places are on no line`] : []),
  ].join("; ");
  const paint = (ctx, w, h, t) => {
    const struck = struckAt(t, memory);
    rows.forEach((row, i) => drawRow(ctx, row, i * each, w, t, struck));
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "left";
    ctx.fillText(remark, 6, h - 6, w - 12);
  };
  return new Stage(rows.length * each + 22, "The bodies from the side", paint);
}
