// The player of armdyn.plotting.Animation, with the names between @ put in by animation.py. It makes
// every control itself, so that a page that runs no script shows the figure alone.
for (const root of document.querySelectorAll(`[data-armdyn-animation="@KEY@"]:not([data-live])`)) {
  const { lengths, arms, frames, start, step, speed, reach, colours, names, alt } = @DATA@;
  const size = 340, margin = 44, trail = 1.5, end = (frames - 1) * step;
  root.dataset.live = "";
  root.querySelector("[data-still-only]")?.remove();

  const n = lengths.length;
  // Thousandths of a radian, each frame as the change from the frame before.
  const angles = arms.map((deltas) => {
    const all = Float64Array.from(deltas);
    for (let i = n; i < all.length; i++) all[i] += all[i - n];
    return all.map((value) => value / 1000);
  });

  const make = (tag, properties, parent) => parent.appendChild(Object.assign(document.createElement(tag), properties));
  const player = make("div", { className: "armdyn-player" }, root);
  player.style.cssText = `width:${size}px;flex:none`;
  root.prepend(player);
  const canvas = make("canvas", { role: "img", ariaLabel: alt }, player);
  const scale = window.devicePixelRatio || 1;
  canvas.width = canvas.height = size * scale;
  canvas.style.cssText = `display:block;width:${size}px;height:${size}px`;
  const bar = make("div", {}, player);
  bar.style.cssText = "display:flex;align-items:center;gap:8px;font:13px sans-serif";
  const button = make("button", { type: "button" }, bar);
  button.style.cssText = "width:5em;font:inherit";
  const slider = make("input", { type: "range", min: 0, max: end, step: "any", value: 0, ariaLabel: "time" }, bar);
  slider.style.flex = "1";
  slider.dataset.lmSuppressShortcuts = "true"; // JupyterLab: its arrow keys are its own
  const clock = make("output", {}, bar);
  clock.style.cssText = "width:5.5em;text-align:right;font-variant-numeric:tabular-nums";

  const pen = canvas.getContext("2d");
  const half = 1.15 * reach;
  const place = (x) => margin + ((x + half) / (2 * half)) * (size - margin - 8);
  const x = place, y = (value) => size - place(value);

  function joints(angle, time) {
    const at = Math.min(time / step, frames - 1), k = Math.min(Math.floor(at), Math.max(frames - 2, 0));
    const points = [[0, 0]];
    for (let i = 0; i < n; i++) {
      const from = angle[k * n + i], to = angle[Math.min(k + 1, frames - 1) * n + i];
      const a = from + (at - k) * (to - from), [px, py] = points[i];
      points.push([px + lengths[i] * Math.cos(a), py + lengths[i] * Math.sin(a)]);
    }
    return points;
  }

  function line(points, colour, width, dash = []) {
    pen.beginPath();
    for (const [px, py] of points) pen.lineTo(x(px), y(py));
    Object.assign(pen, { strokeStyle: colour, lineWidth: width, lineCap: "round", lineJoin: "round" });
    pen.setLineDash(dash);
    pen.stroke();
  }

  function axes() {
    const power = 10 ** Math.floor(Math.log10(half));
    const tick = [0.2, 0.5, 1, 2, 5].map((s) => s * power).find((s) => half / s <= 2.5);
    Object.assign(pen, { fillStyle: "#000", font: "12px sans-serif" });
    for (let k = -Math.floor(half / tick); k * tick <= half; k++) {
      const value = k * tick, label = String(+value.toPrecision(3)).replace("-", "−");
      line([[value, -half], [value, half]], "#ddd", 1);
      line([[-half, value], [half, value]], "#ddd", 1);
      pen.textAlign = "center";
      pen.fillText(label, x(value), size - margin + 15);
      pen.textAlign = "right";
      pen.fillText(label, margin - 5, y(value) + 4);
    }
    line([[-half, half], [-half, -half], [half, -half]], "#000", 1);
    pen.textAlign = "center";
    pen.fillText("x (m)", x(0), size - margin + 32);
    pen.save();
    pen.translate(11, y(0));
    pen.rotate(-Math.PI / 2);
    pen.fillText("y (m)", 0, 0);
    pen.restore();
  }

  function draw(time) {
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, size, size);
    axes();
    angles.forEach((angle, arm) => {
      const dash = arm ? [2 + 4 * arm, 4] : [], way = [];
      for (let s = Math.max(0, time - trail * speed); s < time; s += step / 2) way.push(joints(angle, s).pop());
      const now = joints(angle, time);
      line([...way, now[n]], colours[arm], 1.5, dash);
      line(now, arms.length > 1 ? colours[arm] : "#777", 6);
      for (const point of now.slice(0, n)) {
        pen.beginPath();
        pen.arc(x(point[0]), y(point[1]), 4.5, 0, 7);
        Object.assign(pen, { fillStyle: "#fff", strokeStyle: "#000", lineWidth: 1.5 });
        pen.setLineDash([]);
        pen.fill();
        pen.stroke();
      }
      if (names[arm]) {
        Object.assign(pen, { fillStyle: colours[arm], textAlign: "left", font: "bold 12px sans-serif" });
        pen.fillText(names[arm], x(now[n][0]) + 7, y(now[n][1]) - 7);
      }
    });
    const text = `${(start + time).toFixed(2)} s`;
    clock.textContent = text;
    slider.value = time;
    slider.ariaValueText = text;
    root.dataset.time = time.toFixed(3);
  }

  let time = 0, playing = false, last = 0;
  function play(on) {
    playing = on;
    button.textContent = on ? "Pause" : "Play";
    if (on) requestAnimationFrame((now) => { last = now; tick(now); });
  }
  function tick(now) {
    if (!playing || !canvas.isConnected) return play(false);
    time = Math.min(time + ((now - last) / 1000) * speed, end);
    last = now;
    draw(time);
    if (time >= end) play(false);
    else requestAnimationFrame(tick);
  }
  button.onclick = () => {
    if (!playing && time >= end) time = 0;
    play(!playing);
  };
  slider.oninput = () => {
    time = Number(slider.value);
    draw(time);
  };
  play(false);
  draw(0);
}
