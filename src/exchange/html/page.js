// The page: what was checked, the list of answers, and each answer when it is opened.

const report = document.getElementById("report");
const requirements = data.answers.filter((answer) => answer.kind === "requirement");
const checks = data.answers.filter((answer) => answer.kind === "check");
const number = (list, verdict) => list.filter((answer) => answer.verdict === verdict).length;
const ORDER = ["violated", "unknown", "holds"];

// The two texts that one reads first.
function headline() {
  const [violated, unknown, holds] = ORDER.map((verdict) => number(requirements, verdict));
  const empty = requirements.filter((answer) => answer.vacuous).length;
  const failing = checks.filter((check) => check.verdict !== "holds");
  const checked = failing.map((check) => `${check.name} is ${check.verdict}`).join(", ");
  if (requirements.length === 0) return checked ? `${checked}.` : "No requirements were given; nothing went wrong.";
  const all = counted(requirements.length, "requirement");
  const parts = [violated && `${violated} violated`, unknown && `${unknown} unknown`, holds && `${holds} hold${holds === 1 ? "s" : ""}${empty ? ` (${empty} vacuously)` : ""}`];
  return `${all}: ${parts.filter(Boolean).join(", ")}${checked ? `; ${checked}` : ""}.`;
}

function header() {
  const share = html("div", { class: "share", "aria-hidden": "true" });
  for (const verdict of ORDER) {
    const n = number(data.answers, verdict);
    if (n) {
      const part = html("span", { class: verdict });
      part.style.flexGrow = n;
      share.append(part);
    }
  }
  const made = new Date(data.made);
  const when = isNaN(made) ? data.made : made.toISOString().replace("T", " ").slice(0, 16) + " UTC";
  return html("header", { class: "top" },
    html("div", { class: "top-row" },
      html("div", { class: "brand" }, html("span", { class: "mark", "aria-hidden": "true" }), "Petril report"),
      themeSwitch()),
    html("div", { class: "title-row" }, html("h1", {}, data.program), badge(data.verdict)),
    html("p", { class: "headline" }, headline()),
    share,
    html("p", { class: "meta" }, html("span", {}, data.file), html("span", {}, when), html("span", {}, `Petril ${data.petril}`)));
}

function provenance() {
  const row = ([what, text]) => [html("dt", {}, what), html("dd", {}, html("code", {}, text))];
  return html("section", { class: "panel wide", "aria-label": "Where this report comes from" },
    html("h2", {}, "Provenance"), html("dl", { class: "provenance" }, data.provenance.flatMap(row)));
}

function facts() {
  const [states, steps, depth, how] = data.explored;
  const item = (n, what) => html("div", { class: "fact" }, html("b", {}, n.toLocaleString("en")), html("span", {}, what));
  const places = data.net.reduce((sum, part) => sum + part[1], 0), transitions = data.net.reduce((sum, part) => sum + part[2], 0);
  const plural = (n, thing) => (n === 1 ? thing : thing.replace(/^(\w+ )?(state|step|firing|scan|marking)/, "$&s"));
  return html("section", { class: "facts", "aria-label": "What was explored, and under which assumptions" },
    html("div", { class: "panel" }, html("h2", {}, "Explored"),
      html("div", { class: "fact-row" },
        item(states[1], plural(states[1], states[0])), item(steps[1], plural(steps[1], steps[0])),
        item(depth[1], `${plural(depth[1], depth[0])} deep`), item(places, "places"), item(transitions, "transitions")),
      html("p", { class: data.complete ? "complete" : "partial" }, sign(data.complete ? "holds" : "unknown"),
        `${how[0].toUpperCase()}${how.slice(1)}.`),
      covered()),
    html("div", { class: "panel" }, html("h2", {}, "Assumed"), html("ul", {}, data.assumptions.map((text) => html("li", {}, coded(text))))),
    data.warnings.length > 0 && html("div", { class: "panel" }, html("h2", {}, "Warnings"), html("ul", {}, data.warnings.map((text) => html("li", {}, coded(text))))),
    data.remarks.length > 0 && html("div", { class: "panel wide" }, html("h2", {}, "Worth knowing"),
      html("ul", {}, data.remarks.map(([text]) => html("li", {}, coded(text))))));
}

// Every line is modelled: what cannot be is an error before. Not every line need be executed.
function covered() {
  const [lines, executed] = data.covered;
  const whole = executed === lines;
  const text = executed === null ? `All ${counted(lines, "line")} of code are modelled.`
    : `All ${counted(lines, "line")} of code are modelled; ${whole ? "each" : executed} of them ${whole || executed === 1 ? "is" : "are"} executed in some scan.`;
  return html("p", { class: executed === null || whole ? "complete" : "partial" }, sign(executed === null || whole ? "holds" : "unknown"), text);
}

// A sentence in which names stand between backquotes.
function coded(text) {
  return text.split("`").map((part, i) => (i % 2 ? html("code", {}, part) : part));
}

