// The drawing in motion beside the verdicts: play, pause, from contact to contact, slow motion.

/** A canvas that is drawn anew whenever the instant changes. */
class Stage {
  constructor(height, alt, paint) {
    this.canvas = el("canvas", { role: "img", "aria-label": alt });
    this.under = this.canvas;
    this.box = el("div", { class: "drawing" }, this.canvas);
    Object.assign(this, { height, paint, dirty: false });
    drawings.push(this);
    new ResizeObserver(refresh).observe(this.box);
  }

  draw() {}

  drawOver() {
    const width = widthOf(this.box);
    const ctx = fit(this.canvas, width, this.height);
    this.paint(ctx, width, this.height, now());
  }
}

/**
 * How lately each wall and round support was struck: [fresh, share], fresh from 1 (now) to 0 (`memory` seconds ago),
 * share that of the largest impulse of the run.
 */
function struckAt(t, memory) {
  const out = meetingPlaces().map(() => [0, 0]);
  const { start, end, wall, impulse, largest } = lead.contacts;
  const earliest = t - memory;
  for (let i = before(start, t), looked = 0; i >= 0 && looked < 400; i--, looked++) {
    const over = Number.isNaN(end[i]) ? t : Math.max(end[i], start[i]);
    if (over < earliest || out[wall[i]] === undefined) continue;
    const fresh = over >= t ? 1 : 1 - (t - over) / memory;
    if (fresh > out[wall[i]][0]) out[wall[i]] = [fresh, Math.abs(impulse[i]) / largest];
  }
  return out;
}

const SPEEDS = [1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001];

/** The speed at which a period of the load takes about 1.3 s. */
function fittingSpeed() {
  const wanted = (period || duration / 20) / 1.3;
  const off = (speed) => Math.abs(Math.log(speed / wanted));
  return SPEEDS.reduce((best, speed) => (off(speed) < off(best) ? speed : best), 1);
}

/** Drawing, its controls, and the cards of how far the run is to be trusted. */
function heroSection() {
  const bodies = Object.keys(lead.bodies).length > 0;
  const drawing =
    DATA.scene.planes === 2
      ? planesStage()
      : bodies
        ? bodiesStage()
        : DATA.scene.kind === "oscillator"
          ? bodyStage()
          : structureStage();
  // Of bodies in two planes, along the axis above and from the side below.
  const below = bodies && DATA.scene.planes === 2 ? bodiesStage() : null;
  state.speed = fittingSpeed();
  const play = button("Play or pause (space)", () => toggle());
  let last = null;
  const label = () =>
    play.replaceChildren(
      symbol(state.playing ? "pause" : "play"),
      state.playing ? " Pause" : " Play",
    );
  const tick = (stamp) => {
    if (!state.playing) return;
    if (last !== null) seek(state.time + (Math.min(stamp - last, 100) / 1e3) * state.speed);
    last = stamp;
    if (state.time >= duration) toggle();
    else requestAnimationFrame(tick);
  };
  const toggle = () => {
    state.playing = !state.playing;
    if (state.playing && state.time >= duration) state.time = 0;
    label();
    last = null;
    if (state.playing) requestAnimationFrame(tick);
  };
  const hop = (way) => {
    const { start, count } = lead.contacts;
    const i = before(start, state.time + (way > 0 ? 1e-9 : -1e-9)) + (way > 0 ? 1 : 0);
    if (count) seek(start[clamp(i, 0, count - 1)]);
  };
  const clock = el("span", { class: "clock" });
  tellers.push(() => {
    clock.textContent = `t = ${now().toFixed(5)} s${period ? ` · period ${(now() / period).toFixed(2)}` : ""}`;
  });
  const speeds = SPEEDS.map((speed) => [
    String(speed),
    speed === 1 ? "real time" : `1/${Math.round(1 / speed)} speed`,
  ]);
  const slow = selection("Speed", speeds, String(state.speed), (value) => {
    state.speed = +value;
  });
  document.addEventListener("keydown", (event) => {
    if (
      event.target.closest("input, select, button, summary, th, .scroll") ||
      event.ctrlKey ||
      event.metaKey ||
      event.altKey
    )
      return;
    const act = {
      " ": toggle,
      ArrowRight: () => hop(1),
      ArrowLeft: () => hop(-1),
      0: () => view.set(...view.full),
      "+": () => view.zoom(now(), 0.5),
      "-": () => view.zoom(now(), 2),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  label();
  const steps = el(
    "span",
    { class: "group" },
    button("Contact before (←)", () => hop(-1), symbol("previous")),
    play,
    button("Next contact (→)", () => hop(1), symbol("next")),
  );
  const stage = el(
    "div",
    { class: "stage" },
    drawing.box,
    below && below.box,
    drawing.keys && drawing.keys.length ? el("div", { class: "bar" }, drawing.keys) : null,
    el("div", { class: "bar controls" }, steps, slow, clock),
  );
  page.append(el("div", { class: "hero" }, stage, cardList()));
}

/** What each check said: never by colour alone. */
function cardList() {
  const sign = { good: "✓ ", mind: "△ ", bad: "✗ ", open: "" };
  const card = (c) =>
    el(
      "div",
      { class: `card ${c.state}` },
      el("h3", {}, c.title),
      el("b", { class: "verdict" }, sign[c.state] + c.verdict),
      c.text ? el("p", {}, c.text) : null,
    );
  const whose =
    runs.length > 1
      ? el("p", { class: "lead" }, `Of ${runs[0].label}, the first of the ${DATA.compare ? "methods" : "runs"}:`)
      : null;
  return el("div", { class: "cards" }, whose, (DATA.cards || []).map(card));
}

/** Numbers under their names. */
function factsOf(facts) {
  const fact = (f) =>
    el(
      "div",
      {},
      el("dt", {}, f.label),
      el("dd", {}, f.value, f.unit ? el("small", {}, ` ${f.unit}`) : null),
    );
  return el("dl", { class: "facts" }, facts.map(fact));
}
