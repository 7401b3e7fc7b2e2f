// How large things are drawn.

import { Layout } from "./picture";
import { Head } from "./run";

export class Sizes {
  /** `scale` is in pixels a metre. */
  constructor(private readonly layout: Layout, private readonly head: Head, private readonly scale: number) {}

  /** How long the arrow of 1 N/m is: the 99th percentile of all forces takes 46 px. */
  metresOfForce(factor: number): number {
    const { force } = this.head;
    return force > 0 ? (46 * factor) / force / this.scale : 0;
  }
  metresOfStress(ofCells: boolean, factor: number): number {
    const { s1, s2 } = this.head.ranges;
    if (!s1) return 0;
    const most = Math.max(Math.abs(s1[2]), Math.abs(s1[3]), Math.abs(s2[2]), Math.abs(s2[3]));
    if (most === 0) return 0;
    const { shape } = this.layout.moment;
    const part = 0.8 * this.pixelsOf(ofCells ? shape.blockOfCell.length : shape.nBlocks);
    return (Math.min(60, Math.max(5, part)) * factor) / most / this.scale;
  }
  /** Outlines of blocks that are drawn small must not hide the colours. */
  get outlineAlpha(): number {
    const size = this.pixelsOf(Math.max(1, this.layout.moment.shape.nBlocks));
    return Math.max(0.1, Math.min(0.8, (size - 4) / 22));
  }

  /** About as large as one of n parts is drawn. */
  private pixelsOf(n: number): number {
    const { low, high } = this.layout.box;
    return this.scale * Math.sqrt(((high[0] - low[0]) * (high[1] - low[1])) / n);
  }
}
