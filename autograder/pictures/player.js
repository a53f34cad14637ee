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

@CONTROLS@
  const end = (frames - 1) * step;
  const moving = [...svg.querySelectorAll("[data-panel]")].flatMap((panel, k) =>
    [...panel.querySelectorAll("[data-moves]")].map((part, i) => [part, panels[k][i]]));
  const cursors = [...svg.querySelectorAll("[data-cursor]")];
  for (const cursor of cursors) cursor.removeAttribute("display");

  function draw(time) {
    for (const [part, columns] of moving) {
      const [x, y, turn, stretch] = columns.map((column) =>
        Array.isArray(column) ? valueAt(column, time, step).toFixed(3) : column);
      part.setAttribute("transform", `translate(${x} ${y}) rotate(${turn}) scale(${stretch} 1)`);
    }
    for (const cursor of cursors)
      cursor.setAttribute("transform", `translate(${(cursor.dataset.cursor * time) / end} 0)`);
  }
  addControls(root, { end, from: end, speed: 1 / slower, zero: 0, draw });
}
