// Curves over time with a mark at the frame that is shown.

import { plain, scaledUnit, ticks } from "./numbers";
import { History } from "./run";

const FONT = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', Roboto, sans-serif";
const LEFT = 66, RIGHT = 150, TOP = 10, BOTTOM = 24;

export class Chart {
  private readonly context: CanvasRenderingContext2D;
  private readonly still = document.createElement("canvas"); // all but the mark
  private curves: History[] = [];
  private low = 0;
  private high = 1;
  private end = 1;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly colours: string[], seek: (time: number) => void) {
    this.context = canvas.getContext("2d")!;
    const go = (event: PointerEvent) => {
      const box = canvas.getBoundingClientRect(), width = box.width - LEFT - RIGHT;
      seek(Math.max(0, Math.min(1, (event.clientX - box.left - LEFT) / width)) * this.end);
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener("pointermove", (event) => event.buttons & 1 && go(event));
  }

  /** Lets a group of the histories be chosen; first that of what moves most. */
  offer(histories: History[], choice: HTMLSelectElement): void {
    const groups = [...new Set(histories.map((curve) => curve.group))];
    for (const group of groups) choice.append(new Option(group));
    choice.onchange = () => this.show(histories.filter((curve) => curve.group === choice.value));
    choice.value = mostMoving(histories) ?? groups[groups.length - 1];
    this.show(histories.filter((curve) => curve.group === choice.value));
  }
  show(curves: History[]): void {
    this.curves = curves;
    const values = curves.flatMap((curve) => curve.values);
    this.low = values.reduce((a, b) => Math.min(a, b), 0);
    this.high = values.reduce((a, b) => Math.max(a, b), 0);
    if (this.low === this.high) this.high = this.low + 1;
    this.end = curves.reduce((t, curve) => Math.max(t, curve.times[curve.times.length - 1] || 0), 0) || 1;
    this.drawStill();
  }

  drawStill(): void {
    const ratio = Math.min(2, window.devicePixelRatio || 1), width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    for (const canvas of [this.canvas, this.still]) {
      canvas.width = Math.max(1, Math.round(width * ratio));
      canvas.height = Math.max(1, Math.round(height * ratio));
    }
    const c = this.still.getContext("2d")!;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [factor, unit] = scaledUnit(Math.max(Math.abs(this.low), Math.abs(this.high)), this.curves[0]?.unit ?? "");
    c.font = `11px ${FONT}`;
    c.textBaseline = "middle";
    for (const value of ticks(this.low / factor, this.high / factor, 4)) {
      const y = this.y(value * factor, height);
      c.fillStyle = value === 0 ? "#9aa7b3" : "#e3e8ed";
      c.fillRect(LEFT, y - 0.5, width - LEFT - RIGHT, 1);
      c.fillStyle = "#5b6875";
      c.textAlign = "right";
      c.fillText(plain(value), LEFT - 8, y);
    }
    c.textAlign = "left";
    c.fillText(unit, 6, TOP + 2);
    c.textAlign = "center";
    for (const time of ticks(0, this.end, 8)) c.fillText(plain(time), this.x(time, width), height - 12);
    c.textAlign = "left";
    c.fillText("t (s)", width - RIGHT + 22, height - 12);
    this.curves.forEach((curve, k) => {
      c.strokeStyle = this.colours[k % this.colours.length];
      c.lineWidth = 1.6;
      c.setLineDash(k >= this.colours.length ? [5, 3] : []);
      c.beginPath();
      curve.times.forEach((time, i) => c.lineTo(this.x(time, width), this.y(curve.values[i], height)));
      c.stroke();
      c.setLineDash([]);
    });
    const line = Math.min(15, (height - TOP - 18) / this.curves.length);
    c.font = `${Math.min(11, line)}px ${FONT}`;
    this.curves.forEach((curve, k) => {
      const y = TOP + 6 + line * k;
      c.fillStyle = this.colours[k % this.colours.length];
      c.fillRect(width - RIGHT + 10, y - 1.5, 14, 3);
      c.fillStyle = "#1c242c";
      c.fillText(curve.name.length > 20 ? curve.name.slice(0, 19) + "…" : curve.name, width - RIGHT + 30, y);
    });
    this.mark(this.marked);
  }

  private marked = 0;
  mark(time: number): void {
    this.marked = time;
    const c = this.context, ratio = this.canvas.width / Math.max(1, this.canvas.clientWidth);
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.drawImage(this.still, 0, 0);
    const x = this.x(time, this.canvas.clientWidth) * ratio;
    c.fillStyle = "#d2460b";
    c.fillRect(x - ratio / 2, TOP * ratio, ratio, this.canvas.height - (TOP + BOTTOM) * ratio);
  }

  private x(time: number, width: number): number {
    return LEFT + (time / this.end) * (width - LEFT - RIGHT);
  }
  private y(value: number, height: number): number {
    return TOP + (1 - (value - this.low) / (this.high - this.low)) * (height - TOP - BOTTOM);
  }
}

/** The displacements of monitors that change most. */
function mostMoving(histories: History[]): string | null {
  let most = 0, group: string | null = null;
  for (const curve of histories)
    if (/^monitors: u/.test(curve.group))
      for (const value of curve.values)
        if (Math.abs(value) > most) [most, group] = [Math.abs(value), curve.group];
  return group;
}
