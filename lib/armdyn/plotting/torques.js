  // Stands in animation.js, in place of @TORQUES@, where the motion comes with its torques: an arc for each
  // term at each joint, a table of the numbers whose head switches terms off, and bars for the energies.
  function showTorques() {
    const { terms, quarter, unit, decimals, joule, jouleDecimals } = torques;
    const values = torques.values.map((all) => all.map((of) => of.map((deltas) => summed(deltas, unit))));
    const energies = torques.energies.map((all) => all.map((deltas) => summed(deltas, joule)));
    const shown = terms.map(() => true);
    let chosen = 0;
    const text = (value, digits) => {
      const rounded = value.toFixed(digits);
      return (Number(rounded) === 0 ? (0).toFixed(digits) : rounded).replace("-", "−");
    };

    // Rings only for terms that are not zero all the time, as wide as the shortest link leaves room for.
    const used = terms.map((_, k) => values.some((all) => all[k].some((column) => column.some((x) => x !== 0))));
    const count = used.filter(Boolean).length;
    const link = (Math.min(...lengths) / (2 * half)) * (size - margin - 8);
    const gap = Math.min(8, ((n > 1 ? 0.75 * link : 99) - 8) / Math.max(count, 1));
    const width = 0.7 * gap, inner = 8 + gap / 2;
    const radius = terms.map((_, k) => inner + gap * used.slice(0, k).filter(Boolean).length);

    const arcs = lengths.map(() => {
      const group = put("g", { "stroke-linecap": "butt", "data-arcs": "" });
      const start = put("line", { stroke: ink, "stroke-width": 1, y1: -5, y2: -inner - gap * (count - 0.5) }, group);
      return { group, start, parts: terms.map(({ colour, dash }) => arcIn(group, colour, dash)) };
    });
    function arcIn(parent, colour, dash) {
      const group = put("g", {}, parent), fill = "none";
      const edge = put("path", { fill, stroke: ink, "stroke-width": width + 1.4 }, group);
      const core = put("path", { fill, stroke: colour, "stroke-width": width, "stroke-dasharray": dash }, group);
      const head = put("path", { fill: colour, stroke: ink, "stroke-width": 0.7, "stroke-linejoin": "round" }, group);
      return { group, edge, core, head };
    }

    // Counter-clockwise from upwards for a positive torque. A longer arc ends at `most`, with two heads.
    const most = 1.7 * Math.PI;
    function bend({ group, edge, core, head }, r, torque) {
      const whole = (torque / quarter) * (Math.PI / 2), size = Math.min(Math.abs(whole), most);
      const side = Math.sign(whole), long = r * size;
      group.setAttribute("visibility", long > 0.8 ? "inherit" : "hidden");
      if (long <= 0.8) return;
      const at = (angle, radius = r) =>
        `${(-side * radius * Math.sin(angle)).toFixed(2)} ${(-radius * Math.cos(angle)).toFixed(2)}`;
      const tip = Math.min(1.8 * width, long), wide = Math.min(1.1 * width, tip), back = size - tip / r;
      const path = `M${at(0)}A${r} ${r} 0 ${back > Math.PI ? 1 : 0} ${side > 0 ? 0 : 1} ${at(back)}`;
      const arrow = (end, start) => `M${at(end)}L${at(start, r + wide)}L${at(start, r - wide)}Z`;
      edge.setAttribute("d", path);
      core.setAttribute("d", path);
      const cut = Math.abs(whole) > most ? arrow(back, back - tip / r) : "";
      head.setAttribute("d", arrow(size, back) + cut);
    }

    // The length of the arcs, in a corner where no arm comes.
    const r = radius[used.lastIndexOf(true)] ?? inner;
    const key = put("g", { transform: `translate(${margin + 10 + r} ${14 + r})` });
    put("line", { stroke: ink, "stroke-width": 1, y1: -r + 4, y2: -r - 4 }, key);
    bend(arcIn(key, paper, "none"), r, quarter);
    write(`this arc: ${quarter} N·m`, 6, -r + 6, { "text-anchor": "start" }, key);

    player.dataset.torques = "";
    const panel = make("div", { className: "armdyn-numbers" }, player);
    if (arms.length > 1) {
      const label = make("label", { className: "armdyn-choice", textContent: "torques and energy of " }, panel);
      const choice = make("select", {}, label);
      arms.forEach((_, arm) => make("option", { value: arm, textContent: names[arm] || `arm ${arm + 1}` }, choice));
      choice.onchange = () => {
        chosen = Number(choice.value);
        result.onchange();
      };
    }
    const table = make("table", {}, panel);
    make("caption", { textContent: "torques (N·m), + is counter-clockwise" }, table);
    const head = make("tr", {}, make("thead", {}, table)), body = make("tbody", {}, table);
    make("td", {}, head);
    terms.forEach(({ name, colour, dash }, k) => {
      const label = make("label", {}, make("th", { scope: "col" }, head));
      const box = make("input", { type: "checkbox", checked: true }, label);
      box.dataset.lmSuppressShortcuts = "true";
      label.insertAdjacentHTML("beforeend", `<svg width="26" height="8" aria-hidden="true"></svg>`);
      const sample = label.lastChild;
      put("path", { d: "M0 4H26", stroke: ink, "stroke-width": 6 }, sample);
      put("path", { d: "M1 4H25", stroke: colour, "stroke-width": 4.4, "stroke-dasharray": dash }, sample);
      make("span", { textContent: name }, label);
      box.onchange = () => {
        shown[k] = box.checked;
        result.onchange();
      };
    });
    const cells = lengths.map((_, i) => {
      const row = make("tr", {}, body);
      make("th", { scope: "row", textContent: n > 1 ? `joint ${i + 1}` : "joint" }, row);
      return terms.map(() => make("td", {}, row));
    });

    const all = energies.flatMap((columns) => columns.flatMap((column) => [...column]));
    const low = Math.min(0, ...all), high = Math.max(0, ...all), span = high - low || 1;
    const onBar = (value) => (100 * (value - low)) / span;
    const stores = make("table", {}, panel);
    make("caption", { textContent: "energy (J)" }, stores);
    const bars = torques.stores.map(({ name, colour }) => {
      const row = make("tr", {}, stores);
      make("th", { scope: "row", textContent: name }, row);
      const cell = make("td", { className: "armdyn-bar" }, row), value = make("td", {}, row);
      cell.innerHTML = `<svg viewBox="0 0 100 12" preserveAspectRatio="none" aria-hidden="true"></svg>`;
      const bar = put("rect", { y: 2, height: 8, fill: colour, stroke: ink, "vector-effect": "non-scaling-stroke" }, cell.firstChild);
      put("line", { x1: onBar(0), x2: onBar(0), y2: 12, stroke: ink, "vector-effect": "non-scaling-stroke" }, cell.firstChild);
      return { bar, value };
    });
    // Told aloud when the motion stands, not thirty times a second.
    const told = make("p", { className: "armdyn-told", ariaLive: "polite" }, panel);

    const result = { onchange() {}, draw(time, playing, stands) {
      const now = values[chosen].map((of) => of.map((column) => valueAt(column, time, step)));
      arcs.forEach(({ group, start, parts }, i) => {
        group.setAttribute("transform", `translate(${inPixels(stands[chosen][i]).map((x) => x.toFixed(2))})`);
        start.setAttribute("visibility", shown.some((on, k) => on && used[k]) ? "inherit" : "hidden");
        parts.forEach((part, k) => bend(part, radius[k], shown[k] ? now[k][i] : 0));
        cells[i].forEach((cell, k) => {
          cell.textContent = text(now[k][i], decimals);
          cell.style.opacity = shown[k] ? 1 : 0.45;
        });
      });
      const joules = energies[chosen].map((column) => valueAt(column, time, step));
      bars.forEach(({ bar, value }, k) => {
        bar.setAttribute("x", onBar(Math.min(0, joules[k])));
        bar.setAttribute("width", (100 * Math.abs(joules[k])) / span);
        value.textContent = text(joules[k], jouleDecimals);
      });
      if (playing) return;
      const ofJoint = (i) => terms.map(({ name }, k) => `${name} ${text(now[k][i], decimals)}`).join(", ");
      const torquesNow = lengths.map((_, i) => `joint ${i + 1}: ${ofJoint(i)} N·m`);
      const energiesNow = torques.stores.map(({ name }, k) => `${name} ${text(joules[k], jouleDecimals)} J`);
      const whose = arms.length > 1 ? `, ${names[chosen] || `arm ${chosen + 1}`}` : "";
      told.textContent = `At ${(start + time).toFixed(2)} s${whose}: ${[...torquesNow, energiesNow.join(", ")].join("; ")}.`;
    } };
    return result;
  }
