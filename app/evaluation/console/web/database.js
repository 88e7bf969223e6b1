// The page's own database in the browser: events that the station does not have yet, and lines that are being typed.

let opening = null;

/** Null where the browser gives none (a private window): the tab's storage alone keeps what is typed, then. */
export function database() {
  opening ??= new Promise((resolve) => {
    const request = indexedDB.open("molar", 1);
    request.onupgradeneeded = () => {
      request.result.createObjectStore("events", { keyPath: ["page", "seq"] });
      request.result.createObjectStore("lines", { keyPath: "id" });
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => resolve(null);
  });
  return opening;
}

export async function kept(store) {
  const base = await database();
  if (!base) return [];
  const request = base.transaction(store).objectStore(store).getAll();
  await new Promise((resolve) => (request.onsuccess = request.onerror = resolve));
  return request.result ?? [];
}

export async function keep(store, record) {
  (await database())?.transaction(store, "readwrite").objectStore(store).put(record);
}

export async function forget(store, key) {
  (await database())?.transaction(store, "readwrite").objectStore(store).delete(key);
}
