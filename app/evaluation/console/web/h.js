// What the page shows, as a description of elements, laid over the elements that are there: those that stay the same are
// kept, with their focus and their caret. Text is set as text, nothing is ever read as markup.

const kKey = Symbol("key");
const kProps = Symbol("props");

/** An element. A child is text, a number, an element, a list of these, or nothing (null, false). `key` tells siblings
 *  apart; `own(node)` is called once, and what is in that element is left alone from then on. */
export function h(tag, props, ...children) {
  const { key = null, own = null, ...rest } = props ?? {};
  return { tag, key, own, props: rest, children: flat(children) };
}

function flat(children) {
  const list = [];
  for (const child of children) {
    if (child === null || child === undefined || child === false || child === "") continue;
    if (Array.isArray(child)) list.push(...flat(child));
    else list.push(typeof child === "object" ? child : String(child));
  }
  return list;
}

/** Lays the children over what is in `parent`. */
export function show(parent, ...children) {
  const list = flat(children);
  const keyed = new Map();
  for (const node of parent.childNodes) if (node[kKey] != null) keyed.set(node[kKey], node);
  const stays = new Set(list.map((one) => one.key).filter((key) => key != null));

  let at = parent.firstChild;
  for (const one of list) {
    // What goes is taken out first, so that what stays need not be moved.
    while (at && at[kKey] != null && !stays.has(at[kKey])) at = removed(at);
    let node = one.key != null ? keyed.get(one.key) : at;
    if (!node || !isLike(node, one)) node = made(one);
    if (node === at) at = at.nextSibling;
    else parent.insertBefore(node, at);
    lay(node, one);
  }
  while (at) at = removed(at);
}

function removed(node) {
  const next = node.nextSibling;
  node.remove();
  return next;
}

function isLike(node, one) {
  if (typeof one === "string") return node.nodeType === Node.TEXT_NODE;
  return node.nodeType === Node.ELEMENT_NODE && node.localName === one.tag && (node[kKey] ?? null) === one.key;
}

function made(one) {
  if (typeof one === "string") return document.createTextNode(one);
  const node = document.createElement(one.tag);
  node[kKey] = one.key;
  node[kProps] = {};
  return node;
}

function lay(node, one) {
  if (typeof one === "string") {
    if (node.nodeValue !== one) node.nodeValue = one;
    return;
  }
  const before = node[kProps];
  const is_new = Object.keys(before).length === 0;
  for (const name of Object.keys(before)) if (!(name in one.props)) put(node, name, null);
  for (const [name, value] of Object.entries(one.props)) if (before[name] !== value) put(node, name, value);
  node[kProps] = { ...one.props, "": true };
  if (one.own) {
    if (is_new) one.own(node);
  } else {
    show(node, one.children);
  }
  // After its children: a select's value is one of them; what a person is typing stays.
  if ("value" in one.props && node.value !== String(one.props.value)) node.value = one.props.value;
  if ("checked" in one.props && node.checked !== one.props.checked) node.checked = one.props.checked;
}

function put(node, name, value) {
  if (name === "" || name === "value" || name === "checked") return;
  if (name.startsWith("on")) {
    node[name] = value;
  } else if (name === "style") {
    for (const [property, setting] of Object.entries(value ?? {})) node.style.setProperty(property, setting);
  } else if (value === null || value === undefined || value === false) {
    node.removeAttribute(name);
  } else {
    node.setAttribute(name, value === true ? "" : value);
  }
}
