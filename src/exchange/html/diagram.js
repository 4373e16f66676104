// The timing diagram: one lane for each variable, truth values as waves, everything else as a bus; the cursor follows the steps
// and can be dragged.

const LANE = 28, HEAD = 26, HIGH = 6, LOW = 21;

function timingDiagram(playback, { matters, notes, seek }) {
  const changing = new Set(playback.ticks.flatMap((tick) => tick.changes.map(([variable]) => variable)));
  for (const key of matters.keys()) changing.add(Number(key.split(":")[1]));
  const all = data.variables.map((_, i) => i);
  const some = all.filter((i) => changing.has(i));
  let whole = all.length <= 16 || some.length === 0;

  const names = html("div", { class: "lane-names" });
  const box = html("div", { class: "lane-box", tabindex: "0", role: "group", "aria-label": "Waves" });
  const element = html("div", { class: "lanes" }, names, box);
  const more = all.length > some.length && some.length > 0
    ? html("button", { type: "button", class: "link", "aria-pressed": String(whole), onclick: () => {
        whole = !whole;
        more.setAttribute("aria-pressed", String(whole));
        draw();
        show(now.index, now.values);
      } })
    : null;
  let drawing = null, width = 0, cells = [], cursor = null, now = { index: 0, values: [] };

  // With `paper`, as wide as that, however narrow the scans become, and only what changes.
  function draw(paper) {
    const lanes = whole && !(paper && some.length > 0) ? all : some;
    if (more) more.textContent = whole ? `only the ${some.length} that change` : `all ${all.length} variables`;
    const columns = playback.columns;
    // Values that change from scan to scan are to be read.
    let longest = 0;
    for (const { changes } of playback.ticks) for (const [variable, value] of changes) {
      if (data.variables[variable][2] !== "BOOL" && lanes.includes(variable)) longest = Math.max(longest, shown(value).length);
    }
    const least = playback.run.kind === "scans" ? Math.max(44, Math.min(84, longest * 6.7 + 14)) : 20;
    // Where one can look into the scans they may be wide.
    const most = playback.length > 2 * columns ? 640 : 120;
    width = paper ? Math.min(most, paper / columns) : Math.min(most, Math.max(least, (box.clientWidth - 2) / columns));
    const total = Math.ceil(width * columns) + 1, height = HEAD + LANE * lanes.length + 4;
    const grid = [], waves = [];

    const first = playback.run.kind === "scans" ? 1 : 0;
    const every = Math.ceil(26 / width);
    for (let k = 0; k < columns; k++) {
      const x = k * width;
      grid.push(svg("line", { class: "grid", x1: x, x2: x, y1: HEAD - 6, y2: height }));
      if (k % every === 0) {
        grid.push(svg("text", { class: "tick", x: x + width / 2, y: 15, "text-anchor": "middle" }, String(k + first)));
      }
    }
    for (const [from, to, text] of notes) {
      const x = from * width;
      const band = svg("rect", { class: "noted", x, y: 2, width: (to - from + 1) * width, height: HEAD - 8, rx: 3 });
      band.append(svg("title", {}, text));
      grid.unshift(band);
    }
    if (playback.run.loop !== null && playback.run.kind === "scans") {
      const x = (playback.run.loop + 1) * width;
      grid.unshift(svg("rect", { class: "loop", x, y: HEAD - 6, width: columns * width - x, height: height - HEAD + 6 }));
    }

    cells = [];
    const labels = lanes.map((variable, row) => {
      const [name, role, type] = data.variables[variable];
      const top = HEAD + row * LANE;
      const previous = row > 0 ? data.variables[lanes[row - 1]][1] : role;
      if (row > 0 && previous !== role) grid.push(svg("line", { class: "rule", x1: 0, x2: total, y1: top, y2: top }));
      waves.push(wave(playback, variable, type, top, width, total));
      const value = html("span", { class: "value" });
      cells.push([variable, value]);
      return html("div", { class: `lane-name ${role}${row > 0 && previous !== role ? " ruled" : ""}`, title: `${name}: ${type}, ${role}` },
        html("span", { class: "name" }, name), value);
    });
    for (const key of matters.keys()) {
      const [scan, variable] = key.split(":").map(Number);
      const row = lanes.indexOf(variable);
      if (row < 0) continue;
      const mark = svg("rect", {
        class: "matters", x: scan * width + 1.5, y: HEAD + row * LANE + 1.5, width: width - 3, height: LANE - 3, rx: 4,
      });
      mark.append(svg("title", {}, matters.get(key)));
      grid.push(mark);
    }
    cursor = svg("g", { class: "cursor" },
      svg("line", { x1: 0, x2: 0, y1: HEAD - 6, y2: height }), svg("path", { d: `M-5 ${HEAD - 14}h10v4l-5 5-5-5z` }));
    drawing = svg("svg", { class: "waves", width: total, height, role: "img", "aria-label": describe(lanes) }, grid, waves, cursor);
    drawing.addEventListener("pointerdown", (event) => {
      drawing.setPointerCapture(event.pointerId);
      drag(event);
      drawing.addEventListener("pointermove", drag);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      drawing.addEventListener(end, () => drawing.removeEventListener("pointermove", drag));
    }
    names.replaceChildren(html("div", { class: "lane-head" }, playback.run.kind === "scans" ? "scan" : "firing"), ...labels);
    box.replaceChildren(drawing);
  }

  const drag = (event) => {
    const x = event.clientX - drawing.getBoundingClientRect().left;
    seek(playback.at(Math.max(0, Math.min(x / width, playback.columns - 0.001))));
  };

  const describe = (lanes) => `Timing diagram of ${lanes.map((i) => data.variables[i][0]).join(", ")}`;

  function show(index, values) {
    now = { index, values };
    if (!drawing) return;
    const tick = playback.ticks[index];
    const x = tick.look * width;
    cursor.setAttribute("transform", `translate(${x.toFixed(1)} 0)`);
    cursor.dataset.tick = index;
    const changed = new Set(tick.changes.map(([variable]) => variable));
    for (const [variable, cell] of cells) {
      const value = shown(values[variable]);
      if (cell.textContent !== value) cell.textContent = value;
      cell.classList.toggle("fresh", changed.has(variable));
    }
    reveal(box, box.scrollTop, box.scrollTop, x - 20, x + 20);
  }

  new ResizeObserver(() => {
    if (box.clientWidth === 0) return;
    draw();
    show(now.index, now.values);
  }).observe(box);
  return { element, more, show, draw };
}

// The lane of a variable.
function wave(playback, variable, type, top, width, total) {
  const pieces = [[0, data.variables[variable][3]]];
  for (const tick of playback.ticks) {
    for (const [changed, value] of tick.changes) {
      if (changed !== variable || value === pieces[pieces.length - 1][1]) continue;
      const x = tick.x * width;
      if (x === pieces[pieces.length - 1][0]) pieces[pieces.length - 1][1] = value;
      else pieces.push([x, value]);
    }
  }
  const end = (i) => (i + 1 < pieces.length ? pieces[i + 1][0] : total - 1);
  const number = (x) => x.toFixed(1);
  if (type === "BOOL") {
    const y = (value) => top + (value ? HIGH : LOW);
    let line = `M0 ${y(pieces[0][1])}`, area = "";
    pieces.forEach(([x, value], i) => {
      line += `V${y(value)}H${number(end(i))}`;
      if (value) area += `M${number(x)} ${top + LOW}V${top + HIGH}H${number(end(i))}V${top + LOW}z`;
      if (i + 1 < pieces.length) line += `M${number(end(i))} ${y(value)}`;
    });
    return svg("g", { class: "wave bool" }, svg("path", { class: "area", d: area || "M0 0" }), svg("path", { class: "line", d: line }));
  }
  const middle = top + (HIGH + LOW) / 2;
  return svg("g", { class: "wave bus" }, pieces.map(([x, value], i) => {
    const right = end(i), slant = Math.min(4, (right - x) / 2);
    const shape = `M${number(x)} ${middle}l${slant} ${top + HIGH - middle}H${number(right - slant)}l${slant} ${middle - top - HIGH}`
      + `l${-slant} ${top + LOW - middle}H${number(x + slant)}z`;
    const text = shown(value), room = Math.floor((right - x - 10) / 6.6);
    const label = text.length <= room ? text : room >= 3 ? `${text.slice(0, room - 1)}…` : "";
    const group = svg("g", {}, svg("path", { class: "line", d: shape }),
      label && svg("text", { x: number((x + right) / 2), y: middle + 4, "text-anchor": "middle" }, label));
    group.append(svg("title", {}, text));
    return group;
  }));
}
