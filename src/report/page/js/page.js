// The page in its order: this file runs last.

function themeTo(name) {
  root.dataset.theme = name;
  readInks();
  samples.forEach((draw) => draw());
  refreshAll();
}

function headSection() {
  const menu = el("nav", { "aria-label": "Sections" });
  page.append(
    el(
      "header",
      {},
      el(
        "div",
        { class: "what" },
        el("h1", {}, DATA.title),
        DATA.subtitle ? el("p", {}, DATA.subtitle) : null,
      ),
      menu,
    ),
  );
  return menu;
}

/** What the program has to say of the results. */
function noteSection() {
  const notes = (DATA.notes || []).map((note) =>
    el("li", {}, worded(note.charAt(0).toUpperCase() + note.slice(1))),
  );
  if (notes.length) section("notes", "Notes", null, el("ul", { class: "notes" }, notes));
}

/** The command that repeats this, case and summary. */
function textSection() {
  const folded = (title, text) =>
    text ? el("details", {}, el("summary", {}, title), el("pre", { tabindex: 0 }, text)) : null;
  const buttons = [
    DATA.case
      ? button(
          "The case as it was run",
          () => save(`${DATA.name}.toml`, DATA.case, "text/plain"),
          "Save the case",
        )
      : null,
    DATA.summary
      ? button(
          "Every number",
          () => save("summary.json", JSON.stringify(DATA.summary, null, 2), "application/json"),
          "Save the summary",
        )
      : null,
    runs.length
      ? button(
          "Displacement and velocity of the run drawn, to seven digits",
          saveMotion,
          "Save the motion",
        )
      : null,
  ];
  section(
    "text",
    "To repeat it",
    null,
    DATA.command ? el("pre", { tabindex: 0 }, DATA.command) : null,
    folded("The case", DATA.case),
    folded(DATA.wear ? "The summary of the first window, every number" : "The summary, every number", DATA.summary && JSON.stringify(DATA.summary, null, 2)),
    el("div", { class: "bar controls" }, buttons),
  );
}

/** The motion of the first window of wear, whose other sections follow as on the page of a run. */
function oneMotion() {
  const { seeds } = DATA.wear;
  firstInstant();
  section(
    "one-motion",
    "One motion",
    `History 1${seeds > 1 ? ` of ${seeds}` : ""}, its first window: the run in the gaps of the start. ` +
      "What follows is of this run alone; first-window/ has its files.",
  );
  heroSection();
  motionSection();
}

function saveMotion() {
  const names = lead.probes.flatMap((probe) => {
    const end = probe.name ? `_${probe.name.replace(/-/g, "_")}` : "";
    return [`displacement${end}_m`, `velocity${end}_m_per_s`];
  });
  const seven = (x) => +x.toPrecision(7);
  const columns = DATA.runs[runs.indexOf(lead)].probes.flatMap((probe) => [
    decode(probe.q),
    decode(probe.v),
  ]);
  const rows = Array.from(lead.time, (t, i) => [t, ...columns.map((column) => seven(column[i]))]);
  save("trajectory.csv", csvText([["time_s", ...names], ...rows]), "text/csv");
}

/** On paper every drawing is a picture in the light theme: not every browser prints canvases. */
let themeOnScreen = "light";
function paper(on) {
  if (on === printing) return;
  printing = on;
  root.classList.toggle("paper", on);
  if (on) themeOnScreen = root.dataset.theme;
  root.dataset.theme = on ? "light" : themeOnScreen;
  readInks();
  samples.forEach((draw) => draw());
  tables.forEach((fill) => fill());
  document.querySelectorAll("img.print").forEach((image) => image.remove());
  refreshAll();
  drawNow();
  if (!on) return;
  for (const { under } of drawings)
    under.after(el("img", { class: "print", alt: "", src: under.toDataURL() }));
}

/** More periods than this in one plot are a block of ink. */
const MANY = 60;

