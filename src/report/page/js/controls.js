// Buttons, chips and sections.

const SYMBOLS = {
  play: "M3 1.5v13L14 8z",
  pause: "M3 2h3.6v12H3zM9.4 2H13v12H9.4z",
  previous: "M2 2h2.4v12H2zM14 2v12L5 8z",
  next: "M11.6 2H14v12h-2.4zM2 2v12l9-6z",
};

/** A small drawing for a button. */
function symbol(name) {
  const make = (tag, attributes) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    return node;
  };
  const svg = make("svg", { viewBox: "0 0 16 16", width: 15, height: 15, "aria-hidden": "true" });
  svg.append(make("path", { d: SYMBOLS[name], fill: "currentColor" }));
  return svg;
}

const button = (title, act, ...content) =>
  el("button", { type: "button", title, onclick: act }, ...content);

/** Buttons of which one is chosen: choices are [value, text]. */
function segmented(label, choices, chosen, choose) {
  const group = el("span", { class: "group", role: "group", "aria-label": label });
  const press = (value) =>
    [...group.children].forEach((child, i) => {
      child.setAttribute("aria-pressed", String(choices[i][0] === value));
    });
  for (const [value, text] of choices) {
    group.append(
      el(
        "button",
        {
          type: "button",
          onclick: () => {
            press(value);
            choose(value);
          },
        },
        text,
      ),
    );
  }
  press(chosen);
  return group;
}

/** A list to choose from: choices are [value, text]. */
function selection(label, choices, chosen, choose) {
  const options = choices.map(([value, text]) =>
    el("option", { value, selected: value === chosen }, text),
  );
  return el(
    "select",
    { "aria-label": label, onchange: (event) => choose(event.target.value) },
    options,
  );
}

/** A list to choose from with what is chosen beside it, which stands on paper in its place. */
function printed(select) {
  const text = () => select.selectedOptions[0].textContent;
  const chosen = el("span", { class: "chosen" }, text());
  select.addEventListener("change", () => {
    chosen.textContent = text();
  });
  return [select, chosen];
}

/** Samples of curves in chips and legends; drawn anew when colours change. */
const samples = [];

/** A sample of a line, with its marker where the curve has markers. */
function sampleOf(look, marked = false) {
  const canvas = el("canvas", { width: 90, height: 36, "aria-hidden": "true" });
  const draw = () => {
    const ctx = canvas.getContext("2d");
    ctx.setTransform(3, 0, 0, 3, 0, 0);
    ctx.clearRect(0, 0, 30, 12);
    ctx.strokeStyle = look.colour();
    ctx.lineWidth = look.width;
    ctx.setLineDash(look.dash);
    ctx.beginPath();
    ctx.moveTo(1, 6);
    ctx.lineTo(29, 6);
    ctx.stroke();
    ctx.setLineDash([]);
    ctx.fillStyle = ctx.strokeStyle;
    if (marked) drawMarker(ctx, look.marker, 15, 6, 3.4);
  };
  samples.push(draw);
  draw();
  return canvas;
}

/** A marker for a legend. */
function markerSample(kind) {
  const canvas = el("canvas", { width: 42, height: 42, "aria-hidden": "true" });
  const draw = () => {
    const ctx = canvas.getContext("2d");
    ctx.setTransform(3, 0, 0, 3, 0, 0);
    ctx.clearRect(0, 0, 14, 14);
    ctx.fillStyle = ctx.strokeStyle = ink.ink;
    drawMarker(ctx, kind, 7, 7, 4);
  };
  samples.push(draw);
  draw();
  return canvas;
}

/** Chips that switch things on and off: items are { label, look, shown }. */
function chips(items, changed) {
  const box = el("div", { class: "chips" });
  const press = () =>
    items.forEach((item, i) => box.children[i].setAttribute("aria-pressed", String(item.shown)));
  for (const item of items) {
    const toggle = () => {
      item.shown = !item.shown;
      // Something remains on the page.
      if (!items.some((other) => other.shown)) item.shown = true;
      press();
      changed();
    };
    box.append(
      el(
        "button",
        { type: "button", class: "chip", onclick: toggle },
        item.look ? sampleOf(item.look) : null,
        item.label,
      ),
    );
  }
  press();
  toggled.push(press);
  return box;
}

/** Chips of the runs, which every plot follows. */
const runChips = () =>
  chips(runs, () => {
    toggled.forEach((told) => told());
    refreshAll();
  });

/** A square of a colour and a name. */
function swatch(name, colour) {
  const square = el("i", { class: "swatch" });
  const paint = () => {
    square.style.background = colour();
  };
  samples.push(paint);
  paint();
  return el("span", { class: "key" }, square, name);
}

const sections = [];

/** A section of the page, with an entry in its menu. */
function section(id, title, lead, ...content) {
  const node = el(
    "section",
    { id },
    el("h2", {}, title),
    lead ? el("p", { class: "lead" }, lead) : null,
    ...content,
  );
  page.append(node);
  sections.push([id, title]);
  return node;
}
