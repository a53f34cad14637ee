// The player of armdyn.plotting.Animation, with the names between @ put in by animation.py. It makes
// every control itself, so that a page that runs no script shows the figure alone.
for (const root of document.querySelectorAll(`[data-armdyn-animation="@KEY@"]:not([data-live])`)) {
  const { lengths, arms, frames, start, step, speed, reach, colours, names, alt, torques } = @DATA@;
  const size = 340, margin = 44, trail = 1.5, end = (frames - 1) * step;
  root.dataset.live = "";
  root.querySelector("[data-still-only]")?.remove();

@CONTROLS@
  // Whole numbers, each as the change from the one before.
  const summed = (deltas, unit) => {
    let sum = 0;
    return Float64Array.from(deltas, (delta) => (sum += delta) * unit);
  };
  const angles = arms.map((links) => links.map((deltas) => summed(deltas, 1e-3)));

  const paper = "var(--armdyn-paper)", ink = "currentColor";
  const player = make("div", { className: "armdyn-player" }, root);
  root.prepend(player);
  make("style", { textContent: `@STYLE@` }, player);
  const stage = make("div", {}, player);
  stage.style.cssText = `width:${torques ? 1.1 * size : size}px;max-width:100%`;
  stage.innerHTML = `<svg viewBox="0 0 ${size} ${size}" style="display:block;width:100%" role="img"></svg>`;
  const svg = stage.firstChild;
  svg.ariaLabel = alt;

  // A shape in the picture; without attributes it is drawn later.
  function put(tag, attributes, parent = svg) {
    const shape = parent.appendChild(document.createElementNS(svg.namespaceURI, tag));
    for (const [name, value] of Object.entries(attributes)) shape.setAttribute(name, value);
    return shape;
  }
  const write = (text, x, y, more = {}, parent = svg) =>
    (put("text", { x, y, fill: ink, "font-size": 12, "text-anchor": "middle", ...more }, parent).textContent = text);

  const half = 1.15 * reach;
  const place = (x) => margin + ((x + half) / (2 * half)) * (size - margin - 8);
  const inPixels = ([x, y]) => [place(x), size - place(y)];
  const through = (points) => points.map((point) => inPixels(point).map((x) => x.toFixed(2)).join()).join(" ");

  function axes() {
    const power = 10 ** Math.floor(Math.log10(half));
    const tick = [0.2, 0.5, 1, 2, 5].map((s) => s * power).find((s) => half / s <= 2.5);
    const line = (points, more) => put("polyline", { points: through(points), fill: "none", stroke: ink, ...more });
    for (let k = -Math.floor(half / tick); k * tick <= half; k++) {
      const value = k * tick, label = String(+value.toPrecision(3)).replace("-", "−");
      line([[value, -half], [value, half]], { opacity: 0.15 });
      line([[-half, value], [half, value]], { opacity: 0.15 });
      write(label, place(value), size - margin + 15);
      write(label, margin - 5, size - place(value) + 4, { "text-anchor": "end" });
    }
    line([[-half, half], [-half, -half], [half, -half]]);
    write("x (m)", place(0), size - margin + 32);
    write("y (m)", 11, size - place(0), { transform: `rotate(-90 11 ${size - place(0)})` });
  }
  axes();

  // Smoothly between frames, since a fast link turns far from one to the next: a cubic through four of them.
  function smoothAt(column, time) {
    const last = column.length - 1, at = Math.min(time / step, last), k = Math.min(Math.floor(at), last);
    const [a, b, c, d] = [k - 1, k, k + 1, k + 2].map((i) => column[Math.max(0, Math.min(i, last))]);
    const s = at - k;
    return b + 0.5 * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a)));
  }

  const n = lengths.length;
  function joints(arm, time) {
    const points = [[0, 0]];
    for (let i = 0; i < n; i++) {
      const a = smoothAt(angles[arm][i], time), [x, y] = points[i];
      points.push([x + lengths[i] * Math.cos(a), y + lengths[i] * Math.sin(a)]);
    }
    return points;
  }

  const round = { fill: "none", "stroke-linecap": "round", "stroke-linejoin": "round" };
  const drawn = arms.map((_, arm) => {
    const colour = colours[arm];
    const way = put("polyline", { ...round, stroke: colour, "stroke-width": 1.5, "stroke-dasharray": arm ? `${2 + 4 * arm} 4` : "none" });
    const links = put("polyline", { ...round, stroke: arms.length > 1 ? colour : "#777", "stroke-width": 6, "data-links": arm });
    const rings = lengths.map(() => put("circle", { r: 4.5, fill: paper, stroke: ink, "stroke-width": 1.5 }));
    const name = put("text", { fill: colour, "font-size": 12, "font-weight": "bold", stroke: paper, "stroke-width": 3, "paint-order": "stroke" });
    name.textContent = names[arm] ?? "";
    return { way, links, rings, name };
  });

@TORQUES@
  const numbers = torques && showTorques();

  function draw(time, playing) {
    const stands = arms.map((_, arm) => joints(arm, time));
    stands.forEach((now, arm) => {
      const { way, links, rings, name } = drawn[arm], tips = [];
      const dot = step / 3, first = Math.ceil(Math.max(0, time - trail * speed) / dot);
      for (let s = first; s * dot < time; s++) tips.push(joints(arm, s * dot)[n]);
      way.setAttribute("points", through([...tips, now[n]]));
      links.setAttribute("points", through(now));
      rings.forEach((ring, i) => {
        const [x, y] = inPixels(now[i]);
        ring.setAttribute("cx", x);
        ring.setAttribute("cy", y);
      });
      const [x, y] = inPixels(now[n]);
      const isRight = x > size - 60; // so that the name does not leave the picture
      name.setAttribute("text-anchor", isRight ? "end" : "start");
      name.setAttribute("x", isRight ? x - 7 : x + 7);
      name.setAttribute("y", y - 7 + (isRight ? 0 : 13 * arm));
    });
    numbers?.draw(time, playing, stands);
  }
  const again = addControls(stage, { end, from: 0, speed, zero: start, draw });
  if (numbers) numbers.onchange = again;
}
