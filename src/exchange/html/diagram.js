// The timing diagram: one lane for each variable, truth values as waves, everything else as a bus; the cursor follows the steps
// and can be dragged.

const LANE = 28, HEAD = 26, HIGH = 6, LOW = 21;
const FOLD = 150;

function timingDiagram(playback, items, { matters, notes, seek }) {
  const { run } = playback;
  const changing = new Set();
  for (const tick of playback.ticks) for (const [variable] of tick.changes) changing.add(variable);
  for (const key of matters.keys()) changing.add(Number(key.split(":")[1]));
  const all = data.variables.map((_, i) => i);
  // What the requirement speaks of stands first where there is much.
  const base = run.columns.length > 0 ? run.columns.flat() : all;
  const some = base.filter((i) => changing.has(i));
  const few = base.length <= 16 || some.length === 0 ? base : some;
  let whole = few.length === all.length;

  const names = html("div", { class: "lane-names" });
  const box = html("div", { class: "lane-box", tabindex: "0", role: "group", "aria-label": "Waves" });
  const element = html("div", { class: "lanes" }, names, box);
  const more = all.length > few.length
    ? html("button", { type: "button", class: "link", "aria-pressed": String(whole), onclick: () => {
        whole = !whole;
        more.setAttribute("aria-pressed", String(whole));
        draw();
        show(now.index, now.values);
      } })
    : null;
  let drawing = null, cells = [], cursor = null, now = { index: 0, values: [] };
  // How wide a scan is, where each item begins, what is drawn of it, and what each variable does.
  let width = 0, left = new Float64Array(1), range = [0, 0], lanes = [], lines = new Map();

  const total = () => left[items.length];
  const columns = () => items.length;

  // A moment, counted in scans, as a place; and back.
  function place(moment) {
    if (moment >= items.count) return total();
    const i = items.at(Math.floor(moment)), { first, last } = items.list[i];
    return left[i] + ((moment - first) / (last + 1 - first)) * (left[i + 1] - left[i]);
  }
  function moment(x) {
    let low = 0, high = items.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (left[middle] <= x) low = middle; else high = middle - 1;
    }
    const { first, last } = items.list[low];
    return first + Math.min(0.999, Math.max(0, (x - left[low]) / (left[low + 1] - left[low]))) * (last + 1 - first);
  }

  // With `paper`, as wide as that, however narrow the scans become, and only what changes.
  function draw(paper) {
    lanes = paper && some.length > 0 ? some : whole ? all : few;
    if (more) more.textContent = whole ? `only ${few.length} of them` : `all ${all.length} variables`;
    // Values that change from scan to scan are to be read.
    const inLanes = new Set(lanes);
    let longest = 0;
    for (const { changes } of playback.ticks) for (const [variable, value] of changes) {
      if (data.variables[variable][2] !== "BOOL" && inLanes.has(variable)) longest = Math.max(longest, shown(value).length);
    }
    const least = run.kind === "scans" ? Math.max(44, Math.min(84, longest * 6.7 + 14)) : 20;
    // Where one can look into the scans they may be wide.
    const most = playback.length > 2 * items.count ? 640 : 120;
    const folds = items.list.filter((item) => item.fold).length, plain = Math.max(1, columns() - folds);
    const fold = paper ? Math.min(FOLD, paper / (2 * Math.max(1, folds))) : FOLD;
    width = paper ? Math.min(most, (paper - folds * fold) / plain) : Math.min(most, Math.max(least, (box.clientWidth - 2 - folds * fold) / plain));
    left = new Float64Array(columns() + 1);
    items.list.forEach((item, i) => { left[i + 1] = left[i] + (item.fold ? fold : width); });
    lines = tracks(playback, items, lanes);
    cells = [];
    const labels = lanes.map((variable, row) => {
      const [name, role, type] = data.variables[variable];
      const ruled = row > 0 && data.variables[lanes[row - 1]][1] !== role;
      const value = html("span", { class: "value" });
      cells.push([variable, value]);
      return html("div", { class: `lane-name ${role}${ruled ? " ruled" : ""}`, title: `${name}: ${type}, ${role}` }, html("span", { class: "name" }, name), value);
    });
    names.replaceChildren(html("div", { class: "lane-head" }, run.kind === "scans" ? "scan" : "firing"), ...labels);
    const strip = html("div", { class: "strip" });
    strip.style.width = `${Math.ceil(total()) + 1}px`;
    box.replaceChildren(strip);
    drawAround(paper);
  }

  // Draws what is in the box and around it; everything if that is not much.
  function drawAround(paper) {
    const room = Math.max(600, box.clientWidth);
    const isWhole = paper || total() <= 12 * room;
    range = isWhole ? [0, total()] : [Math.max(0, box.scrollLeft - 2 * room), Math.min(total(), box.scrollLeft + 3 * room)];
    const [from, to] = range, wide = Math.ceil(to - from) + 1, height = HEAD + LANE * lanes.length + 4;
    const within = (one, two) => two >= from && one <= to;
    const grid = [], waves = [];
    const zero = run.kind === "scans" ? 1 : 0;
    const every = Math.ceil(Math.max(26, 7 * String(items.count).length + 6) / width);
    for (let i = items.at(Math.floor(moment(from))); i < items.length && left[i] <= to; i++) {
      const { first, last, fold } = items.list[i], x = left[i] - from, right = left[i + 1] - from;
      grid.push(svg("line", { class: "grid", x1: x, x2: x, y1: HEAD - 6, y2: height }));
      if (fold) {
        grid.unshift(svg("rect", { class: "folded", x, y: HEAD - 6, width: right - x, height: height - HEAD + 6 }, svg("title", {}, movement(fold))));
        if (right - x > 60) grid.push(svg("text", { class: "tick", x: (x + right) / 2, y: 15, "text-anchor": "middle" }, `… ${(last - first + 1).toLocaleString("en")} scans …`));
      } else if (first % every === 0 || (i > 0 && items.list[i - 1].fold)) {
        grid.push(svg("text", { class: "tick", x: (x + right) / 2, y: 15, "text-anchor": "middle" }, String(first + zero)));
      }
    }
    for (const [start, end, text] of notes) {
      const [x, right] = [place(start), place(end + 1)];
      if (!within(x, right)) continue;
      const band = svg("rect", { class: "noted", x: x - from, y: 2, width: right - x, height: HEAD - 8, rx: 3 });
      band.append(svg("title", {}, text));
      grid.unshift(band);
    }
    if (run.loop !== null && run.kind === "scans") {
      const x = Math.max(from, place(run.loop + 1));
      if (x < to) grid.unshift(svg("rect", { class: "loop", x: x - from, y: HEAD - 6, width: to - x, height: height - HEAD + 6 }));
    }
    lanes.forEach((variable, row) => {
      const [, role, type] = data.variables[variable], top = HEAD + row * LANE;
      if (row > 0 && data.variables[lanes[row - 1]][1] !== role) grid.push(svg("line", { class: "rule", x1: 0, x2: wide, y1: top, y2: top }));
      const pieces = lines.get(variable);
      const parts = [];
      for (let i = 0; i < pieces.length; i++) {
        const start = place(pieces[i].at), end = i + 1 < pieces.length ? place(pieces[i + 1].at) : total();
        if (within(start, end)) parts.push({ ...pieces[i], x: Math.max(start, from - 50) - from, right: Math.min(end, to + 50) - from });
      }
      waves.push(wave(parts, type, top));
    });
    for (const key of matters.keys()) {
      const [scan, variable] = key.split(":").map(Number);
      const row = lanes.indexOf(variable), x = place(scan), right = place(scan + 1);
      if (row < 0 || !within(x, right)) continue;
      const mark = svg("rect", { class: "matters", x: x - from + 1.5, y: HEAD + row * LANE + 1.5, width: Math.max(1, right - x - 3), height: LANE - 3, rx: 4 });
      mark.append(svg("title", {}, matters.get(key)));
      grid.push(mark);
    }
    cursor = svg("g", { class: "cursor" },
      svg("line", { x1: 0, x2: 0, y1: HEAD - 6, y2: height }), svg("path", { d: `M-5 ${HEAD - 14}h10v4l-5 5-5-5z` }));
    drawing = svg("svg", { class: "waves", width: wide, height, role: "img", "aria-label": describe(lanes) }, grid, waves, cursor);
    drawing.style.marginLeft = `${from}px`;
    drawing.addEventListener("pointerdown", (event) => {
      drawing.setPointerCapture(event.pointerId);
      drag(event);
      drawing.addEventListener("pointermove", drag);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      drawing.addEventListener(end, () => drawing.removeEventListener("pointermove", drag));
    }
    box.firstChild.replaceChildren(drawing);
    moveCursor();
  }

  const drag = (event) => {
    const x = event.clientX - drawing.getBoundingClientRect().left + range[0];
    seek(playback.at(Math.max(0, Math.min(moment(x), items.count - 0.001))));
  };

  const describe = (lanes) => `Timing diagram of ${lanes.map((i) => data.variables[i][0]).join(", ")}`;

  function moveCursor() {
    const tick = playback.ticks[now.index];
    if (!tick || !cursor) return 0;
    const x = place(tick.look);
    cursor.setAttribute("transform", `translate(${(x - range[0]).toFixed(1)} 0)`);
    cursor.dataset.tick = now.index;
    return x;
  }

  function show(index, values) {
    now = { index, values };
    if (!drawing) return;
    const x = moveCursor();
    const changed = new Set(playback.ticks[index].changes.map(([variable]) => variable));
    for (const [variable, cell] of cells) {
      const value = shown(values[variable]);
      if (cell.textContent !== value) cell.textContent = value;
      cell.classList.toggle("fresh", changed.has(variable));
    }
    reveal(box, box.scrollTop, box.scrollTop, x - 20, x + 20);
    if (x < range[0] || x > range[1]) drawAround();
  }

  box.addEventListener("scroll", () => {
    const [from, to] = range, room = box.clientWidth;
    if ((box.scrollLeft < from + room / 2 && from > 0) || (box.scrollLeft + room > to - room / 2 && to < total())) drawAround();
  });
  const again = () => {
    if (box.clientWidth === 0) return;
    draw();
    show(now.index, now.values);
  };
  items.listeners.push(again);
  new ResizeObserver(again).observe(box);
  return { element, more, show, draw };
}

