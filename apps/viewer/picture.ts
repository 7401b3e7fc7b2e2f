// One frame as it is drawn: positions with magnified displacements, and the lines that go on top.

import { COMPRESSION, FORCE, INK, STATE_COLOURS, TENSION, THRUST } from "./colours";
import { principal } from "./fields";
import { CONTACT_STATES, Moment, normalOf } from "./run";
import { Lines } from "./renderer";

/** Contacts between two blocks, with their sum. */
export interface Joint {
  first: number; // blocks
  second: number;
  contacts: number[];
  x: number; // where the sum acts: mean of the contacts, weighed by their normal forces
  y: number;
  ofFirst: boolean; // whether forces are drawn on the first block, else on the second
  fx: number; // on that block
  fy: number;
}

/** Where everything lies, displacements magnified. */
export class Layout {
  readonly position: Float32Array; // of places
  constructor(readonly moment: Moment, magnification: number) {
    const { reference } = moment.shape, { displacement } = moment;
    this.position = new Float32Array(reference.length);
    for (let k = 0; k < reference.length; ++k) this.position[k] = reference[k] + magnification * displacement[k];
  }

  cornerPositions(): Float32Array {
    const { cornerPlace } = this.moment.shape, corners = new Float32Array(2 * cornerPlace.length);
    for (let k = 0; k < cornerPlace.length; ++k) {
      corners[2 * k] = this.position[2 * cornerPlace[k]];
      corners[2 * k + 1] = this.position[2 * cornerPlace[k] + 1];
    }
    return corners;
  }
  isPresent(block: number): boolean {
    const { firstCell } = this.moment.shape;
    return firstCell[block] < firstCell[block + 1];
  }
  /** The mean of a block's vertices. */
  middle(block: number): [number, number] {
    const { firstPlace, nVertices } = this.moment.shape, first = firstPlace[block], n = nVertices[block];
    let x = 0, y = 0;
    for (let p = first; p < first + n; ++p) {
      x += this.position[2 * p];
      y += this.position[2 * p + 1];
    }
    return [x / n, y / n];
  }
  private knownBox: { low: [number, number]; high: [number, number] } | null = null;
  /** The box of all blocks. */
  get box(): { low: [number, number]; high: [number, number] } {
    return (this.knownBox ??= this.findBox());
  }
  private findBox(): { low: [number, number]; high: [number, number] } {
    const low: [number, number] = [Infinity, Infinity], high: [number, number] = [-Infinity, -Infinity];
    const { shape } = this.moment;
    for (let b = 0; b < shape.nBlocks; ++b) {
      if (!this.isPresent(b)) continue;
      for (let p = shape.firstPlace[b]; p < shape.firstPlace[b + 1]; ++p)
        for (let c = 0; c < 2; ++c) {
          low[c] = Math.min(low[c], this.position[2 * p + c]);
          high[c] = Math.max(high[c], this.position[2 * p + c]);
        }
    }
    return { low, high };
  }
  blockOfPlace(place: number): number {
    const { firstPlace } = this.moment.shape;
    let low = 0, high = firstPlace.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (firstPlace[middle] <= place) low = middle;
      else high = middle;
    }
    return low;
  }
  private area(block: number): number {
    const { firstPlace, nVertices } = this.moment.shape, first = firstPlace[block], end = first + nVertices[block];
    let twice = 0;
    for (let k = first, before = end - 1; k < end; before = k++)
      twice += this.position[2 * before] * this.position[2 * k + 1] - this.position[2 * k] * this.position[2 * before + 1];
    return Math.abs(twice / 2);
  }
  /** The sense of a contact's normal, for it to point into the first block of its joint. */
  private sense(contact: number, joint: Joint): number {
    return this.blockOfPlace(this.moment.contacts.place[contact]) === joint.first ? 1 : -1;
  }
  private isHeld(block: number): boolean {
    const { firstPlace, nVertices } = this.moment.shape, first = 2 * firstPlace[block];
    return this.moment.displacement.subarray(first, first + 2 * nVertices[block]).every((value) => value === 0);
  }
  /** Whether forces are drawn on the first block, as dda plot has it: on the one that has moved where the other has not; else
   *  on the upper one, into which the normals point up; across a vertical joint on the smaller one; of two as large as each
   *  other on the right one. */
  private drawnOnFirst(joint: Joint): boolean {
    const held = this.isHeld(joint.second);
    if (this.isHeld(joint.first) !== held) return held;
    let x = 0, y = 0;
    for (const k of joint.contacts) {
      const [nx, ny] = normalOf(this.moment, k), sense = this.sense(k, joint);
      x += sense * nx;
      y += sense * ny;
    }
    if (Math.abs(y) > 0.02 * Math.hypot(x, y)) return y > 0;
    const a = this.area(joint.first), b = this.area(joint.second);
    if (Math.abs(a - b) > 0.01 * Math.max(a, b)) return a < b;
    return this.middle(joint.first)[0] > this.middle(joint.second)[0];
  }
  /** The force of a contact on the block of its joint on which forces are drawn. */
  private forceOn(contact: number, joint: Joint): [number, number] {
    const { force } = this.moment, [nx, ny] = normalOf(this.moment, contact);
    const n = force[2 * contact], s = force[2 * contact + 1];
    const sense = joint.ofFirst ? this.sense(contact, joint) : -this.sense(contact, joint);
    return [sense * (n * nx - s * ny), sense * (n * ny + s * nx)];
  }

  private known: Joint[] | null = null;
  get joints(): Joint[] {
    return (this.known ??= this.findJoints());
  }
  private findJoints(): Joint[] {
    const { contacts, state, force, shape } = this.moment, joints = new Map<number, Joint>();
    for (let k = 0; k < contacts.count; ++k) {
      if (state[k] === 0) continue;
      const a = this.blockOfPlace(contacts.place[k]), b = contacts.edgeBlock[k];
      const first = Math.min(a, b), second = Math.max(a, b), key = first * shape.nBlocks + second;
      let joint = joints.get(key);
      if (!joint) joints.set(key, (joint = { first, second, contacts: [], x: 0, y: 0, ofFirst: true, fx: 0, fy: 0 }));
      joint.contacts.push(k);
    }
    for (const joint of joints.values()) {
      joint.ofFirst = this.drawnOnFirst(joint);
      let weight = 0;
      for (const k of joint.contacts) {
        const [fx, fy] = this.forceOn(k, joint), w = Math.abs(force[2 * k]), place = contacts.place[k];
        joint.fx += fx;
        joint.fy += fy;
        joint.x += w * this.position[2 * place];
        joint.y += w * this.position[2 * place + 1];
        weight += w;
      }
      if (weight > 0) {
        joint.x /= weight;
        joint.y /= weight;
      } else {
        joint.x = this.position[2 * contacts.place[joint.contacts[0]]];
        joint.y = this.position[2 * contacts.place[joint.contacts[0]] + 1];
      }
    }
    return [...joints.values()];
  }

  /** Places at the ends of all edges of outlines. */
  edges(): Uint32Array {
    const { firstPlace, nVertices, nBlocks } = this.moment.shape, ends: number[] = [];
    for (let b = 0; b < nBlocks; ++b)
      for (let k = firstPlace[b], before = k + nVertices[b] - 1; this.isPresent(b) && k < firstPlace[b] + nVertices[b]; before = k++)
        ends.push(before, k);
    return Uint32Array.from(ends);
  }
  outlines(lines: Lines): void {
    const { firstPlace, nVertices, nBlocks } = this.moment.shape, p = this.position;
    for (let b = 0; b < nBlocks; ++b) {
      if (!this.isPresent(b)) continue;
      const first = firstPlace[b], end = first + nVertices[b];
      for (let k = first, before = end - 1; k < end; before = k++)
        lines.add(p[2 * before], p[2 * before + 1], p[2 * k], p[2 * k + 1], 1, 1, INK);
    }
  }
  /** The cells of blocks that have several. */
  cells(lines: Lines): void {
    const { firstCell, firstCorner, cornerPlace, nBlocks } = this.moment.shape, p = this.position;
    for (let b = 0; b < nBlocks; ++b)
      for (let c = firstCell[b]; firstCell[b + 1] - firstCell[b] > 1 && c < firstCell[b + 1]; ++c)
        for (let k = firstCorner[c], before = firstCorner[c + 1] - 1; k < firstCorner[c + 1]; before = k++) {
          const from = cornerPlace[before], to = cornerPlace[k];
          lines.add(p[2 * from], p[2 * from + 1], p[2 * to], p[2 * to + 1], 0.6, 0.6, INK, 0.45);
        }
  }
  /** Outlines at the reference positions, in dashes as long as suits the scale. */
  reference(lines: Lines, pixelsPerMetre: number): void {
    const { firstPlace, nVertices, nBlocks, reference: p } = this.moment.shape, dash = 6 / pixelsPerMetre;
    for (let b = 0; b < nBlocks; ++b) {
      if (!this.isPresent(b)) continue;
      const first = firstPlace[b], end = first + nVertices[b];
      for (let k = first, before = end - 1; k < end; before = k++) {
        const x0 = p[2 * before], y0 = p[2 * before + 1], dx = p[2 * k] - x0, dy = p[2 * k + 1] - y0;
        const n = Math.min(40, Math.max(1, Math.round(Math.hypot(dx, dy) / dash / 2)));
        for (let d = 0; d < n; ++d)
          lines.add(x0 + (d / n) * dx, y0 + (d / n) * dy, x0 + ((d + 0.55) / n) * dx, y0 + ((d + 0.55) / n) * dy, 1, 1,
                    [70, 84, 98], 0.8);
      }
    }
  }
  /** Each joint in the colours of its contacts' states, from midway to midway between them. */
  states(lines: Lines): void {
    const { contacts, state } = this.moment, p = this.position;
    for (const joint of this.joints) {
      const [ty, nx] = normalOf(this.moment, joint.contacts[0]), tx = -nx;
      const along = joint.contacts.map((k) => ({
        k, x: p[2 * contacts.place[k]], y: p[2 * contacts.place[k] + 1],
        s: p[2 * contacts.place[k]] * tx + p[2 * contacts.place[k] + 1] * ty,
      })).sort((a, b) => a.s - b.s);
      along.forEach((c, i) => {
        const colour = STATE_COLOURS[CONTACT_STATES[state[c.k]]];
        const before = along[Math.max(0, i - 1)], after = along[Math.min(along.length - 1, i + 1)];
        if (along.length === 1) return lines.add(c.x, c.y, c.x, c.y, 7, 7, colour);
        lines.add((c.x + before.x) / 2, (c.y + before.y) / 2, c.x, c.y, 3.2, 3.2, colour);
        lines.add(c.x, c.y, (c.x + after.x) / 2, (c.y + after.y) / 2, 3.2, 3.2, colour);
        return undefined;
      });
    }
  }
  /** One force a contact, or one a joint. \param metres of a force of 1 N/m */
  forces(lines: Lines, metres: number, pixelsPerMetre: number, resultants: boolean): void {
    const { contacts, state } = this.moment, p = this.position;
    const slips = STATE_COLOURS.slip;
    for (const joint of this.joints) {
      if (resultants) {
        arrow(lines, joint.x, joint.y, joint.fx * metres, joint.fy * metres, pixelsPerMetre, FORCE);
        continue;
      }
      for (const k of joint.contacts) {
        const [fx, fy] = this.forceOn(k, joint), place = contacts.place[k];
        arrow(lines, p[2 * place], p[2 * place + 1], fx * metres, fy * metres, pixelsPerMetre, state[k] >= 3 ? slips : FORCE);
      }
    }
  }
  /** Through each block that two others hold: from joint to joint, where the resultants act. */
  thrust(lines: Lines): void {
    const ofBlock = new Map<number, Joint[]>();
    let largest = 0;
    for (const joint of this.joints) largest = Math.max(largest, Math.hypot(joint.fx, joint.fy));
    for (const joint of this.joints) {
      if (Math.hypot(joint.fx, joint.fy) < 1e-6 * largest) continue;
      for (const block of [joint.first, joint.second]) ofBlock.set(block, [...(ofBlock.get(block) || []), joint]);
    }
    for (const joints of ofBlock.values())
      if (joints.length === 2) {
        lines.add(joints[0].x, joints[0].y, joints[1].x, joints[1].y, 2.2, 2.2, THRUST);
        for (const { x, y } of joints) lines.add(x, y, x, y, 5, 5, THRUST);
      }
  }
  /** Principal directions, as long as the stresses. \param metres of a stress of 1 Pa */
  crosses(lines: Lines, metres: number, ofCells: boolean): void {
    const { shape, stress } = this.moment;
    if (!stress) return;
    for (let b = 0; b < shape.nBlocks; ++b) {
      const first = shape.firstCell[b], end = shape.firstCell[b + 1];
      if (ofCells)
        for (let c = first; c < end; ++c) {
          let x = 0, y = 0;
          const n = shape.firstCorner[c + 1] - shape.firstCorner[c];
          for (let k = shape.firstCorner[c]; k < shape.firstCorner[c + 1]; ++k) {
            x += this.position[2 * shape.cornerPlace[k]] / n;
            y += this.position[2 * shape.cornerPlace[k] + 1] / n;
          }
          this.cross(lines, x, y, stress.subarray(9 * c, 9 * c + 3), metres);
        }
      else if (first < end) {
        const mean = this.meanStress(b)!, [x, y] = this.middle(b);
        this.cross(lines, x, y, mean, metres);
      }
    }
  }
  /** The mean over a block's cells, by their areas. */
  meanStress(block: number): [number, number, number] | null {
    const { shape, stress } = this.moment;
    if (!stress) return null;
    const sum: [number, number, number] = [0, 0, 0];
    let total = 0;
    for (let c = shape.firstCell[block]; c < shape.firstCell[block + 1]; ++c) {
      let area = 0;
      for (let k = shape.firstCorner[c], before = shape.firstCorner[c + 1] - 1; k < shape.firstCorner[c + 1]; before = k++) {
        const a = 2 * shape.cornerPlace[before], b = 2 * shape.cornerPlace[k];
        area += (shape.reference[a] * shape.reference[b + 1] - shape.reference[b] * shape.reference[a + 1]) / 2;
      }
      for (let i = 0; i < 3; ++i) sum[i] += area * stress[9 * c + i];
      total += area;
    }
    return total > 0 ? [sum[0] / total, sum[1] / total, sum[2] / total] : null;
  }
  private cross(lines: Lines, x: number, y: number, stress: ArrayLike<number>, metres: number): void {
    const { s1, s2, angle } = principal(stress[0], stress[1], stress[2]);
    for (const [s, a] of [[s1, angle], [s2, angle + Math.PI / 2]]) {
      const dx = (Math.cos(a) * Math.abs(s) * metres) / 2, dy = (Math.sin(a) * Math.abs(s) * metres) / 2;
      lines.add(x - dx, y - dy, x + dx, y + dy, 3.2, 3.2, [255, 255, 255], 0.75);
      lines.add(x - dx, y - dy, x + dx, y + dy, 1.6, 1.6, s > 0 ? TENSION : COMPRESSION);
    }
  }
}

function arrow(lines: Lines, x: number, y: number, dx: number, dy: number, pixelsPerMetre: number,
               colour: [number, number, number]): void {
  const length = Math.hypot(dx, dy) * pixelsPerMetre;
  if (!(length > 0.7)) return;
  const head = Math.min(8, 0.6 * length), neck = 1 - head / length;
  lines.add(x, y, x + dx, y + dy, 3.4, 3.4, [255, 255, 255], 0.55);
  lines.add(x, y, x + neck * dx, y + neck * dy, 1.6, 1.6, colour);
  lines.add(x + neck * dx, y + neck * dy, x + dx, y + dy, Math.max(2.4, 0.8 * head), 0, colour);
}