/** The instant shown first: the hardest impact of what is in view, or the hardest contact. */
function firstInstant() {
  const { start, impulse, peak, count } = lead.contacts;
  const weight = (k) => Math.abs(impulse[k]) + (Number.isNaN(peak[k]) ? lead.contacts.largest : 0);
  let best = -1;
  for (let k = 0; k < count; k++)
    if (start[k] <= view.hi && (best < 0 || weight(k) > weight(best))) best = k;
  if (best >= 0) state.time = Math.min(duration, start[best] + 0.02 * glance());
  // Of a run of very many periods a stretch in which they can be told apart; the strip below the
  // plots shows which.
  const many = period && view.hi - view.lo > MANY * period;
  if (many) view.set(state.time - 5 * period, state.time + 15 * period);
}

root.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
readInks();
const menu = headSection();
// What a study is made for stands before its first run.
if (DATA.kind === "run" && DATA.summary.realisations) {
  meansSection(
    DATA.summary.realisations,
    "Means over realisations",
    (count) => `${count} realisations`,
  );
  whereSection();
  realisationsSection();
}
if (DATA.compare && DATA.compare.means) methodMeansSection();
if (lead && !DATA.wear && lead.probes.length && duration > 0) {
  if (DATA.compare && DATA.horizon) view.set(0, DATA.horizon);
  if (DATA.draw_count)
    section(
      "one-draw",
      `Draw 1 of ${DATA.draw_count}`,
      "The drawings and the numbers from here on are of this draw alone.",
    );
  firstInstant();
  heroSection();
}
if (DATA.orbit) orbitHead();
if (DATA.facts) page.append(factsOf(DATA.facts));
if (DATA.compare) compareSection();
if (lead && !DATA.wear && lead.probes.length) motionSection();
if (DATA.chart) chartSection();
if (DATA.stability) stabilitySection();
if (DATA.sweep) sweepSection();
if (DATA.wear) {
  wearSection();
  if (DATA.scene) wornWhereSection();
  realisationsSection();
  if (DATA.wear.first)
    meansSection(
      DATA.wear.first,
      "Work rates and forces of the first runs",
      (count) => `the first runs of the ${count} histories, in the gaps of the start`,
    );
  if (DATA.turbulence || DATA.margins) flowSection();
  if (lead && lead.probes.length && duration > 0) oneMotion();
}
if (DATA.continue) branchSection();
if (DATA.orbit) orbitSections();
if (lead && lead.probes.length) phaseSection();
const hasSupports = ["run", "wear"].includes(DATA.kind) && (DATA.summary?.supports || []).length > 0;
if (hasSupports) {
  if (DATA.kind === "run" && !DATA.summary.realisations) whereSection();
  supportSection();
}
if (lead && runs.some((run) => run.contacts.count)) contactSection();
if (DATA.derivatives) derivativeSection();
if (!DATA.wear && (DATA.turbulence || DATA.margins)) flowSection();
if (DATA.kind === "run" && DATA.summary.statistics && DATA.summary.statistics.walls.length)
  statisticsSection();
if (hasSupports || DATA.wear)
  definitionSection([
    ...SUPPORT_WORDS,
    ...(DATA.wear || DATA.summary.realisations?.worn?.length ? DEPTH_WORDS : []),
    ...(DATA.wear ? HISTORY_WORDS : []),
    ...((DATA.draws?.seeds || []).length ? DRAW_WORDS : []),
  ]);
noteSection();
textSection();
menu.append(
  ...sections
    .filter(([id]) => id !== "text")
    .map(([id, title]) => el("a", { href: `#${id}` }, title)),
  el(
    "button",
    {
      type: "button",
      title: "Light or dark",
      "aria-label": "Light or dark",
      onclick: () => themeTo(isDark() ? "light" : "dark"),
    },
    "◐",
  ),
  button("Print, or save as PDF", () => print(), "Print"),
);
page.append(el("footer", {}, `${DATA.program} · one file, no network: everything shown is in it`));
addEventListener("beforeprint", () => paper(true));
addEventListener("afterprint", () => paper(false));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) =>
  themeTo(event.matches ? "dark" : "light"),
);
tellers.forEach((tell) => tell());
refresh();
requestAnimationFrame(() =>
  requestAnimationFrame(() => {
    root.dataset.ready = String(Math.round(performance.now()));
    root.dataset.drawings = String(drawings.length);
  }),
);
