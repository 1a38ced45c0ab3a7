// The cheapest method of each kind at each error: a row for each error, a column for each kind.

/** The table for the error of that column of work-precision.csv; null where nothing is known of it. */
function cheapestTable(cheapest, column) {
  const rows = (cheapest || []).filter((row) => row.error === DATA.chart.names[column]);
  if (!rows.length) return null;
  const kinds = [...new Set(rows.map((row) => row.kind))];
  const tolerances = [...new Set(rows.map((row) => row.tolerance))];
  const found = (tolerance, kind) =>
    rows.find((row) => row.tolerance === tolerance && row.kind === kind);
  const cell = (row, least) => {
    if (!row.method) return el("td", { class: "none" }, row.missed || "–");
    return el(
      "td",
      { class: row.seconds === least ? "best" : null, title: row.method },
      el("b", {}, prefixed(row.seconds, "s", 2)),
      ` ${row.label}`,
      row.step_s ? el("small", {}, ` step ${prefixed(row.step_s, "s", 2)}`) : null,
    );
  };
  const line = (tolerance) => {
    const own = kinds.map((kind) => found(tolerance, kind));
    const least = Math.min(...own.filter((row) => row.method).map((row) => row.seconds));
    const within = tolerance < 1e-3 ? `10${raised(Math.round(Math.log10(tolerance)))}` : own[0].within;
    return el("tr", {}, el("td", {}, within), own.map((row) => cell(row, least)));
  };
  const head = ["error within", ...kinds].map((text) => el("th", { scope: "col" }, text));
  return el(
    "div",
    { class: "scroll" },
    el(
      "table",
      { class: "plain cheapest" },
      el("thead", {}, el("tr", {}, head)),
      el("tbody", {}, tolerances.map(line)),
    ),
  );
}
