// What the pointer does in a plot, and what is told of the point under it.

/** Pointer and wheel: drag to zoom, shift-drag to move, ctrl-wheel, double click for all. */
function listen(plot) {
  const surface = plot.overlay;
  const place = (event) => {
    const box = surface.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  let down = null;
  surface.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    down = { at: place(event), view: plot.view && [plot.view.lo, plot.view.hi] };
    if (event.pointerType !== "touch") surface.setPointerCapture(event.pointerId);
  });
  surface.addEventListener("pointermove", (event) => {
    const at = place(event);
    if (down && plot.view && event.shiftKey) {
      const shift = ((down.view[1] - down.view[0]) * (down.at[0] - at[0])) / (plot.x1 - plot.x0);
      plot.view.set(down.view[0] + shift, down.view[1] + shift);
      return;
    }
    if (down && plot.view && Math.abs(at[0] - down.at[0]) > 4) {
      plot.selection = [down.at[0], at[0]].map((x) => clamp(x, plot.x0, plot.x1));
    }
    const inside = at[0] >= plot.x0 && at[0] <= plot.x1 && at[1] >= plot.y0 && at[1] <= plot.y1;
    if (plot.hover) plot.hover(inside ? plot.tx(at[0]) : null, at, plot);
    refresh();
  });
  surface.addEventListener("pointerup", (event) => {
    const at = place(event);
    if (plot.selection) {
      const [a, b] = plot.selection.map((x) => plot.tx(x)).sort((x, y) => x - y);
      plot.selection = null;
      plot.view.set(a, b);
    } else if (down && plot.click) {
      plot.click(plot.tx(at[0]), at, plot);
    }
    down = null;
    refresh();
  });
  const left = () => {
    down = null;
    plot.selection = null;
    if (plot.hover) plot.hover(null, null, plot);
    refresh();
  };
  surface.addEventListener("pointerleave", left);
  surface.addEventListener("pointercancel", left);
  surface.addEventListener("dblclick", () => plot.view && plot.view.set(...plot.view.full));
  // The wheel alone scrolls the page: a report of six plots could not be read otherwise.
  surface.addEventListener(
    "wheel",
    (event) => {
      if (!plot.view || !(event.ctrlKey || event.metaKey || event.altKey)) return;
      event.preventDefault();
      plot.view.zoom(plot.tx(place(event)[0]), Math.exp(0.0022 * event.deltaY));
    },
    { passive: false },
  );
}

/** Tells about the point under the pointer: the nearest of `points()` within 14 pixels. */
function tellNearest(plot, points, text) {
  const tip = el("div", { class: "tip", hidden: true });
  plot.box.append(tip);
  plot.found = null;
  plot.hover = (_, at) => {
    plot.found = null;
    let nearest = 14 ** 2;
    if (at) {
      for (const point of points()) {
        const distance = (plot.sx(point.x) - at[0]) ** 2 + (edgeOf(plot, point.y) - at[1]) ** 2;
        if (distance < nearest) [nearest, plot.found] = [distance, point];
      }
    }
    showTip(
      plot,
      tip,
      plot.found && text(plot.found),
      plot.found && [plot.sx(plot.found.x), edgeOf(plot, plot.found.y)],
    );
  };
  plot.over = (ctx) => {
    if (plot.found) drawRing(ctx, plot.sx(plot.found.x), edgeOf(plot, plot.found.y), 8, ink.c2);
  };
}

/** Shows `text` beside the place, within the plot; hides the tip without text. */
function showTip(plot, tip, text, at) {
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const { offsetWidth: width, offsetHeight: height } = tip;
  tip.style.left = `${clamp(at[0] + 12, 0, Math.max(0, plot.w - width))}px`;
  tip.style.top = `${at[1] - height - 10 > 0 ? at[1] - height - 10 : at[1] + 14}px`;
}
