// A module of the page, as it is.

import path from "node:path";
import { pathToFileURL } from "node:url";

export function web(name) {
  return import(pathToFileURL(path.join(process.env.MOLAR_PAGES_WEB, name)).href);
}