function themeSwitch() {
  const root = document.documentElement;
  const kept = (() => { try { return localStorage.getItem("petril-theme"); } catch { return null; } })();
  const choose = (theme) => {
    if (theme === "auto") delete root.dataset.theme; else root.dataset.theme = theme;
    for (const choice of choices) choice.setAttribute("aria-pressed", String(choice.dataset.choice === theme));
    try { localStorage.setItem("petril-theme", theme); } catch { /* a file may keep nothing */ }
  };
  const choices = ["auto", "light", "dark"].map((theme) => html("button", {
    type: "button", "data-choice": theme, "aria-pressed": "false", onclick: () => choose(theme),
  }, theme[0].toUpperCase() + theme.slice(1)));
  choose(["light", "dark"].includes(kept) ? kept : "auto");
  return html("div", { class: "segments themes", role: "group", "aria-label": "Colours" }, choices);
}

// The list and what narrows it.
const filter = { verdict: "all", text: "", tag: "" };
const rows = [];
const found = html("p", { class: "found", role: "status" });

function filters() {
  const all = [["all", data.answers.length], ...ORDER.map((verdict) => [verdict, number(data.answers, verdict)])];
  const choices = all.filter(([, n]) => n > 0).map(([verdict, n]) => html("button", {
    type: "button", class: verdict, "data-verdict": verdict, "aria-pressed": String(verdict === "all"),
    onclick: (event) => {
      filter.verdict = verdict;
      for (const choice of choices) choice.setAttribute("aria-pressed", String(choice === event.currentTarget));
      narrow();
    },
  }, verdict[0].toUpperCase() + verdict.slice(1), html("span", { class: "count" }, String(n))));
  const tags = [...new Set(data.answers.flatMap((answer) => answer.tags || []))].sort();
  const search = html("input", { type: "search", placeholder: "Search names, words, formulas", "aria-label": "Search the requirements",
    oninput: (event) => { filter.text = event.currentTarget.value.toLowerCase(); narrow(); } });
  const tag = tags.length > 0 && html("select", { "aria-label": "Tag", onchange: (event) => { filter.tag = event.currentTarget.value; narrow(); } },
    html("option", { value: "" }, "All tags"), tags.map((name) => html("option", { value: name }, name)));
  return html("div", { class: "filters", role: "search" },
    html("div", { class: "segments", role: "group", "aria-label": "Verdict" }, choices), search, tag);
}

function narrow() {
  let n = 0;
  for (const { answer, element } of rows) {
    const text = [answer.name, answer.sentence, answer.words, answer.formula, ...(answer.tags || [])].join("\n").toLowerCase();
    const fits = (filter.verdict === "all" || answer.verdict === filter.verdict)
      && text.includes(filter.text) && (!filter.tag || (answer.tags || []).includes(filter.tag));
    element.hidden = !fits;
    n += fits;
  }
  for (const heading of document.querySelectorAll("h2[data-list]")) {
    heading.hidden = !rows.some(({ answer, element }) => answer.kind === heading.dataset.list && !element.hidden);
  }
  found.textContent = n === rows.length ? "" : n === 0 ? "Nothing fits." : `${n} of ${rows.length} shown`;
}

function row(answer, i) {
  const panel = html("div", { class: "answer-panel", id: `panel-${i}`, role: "region", "aria-label": answer.name, hidden: true });
  const opener = html("button", { type: "button", class: "answer-head", "aria-expanded": "false", "aria-controls": `panel-${i}` },
    answer.vacuous ? badge("unknown", "vacuous") : badge(answer.verdict),
    answer.known && html("span", { class: "known" }, "known from an earlier run"),
    html("span", { class: "answer-text" },
      html("span", { class: "answer-name" }, answer.name),
      html("span", { class: answer.sentence ? "answer-sentence" : "answer-sentence formula" }, answer.sentence || answer.words || answer.formula)),
    html("span", { class: "tags" }, (answer.tags || []).map((tag) => html("span", { class: "tag" }, tag))),
    sign("chevron"));
  const element = html("article", { class: `answer ${answer.verdict}`, "data-name": answer.name, "data-verdict": answer.verdict }, opener, panel);
  let stages = [];
  const toggle = (open) => {
    opener.setAttribute("aria-expanded", String(open));
    element.classList.toggle("open", open);
    panel.hidden = !open;
    if (open) stages = fill(panel, answer);
    else {
      stages.forEach((stage) => stage.stop());
      panel.replaceChildren();
      stages = [];
    }
  };
  opener.addEventListener("click", () => {
    const open = panel.hidden;
    toggle(open);
    if (open) try { history.replaceState(null, "", `#${encodeURIComponent(answer.name)}`); } catch { /* as in some viewers */ }
  });
  rows.push({ answer, element, toggle, isOpen: () => !panel.hidden, stages: () => stages });
  return element;
}

