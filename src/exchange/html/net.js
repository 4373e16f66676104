// A net with its tokens. Pictures come as lists of shapes; a place can be drawn several times, and has its token everywhere.

const RADIUS = 12, BOX = 24;
const still = matchMedia("(prefers-reduced-motion: reduce)");
let markers = 0;

function tokenGame(picture) {
  const [width, height] = picture.size;
  const id = `head-${markers++}`;
  const marker = (name, content) => svg("marker", {
    id: `${id}-${name}`, viewBox: "0 0 8 8", refX: 8, refY: 4, markerWidth: 8, markerHeight: 8,
    markerUnits: "userSpaceOnUse", orient: "auto",
  }, content);
  const heads = svg("defs", {},
    marker("arrow", svg("path", { d: "M0 1L8 4L0 7Z" })), marker("dot", svg("circle", { cx: 4.5, cy: 4, r: 3.5 })));

  const boxes = new Map();
  for (const [transition, x, y, wide] of picture.boxes) {
    boxes.set(transition, { x, y, wide, consume: [], produce: [], shape: svg("rect", {
      class: "box", x: x - wide / 2, y: y - BOX / 2, width: wide, height: BOX, rx: 2, "data-transition": transition,
    }, svg("title", {}, data.nets.transitions[transition][0])) });
  }
  const arcs = picture.arcs.map(([transition, x1, y1, x2, y2, dot]) => {
    const line = svg("path", {
      class: "arc", d: `M${x1} ${y1}L${x2} ${y2}`, "marker-end": `url(#${id}-${dot ? "dot" : "arrow"})`, "data-transition": transition,
    });
    const box = boxes.get(transition);
    if (box && !dot) {
      const consumes = Math.abs(x2 - box.x) <= box.wide / 2 + 1 && Math.abs(y2 - box.y) <= BOX / 2 + 1;
      (consumes ? box.consume : box.produce).push([x1, y1, x2, y2]);
    }
    return line;
  });
  const tokens = [];
  const places = picture.places.map(([place, x, y, copy]) => {
    const token = svg("circle", { class: "token", cx: x, cy: y, r: 5, "data-place": data.nets.places[place] });
    tokens.push([place, token]);
    return svg("g", {}, svg("circle", { class: copy ? "place copy" : "place", cx: x, cy: y, r: RADIUS },
      svg("title", {}, data.nets.places[place])), token);
  });
  const texts = picture.texts.map(([x, y, anchor, strong, text]) => svg("text", {
    x, y: y + 4, "text-anchor": ["start", "middle", "end"][anchor], class: strong ? "strong" : undefined,
  }, text));
  const moving = svg("g", { class: "moving" });
  const drawing = svg("svg", { class: "net", viewBox: `0 0 ${width} ${height}`, width, height, role: "img" },
    heads, arcs, places, [...boxes.values()].map((box) => box.shape), texts, moving);
  // It may shrink to fit, but not so far that names cannot be read; it never grows.
  drawing.style.minWidth = `${Math.min(width, Math.max(0.7 * width, 360))}px`;
  const element = html("div", { class: "net-box", tabindex: "0", role: "group", "aria-label": "Net" }, drawing);
  let glowing = [];

  // Shows a marking and what fired to reach it; `move` lets the tokens go there.
  function show(marking, fired, move) {
    for (const shape of glowing) shape.classList.remove("fired");
    glowing = [];
    const here = fired.filter((transition) => boxes.has(transition));
    const wanted = new Set(here.map(String));
    for (const shape of drawing.querySelectorAll("[data-transition]")) {
      if (!wanted.has(shape.dataset.transition)) continue;
      shape.classList.add("fired");
      glowing.push(shape);
    }
    const animated = move && here.length > 0 && here.length <= 8 && !still.matches;
    let marked = 0;
    for (const [place, token] of tokens) {
      const has = marking[place] === 1, had = token.classList.contains("on");
      marked += has;
      token.classList.toggle("on", has);
      token.classList.toggle("late", animated && has && !had);
    }
    drawing.setAttribute("aria-label", `Petri net. Marked: ${tokens.filter(([, t]) => t.classList.contains("on")).map(([p]) => data.nets.places[p]).join(", ")}`);
    moving.replaceChildren();
    if (animated) here.forEach((transition, i) => travel(boxes.get(transition), i * 60));
    const box = boxes.get(here[0]);
    if (box) {
      const scale = drawing.clientWidth / width || 1;
      reveal(element, (box.y - 60) * scale, (box.y + 60) * scale, (box.x - 80) * scale, (box.x + 80) * scale);
    }
  }

  function travel({ consume, produce }, delay) {
    const go = ([x1, y1, x2, y2], start) => {
      const dot = svg("circle", { r: 5, class: "token on" });
      moving.append(dot);
      const at = (x, y) => ({ transform: `translate(${x}px, ${y}px)` });
      const run = dot.animate([at(x1, y1), at(x2, y2)], { duration: 160, delay: start, easing: "ease-in-out", fill: "both" });
      dot.setAttribute("visibility", "hidden");
      setTimeout(() => dot.setAttribute("visibility", "visible"), start);
      run.finished.then(() => dot.remove(), () => dot.remove());
    };
    consume.forEach((way) => go(way, delay));
    produce.forEach((way) => go(way, delay + 160));
  }

  // Shows the places of these variables, or else the place where control is, in the middle of the box.
  function aim(names) {
    const of = (place) => data.nets.places[place].split("=")[0];
    const about = picture.places.filter(([place]) => names.includes(of(place)));
    const marked = picture.places.filter((_, i) => tokens[i][1].classList.contains("on"));
    const chosen = about.length > 0 ? about : marked;
    if (chosen.length === 0) return;
    const scale = drawing.clientWidth / width || 1;
    // What has its token, if not everything fits.
    const centre = (axis, room) => {
      const at = (list) => list.map((shape) => shape[axis]);
      const all = at(chosen), least = Math.min(...all), most = Math.max(...all);
      const here = at(chosen.filter((shape) => marked.includes(shape)));
      return ((most - least) * scale < room - 40 || here.length === 0 ? (least + most) / 2 : here[0]) * scale - room / 2;
    };
    element.scrollLeft = Math.max(0, centre(1, element.clientWidth));
    element.scrollTop = Math.max(0, centre(2, element.clientHeight));
  }

  return { element, show, aim };
}
