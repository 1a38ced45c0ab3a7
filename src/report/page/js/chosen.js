// The orbit that was chosen on a branch: what is known of it, and the command that repeats it.

/** The command that finds the orbit of row i alone. */
function orbitCommand(points, i) {
  const data = DATA.continue;
  const { columns } = points;
  const [from, to] = [points.first[i], points.first[i + 1]];
  const set = `--set ${shellWord(`${data.path}=${points.value[i]}`)}`;
  const out = `--out branch-${columns.branch[i]}-point-${columns.point[i]}`;
  // A motion that meets no wall has no signature, and those of a structure are not all that there is
  // to it: a run settles on it.
  if (from === to || data.place) return `${data.command} ${set} ${out}`;
  const events = points
    .branchAt(i)
    .events.map(({ wall, kind }) => (kind === "impact" ? wall : `${wall}:${kind}`));
  const start = [];
  for (let k = from; k < to; k++) start.push(points.phases[k], points.speeds[k]);
  const symmetric = columns.symmetric[i] ? " --symmetric" : "";
  return `${data.command} ${set} --signature ${shellWord(events.join(","))} --periods ${columns.period[i]}${symmetric} --start=${start.join(",")} ${out}`;
}

/** The events of an orbit that is its own mirror image: those of its first half and their mirror. */
function unfolded(events, walls, periods) {
  const opposite = (name) => {
    const own = walls.find((wall) => wall.name === name);
    const others = walls.filter((wall) => own && wall.side !== own.side);
    const found =
      others.length > 1 ? others.find((wall) => wall.position === -own.position) : others[0];
    return found && found.name;
  };
  const mirror = events.map((event) => ({
    ...event,
    wall: opposite(event.wall),
    phase: event.phase + periods / 2,
  }));
  return mirror.every((event) => event.wall) ? [...events, ...mirror] : events;
}

/** The orbit of row i as orbit.js draws it, with the motion of the row `drawn`. */
function orbitOf(points, i, drawn) {
  const { columns, orbits, first } = points;
  const forcing = columns.period_s[i] / columns.period[i];
  const events = points.branchAt(i).events.map((event, k) => ({
    ...event,
    phase: points.phases[first[i] + k],
    speed: points.speeds[first[i] + k],
  }));
  const multipliers = points.multipliers(i);
  const walls = DATA.continue.walls.map((wall) => ({ ...wall, position: wall.position_m }));
  const periods = columns.period[i];
  const whole = columns.symmetric[i] ? unfolded(events, walls, periods) : events;
  const { place } = DATA.continue;
  const orbit = { forcing, periods, walls, place, events: whole, multipliers, T: [], Q: [], V: [] };
  if (drawn < 0) return orbit;
  const [from, to] = [orbits.first[drawn], orbits.first[drawn + 1] ?? orbits.phase.length];
  const part = (column) => column.subarray(from, to);
  Object.assign(orbit, refined(part(orbits.phase), part(orbits.q), part(orbits.v), forcing));
  return orbit;
}

/** The orbit of `choice.row`: { box, update(), listeners } */
function chosenOrbit(points, choice) {
  const shown = {
    orbit: { T: [], Q: [], V: [], events: [], walls: [], multipliers: [], periods: 1, forcing: 1 },
  };
  const { columns, orbits } = points;
  const drawnAt = new Map(orbits ? Array.from(orbits.row, (row, k) => [row, k]) : []);
  /** The drawn orbit nearest along the branch; −1 without one. */
  const drawnOf = (i) => {
    for (let off = 0; off < points.count; off++)
      for (const row of [i - off, i + off])
        if (columns.branch[row] === columns.branch[i] && drawnAt.has(row)) return drawnAt.get(row);
    return -1;
  };
  const { portrait, over, update: redraw } = orbitPlots(shown);
  const circle = multiplierPlot(shown);
  const facts = el("div");
  const events = el("div");
  const remark = el("p", { class: "lead" });
  const command = el("pre", { class: "command", tabindex: 0 });
  const listeners = [];
  const numbers = DATA.continue.branches.map(({ branch }) => branch);
  let rows = [];
  const go = (i) => {
    choice.row = i;
    update();
    refresh();
  };
  const slider = el("input", {
    type: "range",
    min: 0,
    step: 1,
    "aria-label": "Place along the branch",
    oninput: (event) => go(rows[+event.target.value]),
  });
  const branch = selection(
    "Branch",
    numbers.map((number) => [String(number), `branch ${number}`]),
    String(numbers[0]),
    (number) => {
      const own = points.rowsOf(+number);
      if (own.length) go(own[own.length >> 1]);
    },
  );
  const place = el("span");
  const step = (by) => () => go(rows[clamp(rows.indexOf(choice.row) + by, 0, rows.length - 1)]);
  const bar = el(
    "div",
    { class: "bar controls" },
    branch,
    button("The orbit before", step(-1), symbol("previous")),
    slider,
    button("The next orbit", step(1), symbol("next")),
    place,
  );
  const update = () => {
    const i = choice.row;
    const number = columns.branch[i];
    if (!rows.includes(i)) rows = points.rowsOf(number);
    slider.max = rows.length - 1;
    slider.value = rows.indexOf(i);
    branch.value = String(number);
    place.textContent = `point ${columns.point[i]}${points.label(i) ? `: ${points.label(i)}` : ""}`;
    const drawn = drawnOf(i);
    shown.orbit = orbitOf(points, i, drawn);
    const { orbit } = shown;
    const other = drawn >= 0 && orbits.row[drawn] !== i;
    remark.textContent = other
      ? `The motion drawn is that of point ${columns.point[orbits.row[drawn]]}, the nearest that orbits.csv has.`
      : "";
    remark.hidden = !other;
    const periods = columns.period[i];
    facts.replaceChildren(
      factsOf([
        { label: columnLabel(DATA.continue.key), value: digits(points.value[i], 8) },
        { label: "branch, point", value: `${number}, ${columns.point[i]}` },
        {
          label: "signature",
          value: signatureText(
            columns.signature[i],
            columns.symmetric[i],
            points.branchAt(i).events.length,
          ),
        },
        {
          label: "period",
          value: digits(columns.period_s[i], 6),
          unit: `s, ${periods} of the load`,
        },
        { label: "stability", value: points.state(i) },
        { label: "multipliers", value: multipliersText(orbit.multipliers) },
        { label: "largest |multiplier|", value: digits(largestModulus(orbit.multipliers), 6) },
      ]),
    );
    events.replaceChildren(el("h3", {}, "Events"), eventTable(orbit));
    const left = DATA.continue.place && !columns.stable[i];
    command.textContent = left ? "# none: runs leave an unstable orbit" : orbitCommand(points, i);
    redraw();
    circle.dirty = true;
    listeners.forEach((told) => told());
  };
  const drawings = orbits
    ? el("div", { class: "two" }, portrait.box, over.box)
    : el("p", { class: "lead" }, "The folder has no orbits.csv, from which the motion is drawn.");
  const box = el(
    "div",
    {},
    bar,
    facts,
    remark,
    drawings,
    el(
      "div",
      { class: "two" },
      el(
        "div",
        {},
        el("h3", {}, "Multipliers; inside the unit circle an orbit is stable"),
        circle.box,
      ),
      events,
    ),
    // Of a structure a run from the start of the case decides.
    el(
      "h3",
      {},
      DATA.continue.place
        ? "The command of the orbit on which a run settles here: where several are stable, maybe another"
        : "The command that finds this orbit again",
    ),
    command,
  );
  return { box, update, listeners };
}
