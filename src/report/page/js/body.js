// One mass between its walls, to scale, with spring, damper and load; below it the last periods
// falling away like a strip chart, walls in line with walls.

function zigzag(ctx, from, to, y, teeth, height) {
  for (let k = 0; k < teeth; k++)
    ctx.lineTo(from + ((to - from) * (k + 0.5)) / teeth, y + (k % 2 ? -height : height));
  ctx.lineTo(to, y);
}

function bodyStage() {
  const probe = lead.probes[0];
  const walls = DATA.scene.walls.filter(stands);
  const reach = Math.max(
    1e-12,
    ...probe.extents.Q.map(Math.abs),
    ...walls.map((wall) => 1.02 * Math.abs(wall.position)),
  );
  const [unit, factor] = lengthUnit(reach);
  const [speed, fast] = lengthUnit(Math.max(...probe.extents.V.map(Math.abs)));
  const force = largestForce(DATA.scene.loads) || 1;
  const memory = (period || duration / 50) * 0.25;
  const half = 46;
  const top = 38;
  const rail = 116;

  const drawPast = (ctx, w, h, t, X) => {
    const strip = rail + 34;
    const bottom = h - 6;
    const span = glance();
    const Y = (s) => strip + ((t - s) / span) * (bottom - strip);
    ctx.save();
    ctx.beginPath();
    ctx.rect(0, strip - 8, w, bottom - strip + 8);
    ctx.clip();
    for (const wall of walls) {
      const x = X(wall.position);
      ctx.fillStyle = isElastic(wall) ? clear(ink.accent, 0.09) : hatch(ctx);
      if (wall.side === "upper") ctx.fillRect(x, strip, w - x, bottom - strip);
      else ctx.fillRect(0, strip, x, bottom - strip);
      ctx.strokeStyle = ink.wall;
      ctx.lineWidth = 1.5;
      ctx.beginPath();
      ctx.moveTo(x, strip);
      ctx.lineTo(x, bottom);
      ctx.stroke();
    }
    ctx.strokeStyle = ink.c1;
    ctx.lineWidth = 1.8;
    ctx.lineJoin = "round";
    ctx.beginPath();
    ctx.moveTo(X(stateAt(probe, t)[0]), strip);
    const first = Math.max(0, before(probe.T, t - span));
    for (let i = before(probe.T, t); i >= first; i--) ctx.lineTo(X(probe.Q[i]), Y(probe.T[i]));
    ctx.stroke();
    const fade = ctx.createLinearGradient(0, strip, 0, bottom);
    fade.addColorStop(0.45, clear(ink.sheet, 0));
    fade.addColorStop(1, clear(ink.sheet, 0.95));
    ctx.fillStyle = fade;
    ctx.fillRect(0, strip, w, bottom - strip);
    ctx.restore();
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(`the last ${prefixed(span, "s", 2)}`, 12, h - 12);
  };

  const drawSupport = (ctx, w, x, cx) => {
    const ground = 16;
    const face = x - half;
    ctx.strokeStyle = ink.wall;
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.moveTo(ground, top - 8);
    ctx.lineTo(ground, rail);
    ctx.stroke();
    ctx.fillStyle = hatch(ctx);
    ctx.fillRect(4, top - 8, 12, rail - top + 8);
    ctx.lineWidth = 1.2;
    ctx.strokeStyle = ink.faint;
    ctx.beginPath();
    ctx.moveTo(ground, rail + 0.5);
    ctx.lineTo(w - 12, rail + 0.5);
    ctx.stroke();
    ctx.strokeStyle = ink.soft;
    ctx.lineWidth = 1.6;
    if (DATA.scene.stiffness > 0) {
      const y = top + 22;
      ctx.beginPath();
      ctx.moveTo(ground, y);
      ctx.lineTo(ground + 10, y);
      zigzag(ctx, ground + 10, face - 8, y, 11, 7);
      ctx.lineTo(face, y);
      ctx.stroke();
    }
    if (DATA.scene.damping > 0) {
      const y = top + 52;
      const pot = ground + 0.45 * (cx - half - ground);
      const piston = clamp(pot + 12 + 0.4 * (x - cx), pot, pot + 24);
      ctx.beginPath();
      ctx.moveTo(ground, y);
      ctx.lineTo(pot - 6, y);
      ctx.moveTo(pot + 26, y - 8);
      ctx.lineTo(pot - 6, y - 8);
      ctx.lineTo(pot - 6, y + 8);
      ctx.lineTo(pot + 26, y + 8);
      ctx.moveTo(face, y);
      ctx.lineTo(piston, y);
      ctx.moveTo(piston, y - 6);
      ctx.lineTo(piston, y + 6);
      ctx.stroke();
    }
  };

  /** A post that the side of the body meets; an elastic wall is a plate before a coil. */
  const drawWall = (ctx, w, wall, [fresh, share], q, X) => {
    const out = wall.side === "upper" ? 1 : -1;
    const soft = isElastic(wall);
    const pushed = soft && out * (q - wall.position) > 0;
    const x = X(pushed ? q : wall.position) + out * half;
    const upright = (at, y0, y1, width, colour) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width;
      ctx.beginPath();
      ctx.moveTo(at, y0);
      ctx.lineTo(at, y1);
      ctx.stroke();
    };
    if (soft) {
      const end = out > 0 ? w - 22 : 44;
      ctx.strokeStyle = ink.soft;
      ctx.lineWidth = 1.6;
      ctx.beginPath();
      ctx.moveTo(x, top + 37);
      zigzag(ctx, x, end, top + 37, 9, 8);
      ctx.stroke();
      ctx.fillStyle = hatch(ctx);
      ctx.fillRect(out > 0 ? end : end - 12, top - 8, 12, rail - top + 8);
      upright(end, top - 8, rail, 2, ink.wall);
      upright(x, top - 4, rail - 4, 3, ink.wall);
    } else {
      // A lower wall leaves room for the spring behind it.
      const parts =
        out > 0
          ? [[top - 12, rail]]
          : [
              [top - 12, top + 8],
              [top + 66, rail],
            ];
      for (const [y0, y1] of parts) {
        ctx.fillStyle = ink.sheet;
        ctx.fillRect(Math.min(x, x + out * 15), y0, 15, y1 - y0);
        ctx.fillStyle = hatch(ctx);
        ctx.fillRect(Math.min(x, x + out * 15), y0, 15, y1 - y0);
        upright(x, y0, y1, 2.4, ink.wall);
        ctx.globalAlpha = fresh;
        if (fresh > 0) upright(x, y0, y1, 2.4 + 5 * Math.sqrt(share), placeColour(wall.name));
        ctx.globalAlpha = 1;
      }
    }
    const label = `${wall.name}  ${digits(wall.position * factor)} ${unit}`;
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "center";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(label, clamp(X(wall.position) + out * (half + 6), 60, w - 60), top - 18);
    ctx.globalAlpha = fresh;
    if (fresh > 0)
      drawArrow(ctx, x, top + 37, -out * (14 + 60 * share), 0, placeColour(wall.name), 2.6);
    ctx.globalAlpha = 1;
  };

  const paint = (ctx, w, h, t) => {
    const cx = w / 2;
    const X = (q) => cx + ((w / 2 - half - 62) / reach) * q;
    const [q, v] = stateAt(probe, t);
    const x = X(q);
    drawPast(ctx, w, h, t, X);
    ctx.save();
    ctx.setLineDash([2, 3]);
    ctx.strokeStyle = ink.c1;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(x, rail);
    ctx.lineTo(x, rail + 34);
    ctx.stroke();
    ctx.restore();
    drawSupport(ctx, w, x, cx);
    const struck = struckAt(t, memory);
    walls.forEach((wall, i) => drawWall(ctx, w, wall, struck[i], q, X));
    ctx.fillStyle = ink.mass;
    ctx.strokeStyle = ink.body;
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.roundRect(x - half, top, 2 * half, rail - top - 2, 5);
    ctx.fill();
    ctx.stroke();
    ctx.fillStyle = ink.ink;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.font = "600 " + font(1.08);
    ctx.fillText(prefixed(DATA.scene.mass * 1e3, "g"), x, rail - 18);
    ctx.font = font();
    const load = DATA.scene.loads.reduce((sum, one) => sum + forceOf(one, t), 0);
    drawArrow(ctx, x, top + 26, (40 * load) / force, 0, ink.accent, 2.4);
    ctx.fillStyle = ink.soft;
    ctx.textAlign = "right";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(
      `u = ${digits(q * factor)} ${unit}   v = ${digits(v * fast)} ${speed}/s`,
      w - 12,
      h - 12,
    );
  };
  return new Stage(322, "The mass between its walls", paint);
}
