// What every page brings with it: its style, and the script by which pictures zoom and pan
// together.
#pragma once

namespace wavepath {

inline constexpr const char* page_style = R"(
:root { color-scheme: light dark; --line: #8886; --faint: #8882; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 80rem; margin: 2rem auto; padding: 0 1rem; }
h1, h2 { line-height: 1.2; }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .7rem; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; }
td.number, th.number { text-align: right; white-space: nowrap; }
.wide { overflow-x: auto; }
pre { background: var(--faint); padding: .6rem; overflow-x: auto; }
svg { width: 100%; height: auto; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1rem; }
figure { margin: 0; }
.view { overflow: hidden; border: 1px solid var(--line); touch-action: none; cursor: grab; }
.view img { display: block; width: 100%; image-rendering: pixelated; transform-origin: 0 0; }
)";

inline constexpr const char* page_script = R"(
for (const group of document.querySelectorAll('.pictures')) {
  const views = [...group.querySelectorAll('.view')];
  let scale = 1, x = 0, y = 0;  // of a point p of a picture: scale * p + (x, y)
  const show = () => {
    const {clientWidth: w, clientHeight: h} = views[0];
    x = Math.min(0, Math.max(w * (1 - scale), x));
    y = Math.min(0, Math.max(h * (1 - scale), y));
    for (const view of views)
      view.firstElementChild.style.transform = `translate(${x}px,${y}px) scale(${scale})`;
  };
  const zoom = (factor, px, py) => {
    const next = Math.min(64, Math.max(1, scale * factor));
    x = px - (px - x) * next / scale;
    y = py - (py - y) * next / scale;
    scale = next;
    show();
  };
  for (const view of views) {
    view.tabIndex = 0;
    view.addEventListener('wheel', event => {
      if (scale === 1 && event.deltaY > 0) return;  // the page scrolls
      event.preventDefault();
      const box = view.getBoundingClientRect();
      zoom(Math.exp(-event.deltaY / 400), event.clientX - box.left, event.clientY - box.top);
    }, {passive: false});
    view.addEventListener('pointerdown', event => view.setPointerCapture(event.pointerId));
    view.addEventListener('pointermove', event => {
      if (!event.buttons) return;
      x += event.movementX;
      y += event.movementY;
      show();
    });
    view.addEventListener('keydown', event => {
      const step = 40, w = view.clientWidth / 2, h = view.clientHeight / 2;
      const moves = {ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
      if (event.key === '+' || event.key === '=') zoom(1.5, w, h);
      else if (event.key === '-') zoom(1 / 1.5, w, h);
      else if (event.key === '0') zoom(1 / 64, w, h);
      else if (moves[event.key]) { x += moves[event.key][0]; y += moves[event.key][1]; show(); }
      else return;
      event.preventDefault();
    });
    view.firstElementChild.draggable = false;
  }
}
)";

}  // namespace wavepath
