// Numbers as people read them.

const PREFIXES: [number, string][] = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

/** A unit with the prefix that suits a size: what numbers are divided by, and its symbol. */
export function scaledUnit(size: number, unit: string): [number, string] {
  if (unit === "") return [1, ""];
  const powers = unit.startsWith("m") ? PREFIXES.slice(3) : PREFIXES; // nobody writes km for a displacement
  for (const [factor, prefix] of powers)
    if (Math.abs(size) >= factor * 0.9999) return [factor, prefix + unit];
  const [factor, prefix] = size === 0 ? [1, ""] : powers[powers.length - 1];
  return [factor, prefix + unit];
}

/** With `digits` significant digits and a real minus sign. */
export function plain(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-4 ? value.toExponential(digits - 1)
                                          : String(Number(value.toPrecision(Math.max(digits, size >= 1 ? Math.ceil(Math.log10(size)) : 0))));
  return text.replace("-", "\u2212");
}

/** "12.3 kPa". */
export function quantity(value: number, unit: string, digits = 3): string {
  const [factor, symbol] = scaledUnit(value, unit);
  return plain(value / factor, digits) + (symbol ? "\u202f" + symbol : "");
}

/** A round step that divides a span into about `count` parts. */
export function roundStep(span: number, count: number): number {
  const rough = span / count, power = 10 ** Math.floor(Math.log10(rough));
  for (const factor of [1, 2, 5, 10]) if (factor * power >= rough * 0.999) return factor * power;
  return 10 * power;
}

/** Round values from low to high. */
export function ticks(low: number, high: number, count: number): number[] {
  if (!(high > low)) return [low];
  const step = roundStep(high - low, count), values: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) values.push(k === 0 ? 0 : k * step);
  return values;
}
