// A structure that moves in two planes: seen along its axis, within the outlines of its supports,
// and from the side, once in each plane.

/** From this width (px) on the views stand side by side. */
const SIDE_BY_SIDE = 560;

function planesStage() {
  const { supports, walls, loads, kind } = DATA.scene;
  const planes = lead.shape ? [0, 1].map((plane) => stationsOf(plane)) : null;
  const watched = supports
    .map((support) => ({
      support,
      colour: () => placeColour(support.name),
      pair: watching(support.name),
    }))
    .map((one) => ({ ...one, of: struckPlaces(one.support) }));
  /** A mass alone, which every load moves; and pairs of probes, where no support has its own. */
  const alone = kind === "oscillator" ? pairAlone() : null;
  const most = Math.max(
    1e-300,
    ...lead.probes.flatMap((probe) => probe.extents.Q.map(Math.abs)),
    ...(planes || []).flatMap(({ low, high }) => [...low, ...high].map(Math.abs)),
  );
  const reach = Math.max(
    ...supports.map(({ reach, centre }) => reach + Math.hypot(...centre)),
    supports.length ? 0 : 1.1 * most,
  );
  /** What the view along the axis holds: the supports, and the structure wherever it goes. */
  const held = Math.max(reach, most);
  const memory = glance() * 0.14;
  const force = largestForce(loads) || 1;

  /** The force of the loads there, of all where x is null, N along y and z: [y, z]. */
  const forceAt = (x, t) => {
    const out = [0, 0];
    for (const load of loads) {
      const { direction } = load.at || {};
      if (!Number.isFinite(direction) || !(x === null || placeAlong(load.at) === x)) continue;
      const part = forceOf(load, t);
      out[0] += part * Math.cos((direction * TURN) / 360);
      out[1] += part * Math.sin((direction * TURN) / 360);
    }
    return out;
  };
  const loadPlaces = planes
    ? [...new Set(loads.map(({ at }) => placeAlong(at)))].filter(Number.isFinite)
    : [];
  const nearest = (x) => nearestTo(planes[0].x, x);

  const drawTrail = (ctx, [y, z], X, Y, t, colour) => {
    const span = glance();
    const shades = 4;
    ctx.strokeStyle = colour;
    ctx.lineWidth = 1.3;
    for (let part = 0; part < shades; part++) {
      const [from, to] = [t - span * (1 - part / shades), t - span * (1 - (part + 1) / shades)];
      if (to < 0) continue;
      ctx.globalAlpha = 0.2 + (0.7 * part) / shades;
      ctx.beginPath();
      const first = Math.max(0, before(y.T, Math.max(0, from)));
      const last = Math.min(before(y.T, to), first + 4000);
      for (let i = first; i <= last; i++) ctx.lineTo(X(y.Q[i]), Y(stateAt(z, y.T[i])[0]));
      ctx.lineTo(X(stateAt(y, to)[0]), Y(stateAt(z, to)[0]));
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
  };

  /** The arrow of a support's force at the point (y, z), m, towards the inside. */
  const drawPush = (ctx, { support, of, colour }, [y, z], X, Y, struck) => {
    for (const { index, direction } of of) {
      const [fresh, share] = struck[index];
      if (!(fresh > 0)) continue;
      const [ny, nz] = direction || [y - support.centre[0], z - support.centre[1]];
      const n = Math.hypot(ny, nz);
      if (!(n > 0)) continue;
      const long = 16 + 54 * share;
      ctx.globalAlpha = fresh;
      drawArrow(ctx, X(y), Y(z), (-ny / n) * long, (nz / n) * long, colour(), 2.6);
      ctx.globalAlpha = 1;
    }
  };

  /** Along the axis, in the square of that size. */
  const drawAxial = (ctx, left, top, size, t, struck) => {
    const scale = (0.5 * size - 14) / held;
    const [cx, cy] = [left + size / 2, top + size / 2];
    const X = (y) => cx + scale * y;
    const Y = (z) => cy - scale * z;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, size, size);
    ctx.clip();
    ctx.setLineDash([3, 4]);
    ctx.strokeStyle = ink.faint;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(left, cy);
    ctx.lineTo(left + size, cy);
    ctx.moveTo(cx, top);
    ctx.lineTo(cx, top + size);
    ctx.stroke();
    ctx.setLineDash([]);
    watched.forEach(({ support, colour }) => drawOutline(ctx, support, X, Y, scale, colour(), 2.2));
    watched.forEach(({ pair, colour }) => pair && drawTrail(ctx, pair, X, Y, t, colour()));
    if (alone && !watched.some(({ pair }) => pair)) drawTrail(ctx, alone, X, Y, t, ink.c1);
    if (planes) {
      const [y, z] = planes.map((plane) => Float64Array.from(plane.at(t)));
      ctx.strokeStyle = ink.body;
      ctx.lineWidth = 2;
      ctx.lineJoin = "round";
      ctx.beginPath();
      y.forEach((value, i) => ctx.lineTo(X(value), Y(z[i])));
      ctx.stroke();
      for (const x of loadPlaces) {
        const k = nearest(x);
        const [fy, fz] = forceAt(x, t);
        drawArrow(ctx, X(y[k]), Y(z[k]), (40 * fy) / force, (-40 * fz) / force, ink.accent, 2.2);
      }
    }
    for (const one of watched) {
      if (!one.pair) continue;
      const at = one.pair.map((probe) => stateAt(probe, t)[0]);
      drawDot(ctx, X(at[0]), Y(at[1]), 5, one.colour());
      drawPush(ctx, one, at, X, Y, struck);
    }
    if (alone) {
      const at = alone.map((probe) => stateAt(probe, t)[0]);
      if (!watched.some(({ pair }) => pair)) drawDot(ctx, X(at[0]), Y(at[1]), 5, ink.c1);
      const [fy, fz] = forceAt(null, t);
      drawArrow(ctx, X(at[0]), Y(at[1]), (40 * fy) / force, (-40 * fz) / force, ink.accent, 2.2);
    }
    ctx.restore();
    ctx.fillStyle = ink.soft;
    ctx.textBaseline = "alphabetic";
    ctx.textAlign = "right";
    ctx.fillText("y", left + size - 2, cy - 5);
    ctx.textAlign = "left";
    ctx.fillText("z", cx + 5, top + 10);
  };

  /** From the side: the displacement along y (plane 0) or z (1) along the structure. */
  const drawSide = (ctx, plane, [left, top, width, height], t, struck) => {
    const stations = planes[plane];
    const ends = endsOf(stations.x);
    const [a, b] = [left + 16, left + width - 16];
    const X = (x) => a + ((b - a) * (x - ends[0])) / (ends[1] - ends[0]);
    const middle = top + height / 2 + 6;
    const high = height / 2 - 16;
    const largest = Math.max(1e-300, ...stations.high, ...Array.from(stations.low, (u) => -u));
    const scale = Math.min(high / largest, supports.length ? (0.75 * high) / reach : Infinity);
    const Y = (u) => middle - scale * u;
    drawSwept(ctx, stations, X, Y);
    drawAtRest(ctx, a, b, middle);
    if (DATA.scene.ends) {
      drawEnd(ctx, a, middle, -1, DATA.scene.left);
      drawEnd(ctx, b, middle, 1, DATA.scene.right);
    }
    const u = Float64Array.from(stations.at(t));
    const line = (thick, colour) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = thick;
      ctx.beginPath();
      u.forEach((value, i) => ctx.lineTo(X(stations.x[i]), Y(value)));
      ctx.stroke();
    };
    line(7, ink.body);
    line(4, ink.mass);
    const wide = clamp(0.02 * (b - a), 3, 12);
    for (const { support, colour, of } of watched) {
      const x = placeAlong(support.at);
      if (!Number.isFinite(x)) continue;
      const [fresh, share] = of
        .map(({ index }) => struck[index])
        .reduce((best, one) => (one[0] > best[0] ? one : best), [0, 0]);
      roomOf(support, plane).forEach((edge, i) => {
        if (edge === undefined) return;
        const out = i ? -1 : 1;
        ctx.fillStyle = hatch(ctx);
        ctx.fillRect(X(x) - wide, Math.min(Y(edge), Y(edge) + 14 * out), 2 * wide, 14);
        ctx.strokeStyle = colour();
        ctx.lineWidth = 2.2;
        ctx.beginPath();
        ctx.moveTo(X(x) - wide, Y(edge));
        ctx.lineTo(X(x) + wide, Y(edge));
        ctx.stroke();
      });
      if (fresh > 0) {
        ctx.globalAlpha = fresh;
        const k = nearest(x);
        drawDot(ctx, X(x), Y(stations.at(t)[k]), 4 + 4 * Math.sqrt(share), colour());
        ctx.globalAlpha = 1;
      }
    }
    for (const x of loadPlaces) {
      const part = forceAt(x, t)[plane];
      drawArrow(ctx, X(x), Y(u[nearest(x)]), 0, (-34 * part) / force, ink.accent, 2.2);
    }
    const axis = plane ? "z" : "y";
    const magnified = DATA.scene.ends
      ? ` × ${digits(scale / (Math.abs(X(1) - X(0)) || 1), 3)}`
      : "";
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(
      `from the side: displacement along ${axis}${magnified}`,
      left + 4,
      top + 12,
      width - 8,
    );
  };

  const paint = (ctx, w, h, t) => {
    const struck = struckAt(t, memory);
    const beside = planes && w >= SIDE_BY_SIDE;
    const size = beside ? Math.min(h - 24, 0.42 * w) : Math.min(planes ? 0.5 * h : h - 24, w - 20);
    const left = beside ? 8 : (w - size) / 2;
    drawAxial(ctx, left, 18, size, t, struck);
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    const ends = extent(supports.flatMap(({ gaps }) => gaps)) || [0, most];
    const [least, largest] = ends.map((gap) => prefixed(gap, "m", 3));
    const scale = !supports.length
      ? `up to ${largest}`
      : least === largest
        ? `gaps ${least}`
        : `gaps ${least} to ${largest}`;
    ctx.fillText(
      `along the axis, ${scale}; trails: the last ${prefixed(glance(), "s", 2)}`,
      8,
      12,
      w - 16,
    );
    if (!planes) return;
    const from = beside ? 18 : 22 + size;
    const each = (h - from - (beside ? 4 : 2)) / 2;
    const [x, wide] = beside ? [left + size + 16, w - left - size - 24] : [4, w - 8];
    drawSide(ctx, 0, [x, from, wide, each], t, struck);
    drawSide(ctx, 1, [x, from + each, wide, each], t, struck);
  };
  const alt = "The structure in its supports, along its axis and from the side";
  const stage = new Stage(planes ? 400 : 322, alt, paint);
  stage.keys = watched.map(({ support, colour }) => swatch(support.name, colour));
  return stage;
}

/** Where contacts at a support are counted: its hole, or its flats with their outward normals. */
function struckPlaces(support) {
  const names = meetingPlaces();
  if (support.round)
    return [{ index: names.indexOf(support.name) }].filter(({ index }) => index >= 0);
  return support.directions
    .map((deg, i) => ({
      index: names.indexOf(`${support.name}-flat-${i + 1}`),
      direction: [Math.cos((deg * TURN) / 360), Math.sin((deg * TURN) / 360)],
    }))
    .filter(({ index }) => index >= 0);
}

/** The first two probes that watch along y and along z. */
function pairAlone() {
  const along = (degrees) => lead.probes.find(({ at }) => at && at.direction === degrees);
  const pair = [along(0), along(90)];
  return pair.every(Boolean) ? pair : null;
}
