// Elements of the page. Texts become text nodes and attributes, never markup.

const data = JSON.parse(document.getElementById("data").textContent);

function make(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children.flat(Infinity)) {
    if (child !== undefined && child !== null && child !== false) node.append(child);
  }
  return node;
}

const html = (name, attributes, ...children) => make(document.createElement(name), attributes, children);
const svg = (name, attributes, ...children) =>
  make(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);

const counted = (n, thing) => `${n.toLocaleString("en")} ${thing}${n === 1 ? "" : "s"}`;

// A button that says what it does to those who cannot see its sign.
const button = (sign, label, onclick, attributes) =>
  html("button", { type: "button", "aria-label": label, title: label, onclick, ...attributes }, sign);

// Signs drawn with lines, so that they look the same everywhere.
const SIGNS = {
  holds: "M3.5 8.5l3 3 6-7",
  violated: "M4 4l8 8M12 4l-8 8",
  unknown: "M5.5 6a2.5 2.5 0 1 1 3.6 2.2c-.8.4-1.1.9-1.1 1.8M8 12.4v.2",
  scanBack: "M12 3.5L7.5 8l4.5 4.5M4.5 3.5v9",
  lineBack: "M10 3.5L5.5 8l4.5 4.5",
  lineOn: "M6 3.5L10.5 8 6 12.5",
  scanOn: "M4 3.5L8.5 8 4 12.5M11.5 3.5v9",
  play: "M5 3.2v9.6L12.5 8z",
  pause: "M5.2 3.5v9M10.8 3.5v9",
  chevron: "M4 6l4 4 4-4",
};
const sign = (name) =>
  svg("svg", { viewBox: "0 0 16 16", class: `sign sign-${name}`, "aria-hidden": "true", focusable: "false" },
    svg("path", { d: SIGNS[name] }));

const VERDICTS = { holds: "holds", violated: "violated", unknown: "unknown" };
const badge = (verdict, word) =>
  html("span", { class: `badge ${verdict}` }, sign(verdict), word || VERDICTS[verdict]);

// Scrolls a box, not the page, so that a part of it can be seen.
function reveal(box, top, bottom, left, right) {
  const room = 24;
  if (top < box.scrollTop + room) box.scrollTop = Math.max(0, top - room);
  else if (bottom > box.scrollTop + box.clientHeight - room) box.scrollTop = bottom - box.clientHeight + room;
  if (left < box.scrollLeft + room) box.scrollLeft = Math.max(0, left - room);
  else if (right > box.scrollLeft + box.clientWidth - room) box.scrollLeft = right - box.clientWidth + room;
}
