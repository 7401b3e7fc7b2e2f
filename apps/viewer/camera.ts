// What part of the plane is shown, and how large.

export class Camera {
  x = 0; // the point in the middle, relative to the run's centre, m
  y = 0;
  scale = 1; // CSS pixels per metre
  width = 1; // of the picture, CSS pixels
  height = 1;

  toScreen(x: number, y: number): [number, number] {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }
  toWorld(px: number, py: number): [number, number] {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }
  /** Shows a box whole, beside the legends. */
  fit(low: [number, number], high: [number, number], right: number, bottom: number, top: number): void {
    const margin = 28;
    const width = Math.max(60, this.width - 2 * margin - right), height = Math.max(60, this.height - margin - bottom - top);
    const spanX = Math.max(high[0] - low[0], 1e-9), spanY = Math.max(high[1] - low[1], 1e-9);
    this.scale = Math.min(width / spanX, height / spanY);
    this.x = (low[0] + high[0]) / 2 + right / 2 / this.scale;
    this.y = (low[1] + high[1]) / 2 + (top - bottom - 0) / 2 / this.scale;
  }
  zoom(factor: number, px: number, py: number): void {
    const [x, y] = this.toWorld(px, py);
    this.scale *= factor;
    const [nowX, nowY] = this.toWorld(px, py);
    this.x += x - nowX;
    this.y += y - nowY;
  }
  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }
  /** Gives a canvas the pixels that it shows. */
  sizeCanvas(canvas: HTMLCanvasElement, ratio: number): void {
    canvas.width = Math.max(1, Math.round(this.width * ratio));
    canvas.height = Math.max(1, Math.round(this.height * ratio));
  }
}