// What each variable does: values with the moments from which they are there, and stretches in which they move.
function tracks(playback, items, variables) {
  const found = new Map(variables.map((variable) => [variable, [{ at: 0, value: data.variables[variable][3] }]]));
  let at = 0;
  const foldOf = (scan) => {
    while (at + 1 < items.length && items.list[at].last < scan) at++;
    return items.list[at].fold;
  };
  const hasFolds = playback.run.kind === "scans" && items.folds.some((fold) => !fold.open);
  for (const tick of playback.ticks) {
    const fold = hasFolds ? foldOf(tick.scan) : undefined;
    for (const [variable, value] of tick.changes) {
      const track = found.get(variable);
      if (!track) continue;
      const last = track[track.length - 1];
      if (fold && last.moves === fold) last.value = value;
      else if (fold) track.push({ at: fold.first, moves: fold, from: last.value, value });
      else {
        if (last.moves) track.push({ at: last.moves.last + 1, value: last.value });
        const now = track[track.length - 1];
        if (value === now.value) continue;
        if (tick.x === now.at) now.value = value; else track.push({ at: tick.x, value });
      }
    }
  }
  for (const track of found.values()) {
    const last = track[track.length - 1];
    if (last.moves) track.push({ at: last.moves.last + 1, value: last.value });
  }
  return found;
}