// What an opened answer says.
function fill(panel, answer) {
  const stages = answer.runs.map((run) => buildStage(answer, run));
  const counterexample = stages.find((_, i) => answer.runs[i].purpose === "counterexample");
  const line = (what, ...content) => [html("dt", {}, what), html("dd", {}, content)];
  const facts = html("dl", { class: "said" },
    answer.words && answer.sentence && line("Means", coded(answer.words)),
    (answer.sentence || answer.words) && line("Formula", html("code", {}, answer.formula)),
    answer.origin && line("Stands in", html("span", { class: "file" }, answer.origin)),
    answer.remark && answer.runs.length > 0 && line("Mind", coded(answer.remark)),
    answer.reason && answer.runs.length === 0 && line(answer.verdict === "unknown" ? "Unknown because" : "Mind", coded(answer.reason)),
    answer.verdict === "holds" && line("Verdict", `proved on all ${data.explored[0][1].toLocaleString("en")} states, under the assumptions above`));
  panel.replaceChildren(facts, answer.why ? explanation(answer.why, counterexample) : "", ...stages.map((stage) => stage.element));
  for (const stage of stages.slice().reverse()) stage.begin();
  return stages;
}

function explanation(why, stage) {
  const jump = (text, scan, line) => html("button", { type: "button", class: "link", onclick: () => {
    if (!stage) return;
    stage.to(scan, line);
    stage.element.querySelector(".bar").scrollIntoView({ block: "start" });
  } }, text);
  const writers = why.writers.map(([name, value, scan, line]) => {
    const from = data.code[line];
    return html("li", {}, html("code", {}, `${name} = ${value}`), ` was written in scan ${scan + 1} by `,
      jump(`line ${from[0]} of the program`, scan, line), " ", html("code", { class: "quiet" }, from[1]));
  });
  const changes = why.repair ? why.repair.changes.map(([scan, , name, from, to]) =>
    html("li", {}, html("code", {}, `${name} = ${to}`), ` instead of ${from} in `, jump(`scan ${scan + 1}`, scan, -1))) : [];
  const unwritten = why.unwritten.map((name) => html("li", {}, html("code", {}, name), " by nobody: it has its initial value"));
  return html("section", { class: "why" }, html("h3", {}, "Why"),
    why.wanted.length > 0 && html("div", {}, html("h4", {}, "Wanted"), html("ul", {}, why.wanted.map((text) => html("li", {}, coded(text))))),
    writers.length + unwritten.length > 0 && html("div", {}, html("h4", {}, "Written"), html("ul", {}, writers, unwritten)),
    changes.length > 0 && html("div", {}, html("h4", {}, "Inputs that matter"), html("ul", {}, changes),
      html("p", { class: "hint" }, `With ${changes.length === 1 ? "this value" : "these values"} the run would not break the requirement.`,
        why.repair.smallest && changes.length > 1 && " No change of fewer inputs does that."),
      why.repair.others.length > 0 && html("details", {}, html("summary", {}, "Others would do as well"),
        html("ul", {}, why.repair.others.map((text) => html("li", {}, text))))),
    why.unrepaired && html("div", {}, html("h4", {}, "Inputs that matter"), html("p", { class: "hint" }, `None is named: ${why.unrepaired}.`)));
}

// Violated first, then unknown; within a verdict as they were given.
const sorted = (list) => ORDER.flatMap((verdict) => list.filter((answer) => answer.verdict === verdict));
const list = (name, title, answers) => answers.length > 0 && [
  html("h2", { "data-list": name }, title), html("div", { class: "answers" }, sorted(answers).map((answer) => row(answer, data.answers.indexOf(answer)))),
];
report.append(
  header(),
  html("main", {}, facts(), filters(), found,
    list("requirement", "Requirements", requirements), list("check", "Checked without asking", checks), provenance()),
  html("footer", {}, html("p", {}, "Every run on this page was replayed by the interpreter and by the token game on the net, which agree on every bit. ",
    "Steps: ", html("kbd", {}, "←"), " ", html("kbd", {}, "→"), ", scans: ", html("kbd", {}, "Shift"), " with them.")));

// The one that the address names is open at the beginning, or the only one that is violated.
function openNamed() {
  let name = "";
  try { name = decodeURIComponent(location.hash.slice(1)); } catch { /* not ours */ }
  const chosen = rows.find(({ answer }) => answer.name === name);
  const violated = rows.filter(({ answer }) => answer.verdict === "violated");
  const one = chosen || (violated.length === 1 ? violated[0] : null);
  if (!one) return;
  if (!one.isOpen()) one.toggle(true);
  if (chosen) one.element.scrollIntoView();
}
openNamed();
addEventListener("hashchange", openNamed);

// On paper everything that is violated is open, and diagrams are as wide as it.
const PAPER = 520;
let opened = [];
addEventListener("beforeprint", () => {
  opened = rows.filter((one) => one.answer.verdict === "violated" && !one.isOpen()).slice(0, 100);
  opened.forEach((one) => one.toggle(true));
  rows.filter((one) => one.isOpen()).forEach((one) => one.stages().forEach((stage) => stage.draw(PAPER)));
});
addEventListener("afterprint", () => {
  opened.forEach((one) => one.toggle(false));
  opened = [];
  rows.filter((one) => one.isOpen()).forEach((one) => one.stages().forEach((stage) => stage.draw()));
});
