// A run as a table: one row a scan, or one a firing. What differs from the row above is marked, and so is the row one looks at.

function runTable(playback, items, matters, seek) {
  return playback.run.kind === "scans" ? scanTable(playback, items, matters, seek) : firingTable(playback, items, seek);
}

function scanTable(playback, items, matters, seek) {
  const { run } = playback;
  const heads = { input: "inputs", memory: "memory", output: "outputs" };
  const role = (variable) => data.variables[variable][1];
  const every = ["input", "memory", "output"].map((one) => data.variables.map((_, i) => i).filter((i) => role(i) === one));
  const changing = new Set();
  for (const scan of run.scans) for (const list of [scan.in, scan.end]) for (let i = 0; i < (list || []).length; i += 2) changing.add(list[i]);
  const still = (variable) => !changing.has(variable) && "still";
  const named = (...names) => names.filter(Boolean).join(" ") || undefined;
  const hasMoves = run.scans.some((scan) => scan.moves);
  const hidden = data.variables.length - run.columns.flat().length;
  let whole = false, groups = [];

  // The values at the end of a scan.
  const endOf = (k) => (k < 0 ? data.variables.map((variable) => variable[3]) : playback.state(playback.find(k, -1)).values);

  function make(from, to) {
    let values = null, next = -1;
    const rows = [];
    for (let i = from; i <= to; i++) {
      const item = items.list[i];
      if (item.fold) {
        rows.push(foldRow(item.fold));
        continue;
      }
      const k = item.first;
      if (next !== k) values = endOf(k - 1).slice();
      rows.push(scanRow(k, values));
      next = k + 1;
    }
    return rows;
  }

  function foldRow(fold) {
    const columns = 1 + groups.flat().length + (hasMoves ? 1 : 0);
    const open = (event) => { event.stopPropagation(); items.open(fold); };
    return html("tr", { class: "fold", onclick: () => seek(playback.find(fold.last, -1)) },
      html("td", { colspan: columns }, html("button", { type: "button", class: "link", onclick: open, "aria-label": `Show the ${fold.title}` }, `… ${fold.title}`),
        fold.moved.map((text) => html("span", { class: "moved" }, text)), " …"));
  }

  // The row of a scan; `values` are those before it, and then those at its end.
  function scanRow(k, values) {
    const scan = run.scans[k], before = values.slice();
    for (const list of [scan.in || [], scan.end || []]) for (let i = 0; i < list.length; i += 2) values[list[i]] = list[i + 1];
    const repeats = run.loop !== null && k + 1 === run.scans.length;
    const cells = groups.map((group) => group.map((variable, j) => {
      const [name, its] = data.variables[variable];
      const unknown = !scan.end && its !== "input";
      const changed = !unknown && values[variable] !== before[variable];
      const why = matters.get(`${k}:${variable}`);
      return html("td", { class: named(j === 0 && "begins", still(variable), changed && "changed", why && "matters"), title: why || (changed ? `${name} changed from ${shown(before[variable])}` : undefined) },
        unknown ? "?" : shown(values[variable]), why && html("span", { class: "sr" }, ` (${why})`));
    }));
    const loops = run.loop !== null && k > run.loop;
    return html("tr", { "data-scan": k + 1, class: named(loops && "in-loop"), onclick: () => seek(playback.find(k, -1)) },
      html("th", { scope: "row" }, html("button", { type: "button", class: "link", "aria-label": `Go to scan ${k + 1}` },
        repeats ? `${k + 1} = ${run.loop + 1}` : String(k + 1))),
      cells, hasMoves && html("td", { class: "begins moves" }, (scan.moves || []).join(", ")));
  }

  const thead = html("thead"), body = html("tbody");
  const element = html("div", { class: "table-box", tabindex: "0", role: "group", "aria-label": "Scans" },
    html("table", { class: "run-table" }, thead, body));
  const rows = windowedRows(element, body, { count: () => items.length, make });

  function arrange() {
    groups = (whole ? every : run.columns).filter((group) => group.length > 0);
    const title = (group) => (group.every((variable) => role(variable) === role(group[0])) ? heads[role(group[0])] : "what matters");
    thead.replaceChildren(
      html("tr", {}, html("th", { scope: "col", rowspan: 2 }, "scan"),
        groups.map((group) => html("th", { scope: "colgroup", colspan: group.length, class: "group" }, title(group))),
        hasMoves && html("th", { scope: "col", rowspan: 2, class: "group moves" }, "plant, before the scan")),
      html("tr", {}, groups.map((group) => group.map((variable, j) =>
        html("th", { scope: "col", class: named(j === 0 && "begins", still(variable)) }, data.variables[variable][0])))));
  }
  arrange();
  let now = 0;
  items.listeners.push((scan) => rows.redraw(items.at(now), scan === undefined ? undefined : items.at(scan)));

  const columns = hidden > 0 && html("button", { type: "button", class: "link", "aria-pressed": "false", onclick: () => {
    whole = !whole;
    columns.setAttribute("aria-pressed", String(whole));
    columns.textContent = whole ? "fewer columns" : `${hidden} more columns`;
    arrange();
    rows.redraw();
  } }, `${hidden} more columns`);
  const folds = items.folds.length > 0 && html("button", { type: "button", class: "link", "aria-pressed": "false", onclick: () => {
    const open = items.folds.some((fold) => !fold.open);
    items.openAll(open);
  } });
  const label = () => {
    if (!folds) return;
    const closed = items.folds.some((fold) => !fold.open);
    folds.textContent = closed ? `all ${run.scans.length.toLocaleString("en")} scans` : "fold again";
    folds.setAttribute("aria-pressed", String(!closed));
  };
  label();
  items.listeners.push(label);
  return { element, extra: [folds, columns], paper: rows.paper, redraw: () => rows.redraw(),
    show: (tick) => { now = tick.scan; rows.show(items.at(now)); } };
}

function firingTable(playback, items, seek) {
  const { run } = playback;
  const row = (i) => {
    if (i === 0) {
      return html("tr", { onclick: () => seek(0) }, html("th", { scope: "row" }, html("button", { type: "button", class: "link" }, "0")),
        html("td", {}, ""), html("td", { class: "text" }, "the initial marking"), html("td", {}, ""), html("td", {}, ""));
    }
    const firing = run.firings[i - 1];
    return html("tr", { "data-firing": i, onclick: () => seek(i) },
      html("th", { scope: "row" }, html("button", { type: "button", class: "link", "aria-label": `Go to firing ${i}` },
        run.loop !== null && i === run.firings.length ? `${i} = ${run.loop}` : String(i))),
      html("td", {}, firing.scan || ""),
      html("td", { class: "text" }, firing.name),
      html("td", { class: "text" }, firing.line === undefined ? "" : data.code[firing.line][1]),
      html("td", { class: "text" }, firing.set ? `${data.variables[firing.set[0]][0]} = ${shown(firing.set[1])}` : ""));
  };
  const make = (from, to) => Array.from({ length: to - from + 1 }, (_, i) => row(from + i));
  const head = html("tr", {}, ["firing", "scan", "transition", "instruction", "variable"].map((name, i) =>
    html("th", { scope: "col", class: i > 1 ? "text" : undefined }, name)));
  const body = html("tbody");
  const element = html("div", { class: "table-box", tabindex: "0", role: "group", "aria-label": "Firings" },
    html("table", { class: "run-table" }, html("thead", {}, head), body));
  const rows = windowedRows(element, body, { count: () => items.length, make });
  return { element, extra: [], show: (tick, index) => rows.show(index), paper: rows.paper, redraw: () => rows.redraw() };
}
