// A run as ticks: the moments at which one can look at it. The inputs of a scan are read in one, each instruction is one, and
// so is the end of a scan; a scan that is not told line by line is a single one. In the transition view each firing is one.
//
// `x` says where in the timing diagram a tick begins, in columns; `look` is where the cursor stands.

class Playback {
  constructor(run) {
    this.run = run;
    this.ticks = [];
    this.firstOf = [];
    if (run.kind === "scans") run.scans.forEach((scan, k) => this.addScan(scan, k));
    else this.addFirings(run.firings);
    this.columns = run.kind === "scans" ? run.scans.length : run.firings.length + 1;
    this.scans = this.firstOf.length;
    this.keepSnapshots();
  }

  get length() { return this.ticks.length; }

  add(tick) {
    const last = this.ticks[this.ticks.length - 1];
    if (!last || last.scan !== tick.scan) this.firstOf[tick.scan] = this.ticks.length;
    this.ticks.push(tick);
  }

  addScan(scan, k) {
    const pairs = (list) => {
      const found = [];
      for (let i = 0; i < (list || []).length; i += 2) found.push([list[i], list[i + 1]]);
      return found;
    };
    const inputs = pairs(scan.in), end = pairs(scan.end);
    if (!scan.lines) {
      this.add({ kind: "scan", scan: k, x: k, look: k + 0.5, changes: inputs.concat(end), fired: [] });
      return;
    }
    const { at, cr, writes, hazards, fired } = scan.lines;
    const lines = [];
    for (let i = 0; i < at.length; i += 2) for (let j = 0; j < at[i + 1]; j++) lines.push(at[i] + j);
    const slots = lines.length + 2;
    const place = (slot) => ({ scan: k, x: k + slot / slots, look: k + (slot + 0.5) / slots });
    this.add({ kind: "begin", ...place(0), changes: inputs, fired: scan.before || [], moves: scan.moves || [] });
    lines.forEach((line, i) => {
      const write = writes[i];
      this.add({
        kind: "line", ...place(i + 1), line, cr: cr[i], write, hazard: hazards[i],
        changes: write ? [[write[0], write[1]]] : [], fired: fired ? fired[i] : [],
      });
    });
    // A scan that never ends has no end to look at.
    if (scan.end) this.add({ kind: "end", ...place(slots - 1), changes: end, fired: scan.after || [] });
  }

  addFirings(firings) {
    this.add({ kind: "start", scan: 0, x: 0, look: 0.5, changes: [], fired: [] });
    firings.forEach((firing, i) => this.add({
      kind: "firing", scan: firing.scan, x: i + 1, look: i + 1.5, line: firing.line, cr: firing.cr, write: firing.set,
      changes: firing.set ? [firing.set] : [], fired: firing.fired === undefined ? [] : [firing.fired], name: firing.name,
    }));
    // Before the first scan the plant may have moved; scans without ticks of their own are skipped.
    this.firstOf = this.firstOf.filter((first) => first !== undefined);
  }

  // Values and markings are kept every so often and found from there.
  keepSnapshots() {
    const every = 64;
    this.every = every;
    this.kept = [];
    let values = data.variables.map((variable) => variable[3]);
    let marking = this.run.tokens ? initialMarking() : null;
    this.ticks.forEach((tick, i) => {
      if (i % every === 0) this.kept.push([values.slice(), marking && marking.slice()]);
      Playback.apply(tick, values, marking);
    });
  }

  static apply(tick, values, marking) {
    for (const [variable, value] of tick.changes) values[variable] = value;
    if (marking) for (const transition of tick.fired) {
      const [, taken, put] = data.nets.transitions[transition];
      for (const place of taken) marking[place] = 0;
      for (const place of put) marking[place] = 1;
    }
  }

  // The values of all variables and the marking after a tick.
  state(i) {
    const from = Math.floor(i / this.every);
    const [values, marking] = [this.kept[from][0].slice(), this.kept[from][1] && this.kept[from][1].slice()];
    for (let j = from * this.every; j <= i; j++) Playback.apply(this.ticks[j], values, marking);
    return { values, marking };
  }

  // First and last tick of the scan a tick belongs to.
  scanOf(i) {
    const scan = this.ticks[i].scan;
    let first = i, last = i;
    while (first > 0 && this.ticks[first - 1].scan === scan) first--;
    while (last + 1 < this.length && this.ticks[last + 1].scan === scan) last++;
    return [first, last];
  }

  // The last tick of a scan, or its last at a line of flat code.
  find(scan, line) {
    const [first, last] = this.scanOf(this.firstOf[Math.min(scan, this.firstOf.length - 1)]);
    for (let i = last; i >= first; i--) if (this.ticks[i].line === line && this.ticks[i].kind === "line") return i;
    return last;
  }

  // The tick at a place of the diagram.
  at(x) {
    let low = 0, high = this.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.ticks[middle].x <= x) low = middle; else high = middle - 1;
    }
    return low;
  }
}

function initialMarking() {
  const marking = new Uint8Array(data.nets.places.length);
  for (const place of data.nets.marked) marking[place] = 1;
  return marking;
}

// What a value looks like.
const shown = (value) => String(value);
