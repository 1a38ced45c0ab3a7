// The derivatives of a run or an orbit by keys of its case.

function derivativeSection() {
  const { tables, growth, effects, remarks } = DATA.derivatives;
  const content = tables.flatMap(({ file, count, table: packed }) => {
    const table = tableOf(packed);
    const first = count > table.count ? `: the first ${table.count} of ${count} rows` : "";
    return [
      el("h3", {}, `${file}${first}`),
      sortable(
        columnsOf(
          table,
          table.names.map((name) => [name, name]),
        ),
        table.rows,
        { height: 60 + ROW * Math.min(table.count, 12) },
      ),
    ];
  });
  section(
    "derivatives",
    "Derivatives",
    DATA.orbit
      ? "Of each event of the orbit, and of its multipliers, by each key: by_KEY in a column's name."
      : "Of each contact, and of the state at each output time, by each key: by_KEY in a column's name. " +
        `Where growth is above ${digits(growth)}, a small change of the start has grown as many times, ` +
        "and a change of 1 % of a key is no longer small.",
    effects ? effectTable(effects) : null,
    remarks ? el("ul", { class: "notes" }, remarks.map((text) => el("li", {}, text))) : null,
    ...content,
  );
}

/** What 1 % more of each key changes at each wall. */
function effectTable({ header, rows }) {
  const columns = header.map((name, i) => wordColumn(name, (row) => row[i]));
  return sortable(columns, rows, { height: 60 + ROW * Math.min(rows.length, 12) });
}
