// Tables that sort by any column. Only the rows in view exist, so that 100 000 are no matter.

const ROW = 28;
/** Rows of a table on paper. */
const PRINTED = 40;
/** A text of more characters than this may be cut in a cell. */
const LONG = 40;
/** Tables that are filled anew for paper. */
const tables = [];

/**
 * Columns: { name, title, text (true for words), value(row), show(row) }. Options: height, by (index
 * of the column sorted by), up, pick(row) on a click, sorted(index), current() for the row marked,
 * wrapped (headings may have several lines, and the first column stays in view).
 */
function sortable(columns, rows, options = {}) {
  const height = options.height || 400;
  let order = rows.map((_, i) => i);
  let { by = null, up = true } = options;
  const head = el("tr");
  const body = el("tbody");
  const box = el(
    "div",
    { class: "scroll", tabindex: 0, style: { maxHeight: `${height}px` } },
    el("table", { class: options.wrapped ? "wrapped" : null }, el("thead", {}, head), body),
  );

  const compare = (a, b) => {
    if (typeof a === "string" || typeof b === "string")
      return String(a).localeCompare(String(b), "en", { numeric: true });
    return (Number.isNaN(a) || a === null) - (Number.isNaN(b) || b === null) || a - b;
  };
  const sort = () => {
    if (by === null) return;
    const keys = rows.map((row) => columns[by].value(row));
    order.sort((i, j) => (up ? 1 : -1) * compare(keys[i], keys[j]));
  };
  const line = (i) => {
    const cells = columns.map((column) => {
      const text = column.show(rows[i]);
      // Rows have one height: of a long text the rest is told where the pointer rests.
      const title = String(text).length > LONG ? text : null;
      return el("td", { class: text === "–" ? "none" : null, title }, text);
    });
    const tr = el("tr", {}, cells);
    tr.style.height = `${ROW}px`;
    if (options.pick) tr.addEventListener("click", () => options.pick(rows[i]));
    return tr;
  };
  const space = (count) => el("tr", { class: "space", style: { height: `${count * ROW}px` } });
  const fill = () => {
    const from = printing ? 0 : clamp(Math.floor(box.scrollTop / ROW) - 8, 0, rows.length);
    const to = printing
      ? Math.min(rows.length, PRINTED)
      : Math.min(rows.length, from + Math.ceil(height / ROW) + 18);
    const after = printing ? 0 : rows.length - to;
    const rest = printing && to < rows.length ? `and ${counted(rows.length - to)} rows more` : null;
    body.replaceChildren(
      space(from),
      ...order.slice(from, to).map(line),
      rest ? el("tr", {}, el("td", { colspan: columns.length }, rest)) : space(after),
    );
  };
  const choose = (i) => {
    up = by === i ? !up : columns[i].text === true || columns[i].up === true;
    by = i;
    mark();
    sort();
    fill();
    if (options.sorted) options.sorted(i);
  };
  const mark = () =>
    [...head.children].forEach((th, i) => {
      if (i === by) th.setAttribute("aria-sort", up ? "ascending" : "descending");
      else th.removeAttribute("aria-sort");
    });
  columns.forEach((column, i) =>
    head.append(
      el(
        "th",
        {
          scope: "col",
          tabindex: 0,
          title: column.title || "Sort",
          onclick: () => choose(i),
          onkeydown: (event) => {
            if (event.key === "Enter" || event.key === " ") {
              event.preventDefault();
              choose(i);
            }
          },
        },
        column.name,
      ),
    ),
  );
  box.addEventListener("scroll", fill);
  tables.push(fill);
  mark();
  sort();
  fill();
  return box;
}

/** A column of words. */
const wordColumn = (name, of) => ({ name, text: true, value: of, show: of });

/**
 * Columns of a table of the data, all of them or those named: [name, text of the header]. Those of
 * `whole` have as many digits as tell their values apart.
 */
function columnsOf(table, named, whole = []) {
  return named
    .filter(([name]) => table.columns[name])
    .map(([name, title]) => {
      const values = table.columns[name];
      const words = Array.isArray(values);
      const n = whole.includes(name) && !words ? digitsApart(values) : 4;
      return {
        name: title,
        text: words,
        value: (i) => values[i],
        show: (i) => (words ? values[i] || "–" : digits(values[i], n)),
      };
    });
}

/** A table of the data as lines of cells, the header first. */
const linesOf = ({ names, rows, columns }) => [
  names,
  ...rows.map((i) => names.map((name) => columns[name][i])),
];

/** A button that saves `lines()` as a CSV file. */
const saveBar = (file, lines, title = "The table above", words = `Save ${file}`) =>
  el(
    "div",
    { class: "bar controls" },
    button(title, () => save(file, csvText(lines()), "text/csv"), words),
  );
