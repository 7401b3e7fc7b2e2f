// What can be shown in colours, and its values.

import { Head, Moment } from "./run";

/** How a value comes from three numbers: stress, vector or kind. */
export enum Mode { none = 0, kind = 1, first = 2, second = 3, third = 4, length = 5, s1 = 6, s2 = 7, shear = 8 }

export interface Field {
  name: string; // as on the command line where dda plot has it too
  label: string;
  unit: string;
  mode: Mode;
  source: "none" | "displacement" | "velocity" | "stress" | "material" | "block";
  signed: boolean;
}

const ALL: Field[] = [
  { name: "s1", label: "σ₁  largest principal stress", unit: "Pa", mode: Mode.s1, source: "stress", signed: true },
  { name: "s2", label: "σ₂  smallest principal stress", unit: "Pa", mode: Mode.s2, source: "stress", signed: true },
  { name: "sxx", label: "σxx  horizontal stress", unit: "Pa", mode: Mode.first, source: "stress", signed: true },
  { name: "syy", label: "σyy  vertical stress", unit: "Pa", mode: Mode.second, source: "stress", signed: true },
  { name: "sxy", label: "σxy  shear stress", unit: "Pa", mode: Mode.third, source: "stress", signed: true },
  { name: "shear", label: "τmax  largest shear stress", unit: "Pa", mode: Mode.shear, source: "stress", signed: false },
  { name: "displacement", label: "|u|  displacement", unit: "m", mode: Mode.length, source: "displacement", signed: false },
  { name: "ux", label: "ux  horizontal displacement", unit: "m", mode: Mode.first, source: "displacement", signed: true },
  { name: "uy", label: "uy  vertical displacement", unit: "m", mode: Mode.second, source: "displacement", signed: true },
  { name: "velocity", label: "|v|  velocity", unit: "m/s", mode: Mode.length, source: "velocity", signed: false },
  { name: "vx", label: "vx  horizontal velocity", unit: "m/s", mode: Mode.first, source: "velocity", signed: true },
  { name: "vy", label: "vy  vertical velocity", unit: "m/s", mode: Mode.second, source: "velocity", signed: true },
  { name: "material", label: "materials", unit: "", mode: Mode.kind, source: "material", signed: false },
  { name: "block", label: "blocks", unit: "", mode: Mode.kind, source: "block", signed: false },
  { name: "none", label: "outlines only", unit: "", mode: Mode.none, source: "none", signed: false },
];

/** Those that the run holds. */
export function fieldsOf(head: Head): Field[] {
  return ALL.filter(({ source }) =>
    source === "displacement" || source === "velocity" || source === "stress" ? head.arrays[source] : true);
}

export interface Principal {
  s1: number;
  s2: number;
  angle: number; // of s1 from x, counter-clockwise
}

export function principal(sxx: number, syy: number, sxy: number): Principal {
  const mean = (sxx + syy) / 2, half = (sxx - syy) / 2, radius = Math.hypot(half, sxy);
  return { s1: mean + radius, s2: mean - radius, angle: Math.atan2(sxy, half) / 2 };
}

/** A field's value from its three numbers. */
export function valueOf(mode: Mode, a: number, b: number, c: number): number {
  switch (mode) {
    case Mode.second: return b;
    case Mode.third: return c;
    case Mode.length: return Math.hypot(a, b);
    case Mode.s1: return (a + b) / 2 + Math.hypot((a - b) / 2, c);
    case Mode.s2: return (a + b) / 2 - Math.hypot((a - b) / 2, c);
    case Mode.shear: return Math.hypot((a - b) / 2, c);
    default: return a;
  }
}

