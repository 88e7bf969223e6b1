// A text of paragraphs and lists, as people write it in a file: lines of a paragraph run on, "- " begins a point.

import { h } from "./h.js";

export function paragraphs(text) {
  return text
    .split(/\n\s*\n/)
    .map((part) => part.trim())
    .filter((part) => part !== "")
    .map((part, n) => block(part, n));
}

function block(part, n) {
  if (!part.startsWith("- ")) return h("p", { key: n }, part.replace(/\s*\n\s*/g, " "));
  const points = part.split(/\n\s*- /).map((point) => point.replace(/^- /, "").replace(/\s*\n\s*/g, " "));
  return h("ul", { key: n }, points.map((point) => h("li", {}, point)));
}
