// The elements of the page.

export function element<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}
export const input = (id: string) => element<HTMLInputElement>(id);
export const select = (id: string) => element<HTMLSelectElement>(id);

/** Shows what went wrong. */
export function complain(error: unknown): void {
  const message = element("message");
  message.hidden = false;
  message.textContent = String(error instanceof Error ? error.message : error);
  console.error(error);
}

/** Names and values as a table. */
export function tableOf(rows: [string, string][]): HTMLTableElement {
  const table = document.createElement("table");
  for (const [name, value] of rows) {
    const row = table.insertRow();
    row.insertCell().textContent = name;
    row.insertCell().textContent = value;
  }
  return table;
}

/** The title of the page, and how the run ended. */
export function showHeading(title: string, program: string, verdict: string[]): void {
  document.title = title + " – " + program;
  element("title").textContent = element("title").title = title;
  for (const line of verdict) {
    const chip = document.createElement("span");
    chip.textContent = line.length > 70 ? line.slice(0, 69) + "…" : line;
    chip.title = line;
    if (line === "at rest") chip.className = "good";
    if (/^(not at rest|warning|stopped|interrupted)/.test(line)) chip.className = "bad";
    element("verdict").append(chip);
  }
}

/** Shows values beside a point of a picture of this size; hides them where there are none. */
export function showTip(title: string, rows: [string, string][] | null, [x, y]: [number, number], [width, height]: [number, number]): void {
  const tip = element("tip");
  tip.hidden = !rows;
  if (!rows) return;
  const name = document.createElement("b");
  name.textContent = title;
  tip.replaceChildren(name, tableOf(rows));
  tip.style.left = Math.max(4, Math.min(x + 16, width - tip.offsetWidth - 6)) + "px";
  tip.style.top = Math.max(4, y + 16 + tip.offsetHeight > height ? y - tip.offsetHeight - 12 : y + 16) + "px";
}
