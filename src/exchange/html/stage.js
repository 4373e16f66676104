// The stage: everything that shows one run, moved together by one set of controls.

const TITLES = {
  counterexample: ["Counterexample", "a shortest run that breaks the requirement"],
  witness: ["Witness", "a run that shows that it is possible"],
  example: ["Example", "a run in which the premise occurs"],
};
let active = null;

function buildStage(answer, run) {
  const playback = new Playback(run);
  const scans = run.kind === "scans";
  const matters = new Map();
  if (run.purpose === "counterexample" && answer.why && answer.why.repair) {
    for (const [scan, variable, name, from, to] of answer.why.repair.changes) {
      matters.set(`${scan}:${variable}`, `matters: ${name} = ${to} instead of ${from}`);
    }
  }
  let index = 0, timer = null;
  const seek = (to) => show(to, false);

  const items = new Items(run);
  const diagram = timingDiagram(playback, items, { matters, notes: run.notes, seek });
  const source = listing();
  const table = runTable(playback, items, matters, seek);
  const hasNets = run.tokens && data.nets !== null;
  const around = (hasNets ? data.nets.around : []).map(([name, picture]) => ({ name, game: picture ? tokenGame(picture) : null }));
  const subnets = new Map();
  const netTitle = html("h4", {}, "Instruction");
  const netPlace = html("div", { class: "net-place" });

  const where = html("output", { class: "where", "aria-live": "polite" });
  const slider = html("input", { type: "range", min: 0, max: playback.length - 1, value: 0, "aria-label": "Position in the run",
    oninput: () => seek(Number(slider.value)) });
  const playing = button(sign("play"), "Play", () => (timer ? stop() : play()), { class: "main" });
  const bar = html("div", { class: "bar", role: "group", "aria-label": "Step through the run" },
    html("div", { class: "bar-buttons" },
      button(sign("scanBack"), scans ? "One scan back (Shift+←)" : "Scan back (Shift+←)", () => byScan(-1)),
      button(sign("lineBack"), "One step back (←)", () => byLine(-1)),
      playing,
      button(sign("lineOn"), "One step on (→)", () => byLine(1)),
      button(sign("scanOn"), scans ? "One scan on (Shift+→)" : "Scan on (Shift+→)", () => byScan(1))),
    slider, where);

  const card = (title, content, name, extra) => html("section", { class: `card ${name}` },
    html("header", {}, typeof title === "string" ? html("h4", {}, title) : title, extra), content);
  const [title, what] = TITLES[run.purpose];
  const length = scans ? counted(run.scans.length, "scan") : counted(run.firings.length, "firing");
  const element = html("div", { class: "stage", "data-purpose": run.purpose },
    html("div", { class: "stage-title" },
      html("h3", {}, title), html("p", {}, `${length}: ${what}.`, loopText())),
    run.notes.length > 0 && html("ul", { class: "notes" }, run.notes.map(([from, , , sentence]) =>
      html("li", {}, html("button", { type: "button", class: "link", onclick: () => seek(scans ? playback.find(from, -1) : from) }, coded(sentence))))),
    bar,
    card("Timing", diagram.element, "timing", diagram.more),
    html("div", { class: "pair" },
      card("Program", source.element, "program"),
      html("div", { class: "stack" },
        card(scans ? "Scans" : "Firings", table.element, "scans", html("span", { class: "extra" }, scans && legend(), table.extra)),
        hasNets && card(netTitle, netPlace, "instruction"))),
    hasNets
      ? card("PLC cycle and plant", surroundings(), "cycle")
      : html("p", { class: "hint" }, "This run is too long for the token game to be part of the page."));

  function legend() {
    return html("span", { class: "legend" }, html("span", {}, html("i", { class: "is-changed" }), "changed"),
      matters.size > 0 && html("span", {}, html("i", { class: "is-matters" }), "matters"));
  }

  // The cycle, and beside it the components of the plant.
  function surroundings() {
    const [cycle, ...components] = around.map(({ name, game }) => html("figure", {}, html("figcaption", {}, name),
      game ? game.element : nothing("This net is too large to be drawn here; `petril translate` writes it.")));
    return html("div", { class: components.length ? "around" : "around alone" }, cycle, components.length > 0 && html("div", {}, components));
  }

  function nothing(text) { return html("p", { class: "hint" }, coded(text)); }

  function loopText() {
    if (run.loop === null) return null;
    return scans
      ? ` Then for ever on: scan ${run.scans.length} ends in the state in which scan ${run.loop + 1} ended.`
      : ` Then for ever on: firing ${run.firings.length} leads back to the marking after firing ${run.loop}.`;
  }

  function subnet(line) {
    if (!subnets.has(line)) {
      const picture = data.nets.lines[line];
      subnets.set(line, picture ? tokenGame(picture) : null);
    }
    return subnets.get(line);
  }

  function show(to, step) {
    const on = step && to === index + 1;
    index = Math.max(0, Math.min(to, playback.length - 1));
    const tick = playback.ticks[index];
    const { values, marking } = playback.state(index);
    slider.value = index;
    diagram.show(index, values);
    source.show(playback, index);
    table.show(tick, index);
    if (marking) {
      for (const { game } of around) if (game) game.show(marking, tick.fired, on);
      showInstruction(tick, marking, on);
    }
    const text = describe(tick);
    where.replaceChildren(text);
    slider.setAttribute("aria-valuetext", where.textContent);
    element.dataset.tick = index;
    element.dataset.scan = scans ? tick.scan + 1 : tick.scan;
    element.dataset.kind = tick.kind;
    active = stage;
  }

  // The subnet of the instruction just executed; before the program and behind it, that of the first and the last one stay.
  function showInstruction(tick, marking, on) {
    let line = tick.line;
    for (let i = index; line === undefined && i < playback.length; i++) line = playback.ticks[i].line;
    for (let i = index; line === undefined && i >= 0; i--) line = playback.ticks[i].line;
    const game = line === undefined ? null : subnet(line);
    if (line !== undefined) {
      netTitle.replaceChildren("Instruction ", html("small", {}, `line ${line + 1}: `), html("code", {}, data.code[line][1]));
    }
    if (!game) netPlace.replaceChildren(nothing(`The net of this instruction is too large for a page; \`petril draw --line ${line + 1}\` draws it.`));
    else if (netPlace.firstChild !== game.element) netPlace.replaceChildren(game.element);
    if (game) game.show(marking, tick.fired, on);
  }

  function describe(tick) {
    const scan = scans ? `scan ${tick.scan + 1} of ${run.scans.length}` : `firing ${index} of ${run.firings.length}`;
    const parts = [html("b", {}, scan)];
    if (tick.kind === "begin") parts.push(tick.moves.length ? `plant: ${tick.moves.join(", ")}; inputs are read` : "inputs are read");
    if (tick.kind === "end") parts.push("end of the scan");
    if (tick.kind === "scan") parts.push("as a whole");
    if (tick.kind === "firing") parts.push(tick.name);
    if (tick.line !== undefined) {
      parts.push(html("span", {}, `line ${tick.line + 1} `, html("code", {}, data.code[tick.line][1])));
      if (tick.cr !== undefined) parts.push(html("span", { class: "cr" }, `CR ${shown(tick.cr)}`));
    }
    if (tick.write) parts.push(html("span", { class: "wrote" }, `${data.variables[tick.write[0]][0]} := ${shown(tick.write[1])}`));
    if (tick.hazard) parts.push(html("span", { class: "hazard" }, tick.hazard));
    return parts.flatMap((part, i) => (i ? [html("span", { class: "dot", "aria-hidden": "true" }, " · "), part] : [part]))
      .reduce((whole, part) => { whole.append(part); return whole; }, html("span", {}));
  }

  const byLine = (way) => { stop(); show(index + way, way > 0); };

  // To the end of this scan, then of the next one; back to its beginning, then to that of the one before.
  function byScan(way) {
    stop();
    const [first, last] = playback.scanOf(index);
    if (way > 0) show(index < last ? last : playback.scanOf(Math.min(last + 1, playback.length - 1))[1], false);
    else show(index > first ? first : playback.scanOf(Math.max(first - 1, 0))[0], false);
  }

  function play() {
    if (index + 1 >= playback.length) show(0, false);
    timer = setInterval(() => {
      if (index + 1 >= playback.length) stop();
      else show(index + 1, true);
    }, 600);
    // Nobody can listen as fast as it plays.
    where.setAttribute("aria-live", "off");
    playing.replaceChildren(sign("pause"));
    playing.setAttribute("aria-label", "Pause");
    playing.title = "Pause";
  }

  function stop() {
    clearInterval(timer);
    timer = null;
    where.setAttribute("aria-live", "polite");
    playing.replaceChildren(sign("play"));
    playing.setAttribute("aria-label", "Play");
    playing.title = "Play";
  }

  // Where the story is decided: at the instruction that wrote the value, if that was in the scan that is wrong, or at its end.
  function begin() {
    const broken = run.notes.length > 0 && scans ? run.notes[run.notes.length - 1][1] : playback.scans - 1;
    const writers = run.purpose === "counterexample" && answer.why ? answer.why.writers : [];
    const last = writers.filter(([, , scan]) => scan === broken).pop();
    const error = scans ? playback.ticks.findLastIndex((tick) => tick.hazard) : -1;
    show(error >= 0 ? error : last ? playback.find(broken, last[3]) : scans ? playback.find(broken, -1) : playback.length - 1, false);
    const names = run.about.map((variable) => data.variables[variable][0]);
    for (const { game } of around) if (game) game.aim(names);
  }

  const stage = {
    element, byLine, byScan, begin, stop,
    draw: (paper) => {
      diagram.draw(paper);
      if (paper) table.paper(400); else table.redraw();
      show(index, false);
    },
    to: (scan, line) => { stop(); show(playback.find(scan, line), false); },
    ends: (last) => { stop(); show(last ? playback.length - 1 : 0, false); },
  };
  return stage;
}

document.addEventListener("keydown", (event) => {
  if (!active || !active.element.isConnected || event.altKey || event.ctrlKey || event.metaKey) return;
  const field = event.target.closest("input, select, textarea");
  if (field && field.type !== "range") return;
  if (event.key === "ArrowRight" || event.key === "ArrowLeft") {
    const way = event.key === "ArrowRight" ? 1 : -1;
    if (event.shiftKey) active.byScan(way); else active.byLine(way);
  } else if (event.key === "Home" && field) active.ends(false);
  else if (event.key === "End" && field) active.ends(true);
  else return;
  event.preventDefault();
});
