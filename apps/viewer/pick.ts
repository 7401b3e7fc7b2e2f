// What lies under a point.

import { cornerNumbers, Field } from "./fields";
import { Layout } from "./picture";
import { Moment } from "./run";

export interface Picked {
  block: number;
  cell: number;
  corners: [number, number, number];
  weights: [number, number, number];
}

/** The triangle of a block that contains a point (relative to the run's centre); the last drawn of several. */
export function pick(layout: Layout, x: number, y: number): Picked | null {
  const { shape } = layout.moment, p = layout.position, { triangles, cornerPlace } = shape;
  for (let t = triangles.length - 3; t >= 0; t -= 3) {
    const a = 2 * cornerPlace[triangles[t]], b = 2 * cornerPlace[triangles[t + 1]], c = 2 * cornerPlace[triangles[t + 2]];
    const ax = p[a] - x, ay = p[a + 1] - y, bx = p[b] - x, by = p[b + 1] - y, cx = p[c] - x, cy = p[c + 1] - y;
    const wa = bx * cy - cx * by, wb = cx * ay - ax * cy, wc = ax * by - bx * ay, sum = wa + wb + wc;
    if (!(sum > 0 && wa >= 0 && wb >= 0 && wc >= 0)) continue;
    const cell = shape.cellOfCorner[triangles[t]];
    return {
      block: shape.blockOfCell[cell], cell,
      corners: [triangles[t], triangles[t + 1], triangles[t + 2]],
      weights: [wa / sum, wb / sum, wc / sum],
    };
  }
  return null;
}

/** The three numbers of a field's source at a picked point. */
export function numbersAt(moment: Moment, picked: Picked, source: Field["source"], smooth: boolean): [number, number, number] {
  const numbers = cornerNumbersOf(moment, source, smooth), at: [number, number, number] = [0, 0, 0];
  picked.corners.forEach((corner, i) => {
    for (let c = 0; c < 3; ++c) at[c] += picked.weights[i] * numbers[3 * corner + c];
  });
  return at;
}

const known = new WeakMap<Moment, Map<string, Float32Array>>();
/** Kept as long as the frame is. */
export function cornerNumbersOf(moment: Moment, source: Field["source"], smooth: boolean): Float32Array {
  let ofMoment = known.get(moment);
  if (!ofMoment) known.set(moment, (ofMoment = new Map()));
  const key = source + (smooth ? " averaged" : "");
  let numbers = ofMoment.get(key);
  if (!numbers) ofMoment.set(key, (numbers = cornerNumbers(moment, source, smooth)));
  return numbers;
}

/** The closed contact nearest to a point, none farther than `reach`. */
export function nearestContact(layout: Layout, x: number, y: number, reach: number): number | null {
  const { contacts, state } = layout.moment;
  let nearest: number | null = null, least = reach;
  for (let k = 0; k < contacts.count; ++k) {
    if (state[k] === 0) continue;
    const place = 2 * contacts.place[k];
    const distance = Math.hypot(layout.position[place] - x, layout.position[place + 1] - y);
    if (distance < least) {
      least = distance;
      nearest = k;
    }
  }
  return nearest;
}
