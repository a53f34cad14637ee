// Makes the lessons' controls alive: each holds the pictures of its settings (docs/site/frames.py), and
// needs neither Python nor another host. Where no script runs, the still picture stays as it is.
"use strict";

async function unpacked(base64) {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text());
}

function make(tag, properties, parent) {
  return parent.appendChild(Object.assign(document.createElement(tag), properties));
}

function note({ coarser, together, inputs }) {
  const steps = coarser ? "In larger steps than in JupyterLab. " : "";
  if (together >= inputs.length) return steps;
  const others = together === 1 ? "the others go" : "the one that you moved longest ago goes";
  const most = together === 1 ? "One slider" : `${["", "", "Two", "Three", "Four", "Five"][together]} sliders`;
  return `${steps}${most} at a time can be away from the start: move another one, and ${others} back to it.`;
}

function bring(root, data) {
  const [width, height] = data.size;
  const still = root.querySelector("img");
  const panel = document.createElement("div");
  panel.className = "armdyn-control-inputs";
  root.prepend(panel);

  const parser = new DOMParser();
  const picture = parser.parseFromString(
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${10 * width} ${10 * height}" width="${width}">` +
      `<image aria-hidden="true" width="${10 * width}" height="${10 * height}" href="data:image/png;base64,${data.background}"/><g aria-hidden="true"/></svg>`,
    "image/svg+xml",
  ).documentElement;
  picture.setAttribute("role", "img");
  const moving = picture.querySelector("g");
  still.after(picture);

  const now = data.inputs.map((input) => input.start);
  const moved = []; // the inputs away from their start, the one moved longest ago first
  const rows = data.inputs.map((input, i) => {
    const row = make("label", { className: input.box ? "armdyn-control-box" : "" }, panel);
    const field = document.createElement("input");
    const name = document.createElement("span");
    name.textContent = input.label;
    if (input.box) {
      field.type = "checkbox";
      row.append(field, name);
    } else {
      Object.assign(field, { type: "range", min: 0, max: input.texts.length - 1, step: 1 });
      row.append(name, field);
    }
    const value = input.box ? null : make("output", {}, row);
    field.addEventListener("input", () => move(i, input.box ? Number(field.checked) : Number(field.value)));
    return { field, value };
  });
  const reset = make("button", { type: "button", textContent: "Back to the start" }, panel);
  reset.onclick = () => {
    moved.length = 0;
    data.inputs.forEach((input, i) => (now[i] = input.start));
    draw();
  };
  const told = note(data);
  if (told) make("p", { textContent: told }, panel);

  function move(i, place) {
    now[i] = place;
    if (moved.includes(i)) moved.splice(moved.indexOf(i), 1);
    if (place !== data.inputs[i].start) moved.push(i);
    while (moved.length > data.together) {
      const first = moved.shift();
      now[first] = data.inputs[first].start;
    }
    draw();
  }

  function draw() {
    rows.forEach(({ field, value }, i) => {
      const input = data.inputs[i];
      if (input.box) field.checked = now[i] === 1;
      else {
        field.value = now[i];
        value.textContent = input.texts[now[i]];
        field.ariaValueText = input.texts[now[i]];
      }
    });
    const [alt, ...parts] = data.frames[now.join(",")];
    picture.setAttribute("aria-label", alt);
    moving.innerHTML = parts.map((k) => data.parts[k]).join("");
  }

  draw();
  root.dataset.live = "";
}

for (const root of document.querySelectorAll("[data-control]")) {
  unpacked(root.querySelector("script").textContent).then((data) => bring(root, data));
}