/** Three numbers for each corner of each cell: stress, vector or kind. */
export function cornerNumbers(moment: Moment, source: Field["source"], smooth: boolean): Float32Array {
  const { shape } = moment, n = shape.cornerPlace.length, numbers = new Float32Array(3 * n);
  const vectors = source === "displacement" ? moment.displacement : source === "velocity" ? moment.velocity : null;
  if (vectors)
    for (let k = 0; k < n; ++k) {
      const place = shape.cornerPlace[k];
      numbers[3 * k] = vectors[2 * place];
      numbers[3 * k + 1] = vectors[2 * place + 1];
    }
  else if (source === "material" || source === "block")
    for (let k = 0; k < n; ++k) {
      const block = shape.blockOfCell[shape.cellOfCorner[k]];
      numbers[3 * k] = (source === "material" ? shape.material[block] : block) % 8;
    }
  else if (source === "stress" && moment.stress) {
    fillStress(moment, moment.stress, numbers);
    if (smooth && shape.blockOfCell.length > shape.nBlocks) averageAtPlaces(moment, numbers);
  }
  return numbers;
}

/** The linear field of each cell at its corners. */
function fillStress(moment: Moment, stress: Float32Array, numbers: Float32Array): void {
  const { shape, displacement } = moment, { firstCorner, cornerPlace, reference } = shape;
  for (let cell = 0; cell + 1 < firstCorner.length; ++cell) {
    const first = firstCorner[cell], end = firstCorner[cell + 1];
    let cx = 0, cy = 0, size = 0;
    for (let k = first; k < end; ++k) {
      const place = 2 * cornerPlace[k];
      cx += reference[place] + displacement[place];
      cy += reference[place + 1] + displacement[place + 1];
    }
    cx /= end - first;
    cy /= end - first;
    for (let k = first; k < end; ++k) {
      const place = 2 * cornerPlace[k];
      size = Math.max(size, Math.hypot(reference[place] + displacement[place] - cx,
                                       reference[place + 1] + displacement[place + 1] - cy));
    }
    for (let k = first; k < end; ++k) {
      const place = 2 * cornerPlace[k];
      const x = (reference[place] + displacement[place] - cx) / size;
      const y = (reference[place + 1] + displacement[place + 1] - cy) / size;
      for (let c = 0; c < 3; ++c)
        numbers[3 * k + c] = stress[9 * cell + c] + x * stress[9 * cell + 3 + c] + y * stress[9 * cell + 6 + c];
    }
  }
}

/** Corners of cells at one place of a block get the mean of all of them. */
function averageAtPlaces(moment: Moment, numbers: Float32Array): void {
  const { cornerPlace, nPlaces } = moment.shape, sums = new Float32Array(3 * nPlaces), counts = new Uint16Array(nPlaces);
  for (let k = 0; k < cornerPlace.length; ++k) {
    ++counts[cornerPlace[k]];
    for (let c = 0; c < 3; ++c) sums[3 * cornerPlace[k] + c] += numbers[3 * k + c];
  }
  for (let k = 0; k < cornerPlace.length; ++k)
    for (let c = 0; c < 3; ++c) numbers[3 * k + c] = sums[3 * cornerPlace[k] + c] / counts[cornerPlace[k]];
}

/** The smallest, largest, 1st and 99th percentile of a field in one frame, as the program computes them. */
export function rangeOfFrame(field: Field, numbers: Float32Array): [number, number, number, number] {
  const n = numbers.length / 3, stride = Math.ceil(n / 20000), sampled: number[] = [];
  let low = Infinity, high = -Infinity;
  for (let k = 0; k < n; ++k) {
    const value = valueOf(field.mode, numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]);
    low = Math.min(low, value);
    high = Math.max(high, value);
    if (k % stride === 0) sampled.push(value);
  }
  if (n === 0) return [0, 0, 0, 0];
  sampled.sort((a, b) => a - b);
  const at = (fraction: number) => sampled[Math.round(fraction * (sampled.length - 1))];
  return [low, high, at(0.01), at(0.99)];
}

/** The same over all frames, from what the program found. */
export function rangeOfRun(field: Field, head: Head): [number, number, number, number] {
  const known = head.ranges[field.name];
  if (known) return known;
  if (field.name === "shear" && head.ranges.s1) {
    const [, most, , robust] = head.ranges.s1, [least, , low] = head.ranges.s2;
    return [0, (most - least) / 2, 0, (robust - low) / 2];
  }
  const length = head.ranges[field.source];
  if (!length) return [0, 0, 0, 0];
  return [-length[1], length[1], -length[3], length[3]];
}