// The lane of a variable.
function wave(parts, type, top) {
  const number = (x) => x.toFixed(1);
  const middle = top + (HIGH + LOW) / 2;
  if (type === "BOOL") {
    const y = (value) => top + (value ? HIGH : LOW);
    let line = "", area = "";
    const turns = [];
    parts.forEach(({ x, right, value, moves }, i) => {
      if (moves) {
        const turn = svg("rect", { class: "turns", x: number(x), y: top + HIGH, width: number(right - x), height: LOW - HIGH });
        turn.append(svg("title", {}, movement(moves)));
        turns.push(turn);
        return;
      }
      const before = parts[i - 1];
      line += before && !before.moves ? `M${number(x)} ${y(before.value)}V${y(value)}H${number(right)}` : `M${number(x)} ${y(value)}H${number(right)}`;
      if (value) area += `M${number(x)} ${top + LOW}V${top + HIGH}H${number(right)}V${top + LOW}z`;
    });
    return svg("g", { class: "wave bool" }, svg("path", { class: "area", d: area || "M0 0" }), svg("path", { class: "line", d: line || "M0 0" }), turns);
  }
  return svg("g", { class: "wave bus" }, parts.map(({ x, right, value, from, moves }) => {
    const slant = Math.min(4, (right - x) / 2);
    const shape = `M${number(x)} ${middle}l${slant} ${top + HIGH - middle}H${number(right - slant)}l${slant} ${middle - top - HIGH}`
      + `l${-slant} ${top + LOW - middle}H${number(x + slant)}z`;
    const text = moves ? `${shown(from)} → ${shown(value)}` : shown(value), room = Math.floor((right - x - 10) / 6.6);
    const label = text.length <= room ? text : room >= 3 ? `${text.slice(0, room - 1)}…` : "";
    const group = svg("g", { class: moves ? "moves" : undefined }, svg("path", { class: "line", d: shape }),
      label && svg("text", { x: number((x + right) / 2), y: middle + 4, "text-anchor": "middle" }, label));
    group.append(svg("title", {}, text));
    return group;
  }));
}
