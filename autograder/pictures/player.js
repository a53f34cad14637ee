// Puts a still picture into the page as SVG, in the colours of the page's theme, and plays it if it has
// a motion. Names between @ are put in by page.py. A page that runs no script shows the image alone.
for (const root of document.querySelectorAll(`[data-armdyn-picture="@KEY@"]:not([data-live])`)) {
  const { step, frames, panels, slower } = @DATA@;
  root.dataset.live = "";
  const image = root.querySelector("img");
  const bytes = Uint8Array.from(atob(image.src.split(",")[1]), (letter) => letter.charCodeAt(0));
  const parsed = new DOMParser().parseFromString(new TextDecoder().decode(bytes), "image/svg+xml");
  const svg = document.importNode(parsed.documentElement, true);
  image.replaceWith(svg);
  root.querySelector("[data-still-only]")?.remove();
  if (!frames) continue;

  const make = (tag, properties, parent) =>
    parent.appendChild(Object.assign(document.createElement(tag), properties));
  const bar = make("div", {}, root);
  bar.style.cssText = "display:flex;align-items:center;gap:8px;max-width:560px;font:13px sans-serif";
  const button = make("button", { type: "button" }, bar);
  button.style.cssText = "width:5em;font:inherit";
  const end = (frames - 1) * step;
  const slider = make(
    "input", { type: "range", min: 0, max: end, step: "any", value: end, ariaLabel: "time" }, bar);
  slider.style.flex = "1";
  slider.dataset.lmSuppressShortcuts = "true"; // JupyterLab: its arrow keys are its own
  const clock = make("output", { ariaLive: "off" }, bar);
  clock.style.cssText = "width:4.5em;text-align:right;font-variant-numeric:tabular-nums";

  const moving = [...svg.querySelectorAll("[data-panel]")].flatMap((panel, k) =>
    [...panel.querySelectorAll("[data-moves]")].map((part, i) => [part, panels[k][i]]));
  const cursors = [...svg.querySelectorAll("[data-cursor]")];
  for (const cursor of cursors) cursor.removeAttribute("display");

  function draw(time) {
    for (const [part, columns] of moving) {
      const [x, y, turn, stretch] = columns.map((column) => {
        if (!Array.isArray(column)) return column;
        // A motion that stopped earlier stays where it is.
        const last = column.length - 1, at = Math.min(time / step, last);
        const k = Math.floor(at), from = column[k], to = column[Math.min(k + 1, last)];
        return (from + (at - k) * (to - from)).toFixed(3);
      });
      part.setAttribute("transform", `translate(${x} ${y}) rotate(${turn}) scale(${stretch} 1)`);
    }
    for (const cursor of cursors)
      cursor.setAttribute("transform", `translate(${(cursor.dataset.cursor * time) / end} 0)`);
    const text = `${time.toFixed(2)} s`;
    clock.textContent = slider.ariaValueText = text;
    slider.value = time;
    root.dataset.time = time.toFixed(3);
  }

  // Who asked for less motion sees a few positions one after the other.
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const pause = calm ? 800 : 0, jump = end / 5;
  let time = end, playing = false, last = 0;
  function play(on) {
    playing = on;
    button.textContent = on ? "Pause" : "Play";
    if (on) requestAnimationFrame((now) => { last = now; tick(now); });
  }
  function tick(now) {
    if (!playing || !svg.isConnected) return play(false);
    if (now - last >= pause) {
      time = Math.min(time + (calm ? (now > last ? jump : 0) : (now - last) / 1000 / slower), end);
      last = now;
      draw(time);
    }
    if (time >= end) play(false);
    else requestAnimationFrame(tick);
  }
  button.onclick = () => {
    if (!playing && time >= end) time = 0;
    if (!playing) draw(time);
    play(!playing);
  };
  slider.oninput = () => {
    play(false);
    draw((time = Number(slider.value)));
  };
  play(false);
  draw(end);
}
