// A run as a table: one row a scan, or one a firing. What differs from the row above is marked, and so is the row one looks at.

function runTable(playback, matters, seek) {
  return playback.run.kind === "scans" ? scanTable(playback, matters, seek) : firingTable(playback, seek);
}

function scanTable(playback, matters, seek) {
  const { run } = playback;
  const groups = ["input", "memory", "output"].map((role) => data.variables.map((v, i) => [i, v]).filter(([, v]) => v[1] === role));
  const changing = new Set(run.scans.flatMap((scan) => [scan.in, scan.end || []].flatMap((list) => list.filter((_, i) => i % 2 === 0))));
  const still = (variable) => !changing.has(variable) && "still";
  const named = (...names) => names.filter(Boolean).join(" ") || undefined;
  const hasMoves = run.scans.some((scan) => scan.moves.length > 0);
  const shownGroups = groups.filter((group) => group.length > 0);
  const heads = { input: "inputs", memory: "memory", output: "outputs" };
  const first = html("tr", {}, html("th", { scope: "col", rowspan: 2 }, "scan"),
    shownGroups.map((group) => html("th", { scope: "colgroup", colspan: group.length, class: "group" }, heads[group[0][1][1]])),
    hasMoves && html("th", { scope: "col", rowspan: 2, class: "group moves" }, "plant, before the scan"));
  const second = html("tr", {}, shownGroups.map((group) => group.map(([variable, [name]], j) =>
    html("th", { scope: "col", class: named(j === 0 && "begins", still(variable)) }, name))));
  let values = data.variables.map((variable) => variable[3]);
  const rows = run.scans.map((scan, k) => {
    const before = values.slice();
    for (const list of [scan.in, scan.end || []]) for (let i = 0; i < list.length; i += 2) values[list[i]] = list[i + 1];
    const repeats = run.loop !== null && k + 1 === run.scans.length;
    const cells = shownGroups.map((group) => group.map(([variable, [name, role]], j) => {
      const unknown = !scan.end && role !== "input";
      const changed = !unknown && values[variable] !== before[variable];
      const why = matters.get(`${k}:${variable}`);
      return html("td", { class: named(j === 0 && "begins", still(variable), changed && "changed", why && "matters"), title: why || (changed ? `${name} changed from ${shown(before[variable])}` : undefined) },
        unknown ? "?" : shown(values[variable]), why && html("span", { class: "sr" }, ` (${why})`));
    }));
    const go = () => seek(playback.find(k, -1));
    return html("tr", { "data-scan": k + 1, onclick: go },
      html("th", { scope: "row" }, html("button", { type: "button", class: "link", "aria-label": `Go to scan ${k + 1}` },
        repeats ? `${k + 1} = ${run.loop + 1}` : String(k + 1))),
      cells, hasMoves && html("td", { class: "begins moves" }, scan.moves.join(", ")));
  });
  const element = html("div", { class: "table-box", tabindex: "0", role: "group", "aria-label": "Scans" },
    html("table", { class: "run-table" }, html("thead", {}, first, second), html("tbody", {}, rows)));
  return { element, show: (tick) => markRow(element, rows, tick.scan) };
}

function firingTable(playback, seek) {
  const { run } = playback;
  const start = html("tr", { onclick: () => seek(0) }, html("th", { scope: "row" }, html("button", { type: "button", class: "link" }, "0")),
    html("td", {}, ""), html("td", { class: "text" }, "the initial marking"), html("td", {}, ""), html("td", {}, ""));
  const rows = run.firings.map((firing, i) => html("tr", { "data-firing": i + 1, onclick: () => seek(i + 1) },
    html("th", { scope: "row" }, html("button", { type: "button", class: "link", "aria-label": `Go to firing ${i + 1}` },
      run.loop !== null && i + 1 === run.firings.length ? `${i + 1} = ${run.loop}` : String(i + 1))),
    html("td", {}, firing.scan || ""),
    html("td", { class: "text" }, firing.name),
    html("td", { class: "text" }, firing.line === undefined ? "" : data.code[firing.line][1]),
    html("td", { class: "text" }, firing.set ? `${data.variables[firing.set[0]][0]} = ${shown(firing.set[1])}` : "")));
  const head = html("tr", {}, ["firing", "scan", "transition", "instruction", "variable"].map((name, i) =>
    html("th", { scope: "col", class: i > 1 ? "text" : undefined }, name)));
  const all = [start, ...rows];
  const element = html("div", { class: "table-box", tabindex: "0", role: "group", "aria-label": "Firings" },
    html("table", { class: "run-table" }, html("thead", {}, head), html("tbody", {}, all)));
  return { element, show: (tick, index) => markRow(element, all, index) };
}

function markRow(box, rows, position) {
  for (const row of box.querySelectorAll("[aria-current]")) row.removeAttribute("aria-current");
  const row = rows[position];
  if (!row) return;
  row.setAttribute("aria-current", "step");
  reveal(box, row.offsetTop - 40, row.offsetTop + row.offsetHeight + 10, box.scrollLeft + 30, box.scrollLeft + 30);
}
