// From values to colours.

import { Field } from "./fields";
import { Head } from "./run";

export type RangeChoice = "run" | "frame" | "extremes" | "own";

/** The values that the ends of the colours stand for. */
export class Scale {
  readonly low: number;
  readonly high: number;
  constructor(readonly field: Field, low: number, high: number, private readonly head: Head) {
    // One value alone is painted in a middle colour: it is no extreme.
    const size = Math.max(Math.abs(low), Math.abs(high));
    if (!(high - low > 1e-6 * size)) {
      low = field.signed ? Math.min(low, 0) * 2 : 0;
      high = field.signed ? Math.max(high, 0) * 2 : Math.max(high, 0) * 4;
      if (low === high) high = low + 1;
    }
    this.low = low;
    this.high = high;
  }

  /** Where the first and the last colour of the table stand: signed fields have zero in the middle. */
  get ends(): [number, number] {
    if (!this.field.signed) return [this.low, this.high];
    const most = Math.max(Math.abs(this.low), Math.abs(this.high));
    return [-most, most];
  }
  get table(): string[] {
    return this.field.signed ? this.head.colours.diverging : this.head.colours.sequential;
  }
  colour(value: number): string {
    const [low, high] = this.ends, last = this.table.length - 1;
    return this.table[Math.max(0, Math.min(last, Math.round(((value - low) / (high - low)) * last)))];
  }
}

/** Red, green, blue, 0 to 255, of "#rrggbb" or "#rgb". */
export function channels(hex: string): [number, number, number] {
  const digits = hex.length === 4 ? [...hex.slice(1)].map((d) => d + d).join("") : hex.slice(1);
  const number = parseInt(digits, 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

export const INK: [number, number, number] = [28, 36, 44];
export const STATE_COLOURS: { [state: string]: [number, number, number] } = {
  stick: [23, 122, 84],
  slip: [226, 88, 16],
  open: [124, 92, 214],
};
export const COMPRESSION: [number, number, number] = [21, 72, 158];
export const TENSION: [number, number, number] = [200, 30, 40];
export const FORCE: [number, number, number] = [16, 20, 26];
export const THRUST: [number, number, number] = [176, 0, 112];
