// The text of the program. Beside each line that the scan has passed so far stands what it left: the current result, and what it
// wrote.

function listing() {
  const rows = new Map();
  const body = html("ol", { class: "source-lines" });
  let last = 0;
  data.source.forEach((entry, i) => {
    const [number, text] = typeof entry === "string" ? [i + 1, entry] : entry;
    if (number !== last + 1) body.append(html("li", { class: "gap", "aria-hidden": "true" }, "⋮"));
    last = number;
    const note = html("span", { class: "left" });
    const row = html("li", { class: "source-line", "data-line": number },
      html("span", { class: "number", "aria-hidden": "true" }, String(number)),
      html("code", {}, text === "" ? " " : text), note);
    rows.set(number, { row, note });
    body.append(row);
  });
  const element = html("div", { class: "source-box", tabindex: "0", role: "group", "aria-label": "Program text" }, body);
  let touched = [];

  function show(playback, index) {
    for (const { row, note } of touched) {
      row.classList.remove("now", "passed", "wrote");
      row.removeAttribute("aria-current");
      note.replaceChildren();
    }
    touched = [];
    const [first] = playback.scanOf(index);
    const left = new Map();
    for (let i = first; i <= index; i++) {
      const tick = playback.ticks[i];
      if (tick.line === undefined) continue;
      const line = data.code[tick.line][0];
      const earlier = left.get(line) || { writes: new Map() };
      if (tick.cr !== undefined) earlier.cr = tick.cr;
      if (tick.write && tick.kind === "line") earlier.writes.set(tick.write[0], tick.write);
      if (tick.write && tick.kind === "firing") earlier.writes.set(tick.write[0], [...tick.write, 1]);
      if (tick.hazard) earlier.hazard = tick.hazard;
      left.set(line, earlier);
    }
    for (const [line, { cr, writes, hazard }] of left) {
      const found = rows.get(line);
      if (!found) continue;
      touched.push(found);
      found.row.classList.add("passed");
      if (cr !== undefined) found.note.append(html("span", { class: "cr" }, `CR ${shown(cr)}`));
      // Where much is written, as by a call, what changed is what matters.
      const all = [...writes.values()], changed = all.filter((write) => write[2]);
      const written = all.length > 2 ? changed : all;
      for (const [variable, value, isNew] of written.slice(0, 3)) {
        found.note.append(html("span", { class: isNew ? "write changed" : "write" }, `${data.variables[variable][0]} := ${shown(value)}`));
      }
      if (written.length > 3) found.note.append(html("span", { class: "write" }, `… ${written.length - 3} more`));
      if (hazard) found.note.append(html("span", { class: "hazard" }, hazard));
    }
    const tick = playback.ticks[index];
    const current = tick.line === undefined ? undefined : rows.get(data.code[tick.line][0]);
    if (current) {
      current.row.classList.add("now");
      current.row.setAttribute("aria-current", "step");
      const top = current.row.offsetTop - body.offsetTop;
      reveal(element, top - 60, top + current.row.offsetHeight + 60, element.scrollLeft + 30, element.scrollLeft + 30);
    } else if (touched.length > 0) {
      const last = touched[touched.length - 1].row;
      const top = last.offsetTop - body.offsetTop;
      reveal(element, top - 60, top + last.offsetHeight + 60, element.scrollLeft + 30, element.scrollLeft + 30);
    } else {
      element.scrollTop = Math.max(0, firstLine() - 60);
    }
  }

  // The first line that has an instruction.
  function firstLine() {
    const found = data.code.length ? rows.get(data.code[0][0]) : undefined;
    return found ? found.row.offsetTop - body.offsetTop : 0;
  }

  return { element, show };
}
