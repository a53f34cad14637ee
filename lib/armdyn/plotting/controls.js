  // Stands in the script of each player, in place of @CONTROLS@: what is the same in all of them.
  const make = (tag, properties, parent) =>
    parent.appendChild(Object.assign(document.createElement(tag), properties));

  // The value of a column at a time, linear between its frames; after its last frame it stays.
  function valueAt(column, time, step) {
    const last = column.length - 1, at = Math.min(time / step, last), k = Math.floor(at);
    return column[k] + (at - k) * (column[Math.min(k + 1, last)] - column[k]);
  }

  // A button, a slider and a clock below `parent`, which call draw(time, playing) for times from 0 to end
  // (s). It begins at `from`, and goes by `speed` seconds of motion a second while `parent` is in the page.
  function addControls(parent, { end, from, speed, zero, draw }) {
    const bar = make("div", { className: "armdyn-controls" }, parent);
    bar.style.cssText = "display:flex;align-items:center;gap:8px;max-width:560px;font:13px sans-serif";
    const button = make("button", { type: "button" }, bar);
    button.style.cssText = "width:5em;font:inherit";
    const slider = make(
      "input", { type: "range", min: 0, max: end, step: "any", value: from, ariaLabel: "time" }, bar);
    slider.style.cssText = "flex:1;min-width:0";
    slider.dataset.lmSuppressShortcuts = "true"; // JupyterLab: its arrow keys are its own
    const clock = make("output", { ariaLive: "off" }, bar);
    clock.style.cssText = "width:5em;text-align:right;font-variant-numeric:tabular-nums";

    // Who asked for less motion sees a few positions one after the other.
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const pause = calm ? 800 : 0, jump = end / 5;
    let time = from, playing = false, last = 0;
    function show() {
      draw(time, playing);
      clock.textContent = slider.ariaValueText = `${(zero + time).toFixed(2)} s`;
      slider.value = time;
      parent.closest("[data-live]").dataset.time = time.toFixed(3);
    }
    function play(on) {
      playing = on;
      button.textContent = on ? "Pause" : "Play";
      show();
      if (on) requestAnimationFrame((now) => { last = now; tick(now); });
    }
    function tick(now) {
      if (!playing) return;
      if (!parent.isConnected) return play(false);
      if (now - last >= pause) {
        time = Math.min(time + (calm ? (now > last ? jump : 0) : ((now - last) / 1000) * speed), end);
        last = now;
        show();
      }
      if (time >= end) play(false);
      else requestAnimationFrame(tick);
    }
    button.onclick = () => {
      if (!playing && time >= end) time = 0;
      play(!playing);
    };
    slider.oninput = () => {
      time = Number(slider.value);
      play(false);
    };
    play(false);
    return show;
  }
