// A structure along a line: a tube in its supports, a bar, a chain of masses, or the watched places
// of any other. Above, its shape at the instant; below, the last periods in space against time, with
// a mark for every contact.

function structureStage() {
  const { kind, loads } = DATA.scene;
  const stations = stationsOf();
  const n = stations.x.length;
  const ends = endsOf(stations.x);
  /** Where along the structure a wall or load is; undefined where the drawing has no place for it. */
  const placeOf = (at) => {
    const x = lead.shape ? placeAlong(at) : at?.position;
    if (Number.isFinite(x) && !stations.names) return x;
    const i = (stations.ats || []).findIndex((other) => samePlace(other, at));
    return i >= 0 ? stations.x[i] : undefined;
  };
  const walls = DATA.scene.walls.filter(stands).map((wall) => ({ ...wall, x: placeOf(wall.at) }));
  const drawn = walls.filter((wall) => wall.x !== undefined);
  const most = Math.max(1e-300, ...stations.high, ...Array.from(stations.low, (u) => -u));
  const distances = drawn.map((wall) => Math.abs(wall.position));
  const [narrowest, gap] = [Math.min(...distances), Math.max(0, ...distances)];
  const memory = glance() * 0.14;
  const force = largestForce(loads) || 1;
  const thick = kind === "beam" ? 9 : 5;
  const middle = 118;
  const scale = Math.min(84 / most, gap > 0 ? 60 / gap : Infinity);
  const Y = (u) => middle - scale * u;
  const wallWidth = (X) => clamp(0.35 * Math.abs(X(1) - X(0)), 3, 17);

  /** A smooth curve through the stations; where there are few, with the slopes of their chords. */
  const curve = (ctx, X, u, begin = true) => {
    const { x } = stations;
    const slope = (k) => {
      const [a, b] = [Math.max(0, k - 1), Math.min(n - 1, k + 1)];
      return b > a ? (u[b] - u[a]) / (x[b] - x[a]) : 0;
    };
    if (begin) ctx.moveTo(X(x[0]), Y(u[0]));
    for (let i = 1; i < n; i++) {
      const d = (x[i] - x[i - 1]) / 3;
      ctx.bezierCurveTo(
        X(x[i - 1] + d),
        Y(u[i - 1] + d * slope(i - 1)),
        X(x[i] - d),
        Y(u[i] - d * slope(i)),
        X(x[i]),
        Y(u[i]),
      );
    }
  };

  const drawWall = (ctx, X, wall, [fresh, share]) => {
    const x = X(wall.x);
    const out = wall.side === "upper" ? -1 : 1;
    const y = Y(wall.position) + (out * thick) / 2;
    const wide = wallWidth(X);
    ctx.fillStyle = isElastic(wall) ? ink.tint : hatch(ctx);
    ctx.fillRect(x - wide, Math.min(y, y + 22 * out), 2 * wide, 22);
    const edge = (width, colour) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width;
      ctx.beginPath();
      ctx.moveTo(x - wide, y);
      ctx.lineTo(x + wide, y);
      ctx.stroke();
    };
    edge(2.4, ink.wall);
    if (!(fresh > 0)) return;
    ctx.globalAlpha = fresh;
    const colour = placeColour(wall.name);
    edge(2.4 + 5 * Math.sqrt(share), colour);
    drawArrow(ctx, x + out * Math.min(8, wide / 2), y, 0, -out * (16 + 70 * share), colour, 2.6);
    ctx.globalAlpha = 1;
  };

  const drawBody = (ctx, X, u) => {
    const line = (width, colour) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width;
      ctx.beginPath();
      curve(ctx, X, u);
      ctx.stroke();
    };
    if (DATA.scene.ends) {
      ctx.lineCap = "round";
      line(thick + 2, ink.body);
      line(thick - 2, ink.mass);
      ctx.lineCap = "butt";
      return;
    }
    const size = clamp(0.3 * Math.abs(X(1) - X(0)), 2.5, 9);
    ctx.strokeStyle = ink.faint;
    ctx.lineWidth = 1;
    ctx.beginPath();
    if (kind === "chain")
      stations.x.forEach((x, i) => (i ? ctx.lineTo(X(x), Y(u[i])) : ctx.moveTo(X(x), Y(u[i]))));
    ctx.stroke();
    ctx.fillStyle = ink.mass;
    ctx.strokeStyle = ink.body;
    ctx.lineWidth = 1.6;
    stations.x.forEach((x, i) => {
      ctx.beginPath();
      ctx.roundRect(X(x) - size, Y(u[i]) - size, 2 * size, 2 * size, 2);
      ctx.fill();
      ctx.stroke();
    });
  };

  const drawLoads = (ctx, X, u, t) => {
    for (const load of loads) {
      const x = placeOf(load.at);
      if (x === undefined) continue;
      const i = nearestTo(stations.x, x);
      drawArrow(ctx, X(x), Y(u[i]), 0, (-46 * forceOf(load, t)) / force, ink.accent, 2.4);
    }
  };

  const film = el("canvas");
  /** Displacement in space against time, the instant at the top. */
  const drawPast = (ctx, X, from, to, t) => {
    const span = glance();
    const rows = 110;
    const columns = DATA.scene.ends ? 90 : n;
    Object.assign(film, { width: columns, height: rows });
    const pen = film.getContext("2d");
    const image = pen.createImageData(columns, rows);
    const { x } = stations;
    for (let row = 0; row < rows; row++) {
      const s = t - (span * row) / (rows - 1);
      if (s < 0) break;
      const u = stations.at(s);
      for (let column = 0, i = 0; column < columns; column++) {
        const place =
          columns === n ? x[column] : ends[0] + ((ends[1] - ends[0]) * (column + 0.5)) / columns;
        while (i < n - 2 && x[i + 1] < place) i++;
        const j = Math.min(i + 1, n - 1);
        const part = j > i ? clamp((place - x[i]) / (x[j] - x[i]), 0, 1) : 0;
        const value = columns === n ? u[column] : u[i] + part * (u[j] - u[i]);
        const tone = divergingTone(value / most);
        image.data.set([...tone, 255], 4 * (row * columns + column));
      }
    }
    pen.putImageData(image, 0, 0);
    ctx.save();
    const [left, right] = [X(ends[0]), X(ends[1])];
    ctx.beginPath();
    ctx.rect(left, from, right - left, to - from);
    ctx.clip();
    ctx.imageSmoothingEnabled = columns !== n;
    ctx.drawImage(film, left, from, right - left, to - from);
    const { start, wall, impulse, largest } = lead.contacts;
    ctx.fillStyle = ink.ink;
    for (let i = before(start, t); i >= 0 && start[i] > t - span; i--) {
      const struck = walls[wall[i]];
      if (!struck || struck.x === undefined) continue;
      const up = struck.side === "upper";
      const size = 1.4 + 4 * Math.sqrt(Math.abs(impulse[i]) / largest);
      const aside = Math.min(7, wallWidth(X));
      drawMarker(
        ctx,
        up ? "triangle" : "down",
        X(struck.x) + (up ? -aside : aside),
        from + ((t - start[i]) / span) * (to - from),
        size,
      );
    }
    ctx.restore();
    ctx.strokeStyle = ink.faint;
    ctx.lineWidth = 1;
    ctx.strokeRect(left + 0.5, from + 0.5, right - left, to - from);
    drawLabel(
      ctx,
      `the last ${prefixed(span, "s", 2)}; ▲ ▼ contacts above and below`,
      left + 8,
      to - 12,
    );
  };

  const drawScale = (ctx, X, w, h) => {
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "center";
    ctx.textBaseline = "alphabetic";
    const places = DATA.scene.ends ? [...ends, ...drawn.map((wall) => wall.x)] : stations.x;
    let last = -Infinity;
    for (const x of [...new Set(places)].sort((a, b) => a - b)) {
      const text = stations.names
        ? stations.names[stations.x.indexOf(x)]
        : DATA.scene.ends
          ? `${digits(x)} m`
          : String(x);
      const at = clamp(X(x), 20, w - 24);
      const width = ctx.measureText(text).width;
      if (at - width / 2 < last + 8) continue;
      ctx.fillText(text, at, h - 10);
      last = at + width / 2;
    }
    ctx.textAlign = "left";
    const magnified = DATA.scene.ends
      ? `displacement × ${digits(scale / (Math.abs(X(1) - X(0)) || 1), 3)}`
      : `displacement upward, ${kind === "matrices" ? "degrees of freedom" : "masses"} by number`;
    const across = kind === "bar" ? " (along the bar, drawn upward)" : "";
    const least = narrowest < gap ? `${prefixed(narrowest, "m", 3)} to ` : "";
    const gaps = gap > 0 ? `, gaps ${least}${prefixed(gap, "m", 3)}` : `, up to ${prefixed(most, "m", 3)}`;
    ctx.fillText(
      `${stations.names ? `displacement of the watched places${lead.shape ? " and at the walls" : ""}` : magnified}${across}${gaps}; pale: where it has been`,
      6,
      16,
      w - 12,
    );
    const left = walls.length - drawn.length;
    const remarks = [
      !lead.shape && DATA.scene.ends ? "drawn through the watched places alone" : null,
      left ? `${left} of ${walls.length} walls, on relative motions or elsewhere, not drawn` : null,
    ];
    const remark = remarks.filter((text) => text).join("; ");
    if (remark) ctx.fillText(remark, 6, 32, w - 12);
  };

  const paint = (ctx, w, h, t) => {
    const [left, right] = [34, w - 34];
    const X = (x) => left + ((right - left) * (x - ends[0])) / (ends[1] - ends[0]);
    if (DATA.scene.ends) {
      ctx.fillStyle = clear(ink.c3, 0.2);
      ctx.beginPath();
      curve(ctx, X, stations.high);
      for (let i = n - 1; i >= 0; i--) ctx.lineTo(X(stations.x[i]), Y(stations.low[i]));
      ctx.fill();
    } else {
      ctx.strokeStyle = clear(ink.c3, 0.35);
      ctx.lineWidth = clamp(0.2 * Math.abs(X(1) - X(0)), 2, 10);
      stations.x.forEach((x, i) => {
        ctx.beginPath();
        ctx.moveTo(X(x), Y(stations.low[i]));
        ctx.lineTo(X(x), Y(stations.high[i]));
        ctx.stroke();
      });
    }
    drawAtRest(ctx, left, right, middle);
    const struck = struckAt(t, memory);
    walls.forEach((wall, i) => {
      if (wall.x !== undefined) drawWall(ctx, X, wall, struck[i]);
    });
    if (DATA.scene.ends) {
      drawEnd(ctx, left, middle, -1, DATA.scene.left);
      drawEnd(ctx, right, middle, 1, DATA.scene.right);
    }
    const u = Float64Array.from(stations.at(t));
    drawBody(ctx, X, u);
    drawLoads(ctx, X, u, t);
    drawPast(ctx, X, 222, h - 30, t);
    drawScale(ctx, X, w, h);
  };
  return new Stage(372, "The structure in its supports", paint);
}
