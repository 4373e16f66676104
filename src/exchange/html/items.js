// A run as it is shown: scans or firings, and stretches of scans that are told in one line until they are opened. Table and diagram
// have an item for each.

class Items {
  constructor(run) {
    this.count = run.kind === "scans" ? run.scans.length : run.firings.length + 1;
    this.folds = run.folds.map(([first, last, title, moved]) => ({ first, last, title, moved, open: false }));
    this.listeners = [];
    this.arrange();
  }

  arrange() {
    this.list = [];
    let next = 0;
    const plain = (end) => { for (; next < end; next++) this.list.push({ first: next, last: next }); };
    for (const fold of this.folds) {
      plain(fold.first);
      if (fold.open) continue;
      this.list.push({ first: fold.first, last: fold.last, fold });
      next = fold.last + 1;
    }
    plain(this.count);
  }

  get length() { return this.list.length; }

  // The position of the item that has a scan.
  at(scan) {
    let low = 0, high = this.list.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.list[middle].first <= scan) low = middle; else high = middle - 1;
    }
    return low;
  }

  open(fold) {
    fold.open = true;
    this.changed(fold.first);
  }

  // All stretches, open or not.
  openAll(open) {
    for (const fold of this.folds) fold.open = open;
    this.changed();
  }

  // `scan` is the one to look at, if it is not the present one.
  changed(scan) {
    this.arrange();
    for (const listener of this.listeners) listener(scan);
  }
}

const movement = (fold) => `${fold.title}${fold.moved.length ? ": " : ""}${fold.moved.join(", ")}`;

// The rows of a table, of which a long one has elements only where one looks.
function windowedRows(box, body, { count, make }) {
  const WHOLE = 250, AROUND = 60;
  let first = 0, last = -1, height = 27, rows = [];
  const gap = () => html("tr", { class: "gap", "aria-hidden": "true" }, html("td", { colspan: 99 }));

  function draw(from, to) {
    first = from;
    last = to;
    rows = make(from, to);
    const [above, below] = [gap(), gap()];
    above.firstChild.style.height = `${from * height}px`;
    below.firstChild.style.height = `${(count() - 1 - to) * height}px`;
    body.replaceChildren(...(from > 0 ? [above] : []), ...rows, ...(to < count() - 1 ? [below] : []));
    if (rows.length && rows[0].offsetHeight) height = body.querySelector("tr:not(.gap)").offsetHeight;
  }

  function around(position) {
    if (count() <= WHOLE) draw(0, count() - 1);
    else draw(Math.max(0, position - AROUND), Math.min(count() - 1, position + AROUND));
  }

  box.addEventListener("scroll", () => {
    if (count() <= WHOLE) return;
    const top = Math.floor(box.scrollTop / height), bottom = Math.ceil((box.scrollTop + box.clientHeight) / height);
    if ((top < first + 8 && first > 0) || (bottom > last - 8 && last < count() - 1)) {
      around(Math.min(count() - 1, (top + bottom) >> 1));
      mark();
    }
  });

  let current = -1;
  function mark() {
    for (const row of body.querySelectorAll("[aria-current]")) row.removeAttribute("aria-current");
    const row = rows[current - first];
    if (row) row.setAttribute("aria-current", "step");
    return row;
  }

  function show(position) {
    current = position;
    if (position < first || position > last) around(position);
    const row = mark();
    if (row) reveal(box, row.offsetTop - 40, row.offsetTop + row.offsetHeight + 10, box.scrollLeft + 30, box.scrollLeft + 30);
  }

  // On paper there is nothing to scroll.
  function paper(most) { draw(0, Math.min(count() - 1, most - 1)); }

  // Makes the rows again; the present one is at a position, and one looks at another, if that is given.
  function redraw(position = Math.max(0, current), look) {
    current = position;
    around(look === undefined ? position : look);
    const row = mark();
    if (look !== undefined) box.scrollTop = (rows[look - first] || body).offsetTop - 80;
    else if (row) show(position);
  }

  return { show, paper, redraw };
}
